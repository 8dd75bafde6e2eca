"""Running queries on the oracle under coverage.py, and which branches they took."""

from __future__ import annotations

import json
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import oracle
from conformance.branches.sites import functions_of
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Errored, Skipped

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from coverage import Coverage

    from conformance.branches.sites import Branch, Function
    from conformance.query import Query

ORACLE: Final = Path(oracle.__file__).parent
INSTRUMENTS: Final = frozenset(
    {"arithmetic.py", "errors.py", "retail_frames.py", "trace.py", "write_trace.py", "writes.py"}
)
"""Modules that hold nothing of retail: number models, errors, and what records a run."""
_SHOWING: Final = "__repr__"
"""Methods for people who debug; nothing asks them in a run."""
_WARNINGS: Final = ("already-imported", "module-not-measured", "no-data-collected")
"""Of coverage.py: what is imported before a measurement lacks its module lines, which nobody counts here."""


class CoverageMissingError(ImportError):
    """coverage.py is not installed."""

    def __init__(self) -> None:
        super().__init__("coverage.py is needed: pip install 'retail-conformance[coverage]'")


@dataclass(frozen=True, slots=True, order=True)
class Site:
    """A function of the oracle: its file, the module's name in reasons, and its own name."""

    file: str
    name: str

    @property
    def key(self) -> str:
        """What reasons call it: ``frame.Frame.set_rotate``."""
        return f"{self.file.removesuffix('.py')}.{self.name}"


@dataclass(frozen=True, slots=True)
class Reach:
    """What a run reached of one function.

    Attributes
    ----------
    function : Function
        The function, as its source has it.
    called : bool
        Whether it ran at all.
    taken, missed : tuple of Branch
        The branches that the run took, and those that it did not.
    """

    function: Function
    called: bool
    taken: tuple[Branch, ...]
    missed: tuple[Branch, ...]

    @property
    def total(self) -> int:
        """How many branches it has."""
        return len(self.taken) + len(self.missed)


@dataclass(slots=True)
class Measurement:
    """What a run reached of the oracle.

    Attributes
    ----------
    reached : Mapping of Site to Reach
        Every function, sorted by file, in the order of the source.
    queries : int
        How many the oracle answered.
    failures : list of str
        Queries that it did not answer, and why.
    """

    reached: Mapping[Site, Reach] = field(default_factory=dict)
    queries: int = 0
    failures: list[str] = field(default_factory=list)


def measure(asking: Callable[[Callable[[Query], None]], None]) -> Measurement:
    """Ask the oracle and see which branches of it run.

    Parameters
    ----------
    asking : callable
        Is given a function that asks one query, and calls it for each.

    Raises
    ------
    CoverageMissingError
        coverage.py is not installed.
    """
    candidate = OracleCandidate()
    measurement = Measurement()

    def ask(query: Query) -> None:
        outcome = candidate.answer(query)
        if isinstance(outcome, Skipped):
            measurement.failures.append(f"{query.label}: {outcome.reason}")
        elif isinstance(outcome, Errored):
            measurement.failures.append(f"{query.label}: {outcome.context}")
        else:
            measurement.queries += 1

    recorder = _make_recorder()
    with recorder.collect():
        asking(ask)
    measurement.reached = dict(_read(recorder))
    return measurement


def oracle_sources() -> dict[str, str]:
    """Return the text of every measured module of the oracle, by file name."""
    files = sorted(path for path in ORACLE.glob("*.py") if path.name not in INSTRUMENTS)
    return {path.name: path.read_text(encoding="utf-8") for path in files}


def _make_recorder() -> Coverage:
    try:
        from coverage import Coverage
    except ImportError as error:
        raise CoverageMissingError from error
    recorder = Coverage(data_file=None, branch=True, source_pkgs=[oracle.__name__], config_file=False)
    recorder.set_option("run:disable_warnings", list(_WARNINGS))
    return recorder


def _read(recorder: Coverage) -> Iterable[tuple[Site, Reach]]:
    """Yield every function that does something; interfaces and empty hooks have nothing to reach."""
    report = _report(recorder)
    for file, source in oracle_sources().items():
        regions = report[file]["functions"]
        for name, function in functions_of(source).items():
            region = regions[name]
            if region["summary"]["num_statements"] and not name.endswith(_SHOWING):
                yield Site(file, name), _reach(function, region)


def _report(recorder: Coverage) -> dict[str, Any]:
    """Return coverage.py's own report, by file name."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "coverage.json"
        recorder.json_report(outfile=str(path))
        report: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return {Path(file).name: content for file, content in report["files"].items()}


def _reach(function: Function, region: Mapping[str, Any]) -> Reach:
    taken = tuple(function.taken(*arc) for arc in region["executed_branches"])
    missed = tuple(function.taken(*arc) for arc in region["missing_branches"])
    return Reach(function, bool(region["executed_lines"]), taken, missed)
