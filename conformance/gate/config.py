"""What a gate asks: presets, and YAML files that change them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Final

from pydantic import Field, field_validator

from conformance.gate.outcome import Stage
from conformance.installed import installed
from conformance.schema.mistakes import mistake
from conformance.schema.values import Strictly
from conformance.source import nearest, quoted
from conformance.yaml_model import read_model

STRESS_FAMILIES: Final = ("translation", "rotation", "thresholds", "degenerate", "drift", "scale")
"""As `conformance.stress.families` has them, which comes with an extra."""
DEFAULT_SEED: Final = 20130424
"""Of all draws, where none is named."""
LEAST_RATIO: Final = 0.7
"""Share of the baseline's speed that must be left: a busy machine moves the ratio by a tenth."""
PATIENCE: Final = 120.0
"""Seconds in a row that a candidate may let a gate wait without an answer: then it is not asked any more."""
_Count = Annotated[int, Field(ge=0, le=1_000_000)]
_Seed = Annotated[int, Field(ge=0, le=0xFFFF_FFFF)]


class Draws(Strictly):
    """Random queries: how many of each family, and from which seed."""

    count: _Count
    seed: _Seed = DEFAULT_SEED


class StressPart(Strictly):
    """Which families of `conformance stress` are run, and the budget that they are held to."""

    families: list[str]
    budget: str | None = None

    @field_validator("families")
    @classmethod
    def _families_are_known(cls, families: list[str]) -> list[str]:
        for index, name in enumerate(families):
            if name not in STRESS_FAMILIES:
                raise mistake(
                    f"the family {name!r}",
                    f"one of {quoted(STRESS_FAMILIES)}",
                    nearest(name, STRESS_FAMILIES),
                    at=(index,),
                )
        return families


class SpeedPart(Strictly):
    """The stored ratio that the candidate's speed is held to, and how much of it must be left."""

    baseline: str
    at_least: float = Field(default=LEAST_RATIO, gt=0.0, le=10.0)


class GateFile(Strictly):
    """A gate's configuration file; what it does not say is as in the preset."""

    cases: list[str] | None = Field(default=None, min_length=1)
    case_poses: Draws | None = None
    poses: Draws | None = None
    walks: Draws | None = None
    stress: StressPart | None = None
    deviations: str | None = None
    performance: SpeedPart | None = None


class GateConfigError(Exception):
    """A configuration file that cannot be used; its message says where and why."""


@dataclass(frozen=True, slots=True)
class Gate:
    """What a gate asks.

    Attributes
    ----------
    poses, walks : Draws
        Random queries of each family.
    stages : tuple of Stage
        Which are run.
    cases : tuple of Path
        Files or folders; empty: the built-in cases.
    only : tuple of str
        Patterns of ids; empty: every case.
    case_poses : Draws or None
        Random poses of each scene case; None: as written only.
    stress : tuple of str
        Families of numerical stress.
    budget : Path or None
        The candidate's error budget; None: the suite's for it.
    deviations : str or None
        File or name; None: the candidate's own.
    baseline : Path or None
        Where the candidate's speed is stored.
    least_ratio : float
        Share of that which must be left.
    """

    poses: Draws
    walks: Draws
    stages: tuple[Stage, ...] = (Stage.CASES, Stage.POSES, Stage.WALKS, Stage.STRESS)
    cases: tuple[Path, ...] = ()
    only: tuple[str, ...] = ()
    case_poses: Draws | None = None
    stress: tuple[str, ...] = ("translation", "rotation")
    budget: Path | None = None
    deviations: str | None = None
    baseline: Path | None = None
    least_ratio: float = LEAST_RATIO


STANDARD: Final = Gate(poses=Draws(count=300), walks=Draws(count=50))
QUICK: Final = replace(STANDARD, poses=Draws(count=100), walks=Draws(count=20), stress=("rotation",))
"""Under a minute and a half on two cores."""
FULL: Final = replace(
    STANDARD,
    case_poses=Draws(count=1),
    poses=Draws(count=600),
    walks=Draws(count=80),
    stress=STRESS_FAMILIES,
)
"""Under five minutes on two cores."""


def read_config(path: Path, preset: Gate) -> Gate:
    """Read a configuration file; its paths are relative to its folder.

    Raises
    ------
    GateConfigError
        It is not one; with every mistake and its place.
    OSError
        It cannot be read at all.
    YamlError
        It is not YAML.
    """
    _, file, problems = read_model(path, GateFile)
    if file is None:
        raise GateConfigError("\n".join(str(problem) for problem in problems))
    return _changed(preset, file, path.parent)


def _changed(preset: Gate, file: GateFile, folder: Path) -> Gate:
    gate = replace(
        preset,
        cases=preset.cases
        if file.cases is None
        else tuple(folder / installed(Path(name)) for name in file.cases),
        case_poses=file.case_poses or preset.case_poses,
        poses=file.poses or preset.poses,
        walks=file.walks or preset.walks,
        deviations=preset.deviations if file.deviations is None else _place(file.deviations, folder),
    )
    if file.stress is not None:
        budget = None if file.stress.budget is None else folder / file.stress.budget
        gate = replace(gate, stress=tuple(file.stress.families), budget=budget)
    if file.performance is not None:
        stages = (*gate.stages, Stage.PERFORMANCE)
        baseline = folder / file.performance.baseline
        gate = replace(gate, stages=stages, baseline=baseline, least_ratio=file.performance.at_least)
    return replace(gate, stages=tuple(stage for stage in gate.stages if _asks_anything(gate, stage)))


def _asks_anything(gate: Gate, stage: Stage) -> bool:
    """Tell whether a stage is not left out by asking for nothing of it."""
    amounts = {Stage.POSES: gate.poses.count, Stage.WALKS: gate.walks.count, Stage.STRESS: len(gate.stress)}
    return amounts.get(stage, 1) > 0


def _place(deviations: str, folder: Path) -> str:
    """Return the path of a deviation file; the name of an engine, which has no suffix, stays a name."""
    return str(folder / deviations) if Path(deviations).suffix else deviations
