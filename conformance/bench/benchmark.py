"""One run: all contests and curves that were asked for, each result kept as soon as it is there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeVar

import numpy as np

from conformance.bench.contests import Contest
from conformance.bench.messages import measure_messages
from conformance.bench.native.compiler import NoCompilerError
from conformance.bench.native_jobs import Native
from conformance.bench.parts import spread
from conformance.bench.peers import MODULES
from conformance.bench.precision import NoExactError
from conformance.bench.sampling import NoAirError, NoGroundError
from conformance.bench.scaling import Scaling
from conformance.bench.scenes import REAL, make_scene, real_scenes
from conformance.bench.sections import contests_of
from conformance.bench.settings import SECTIONS
from conformance.bench.timing import DisagreementError
from conformance.loader import load_paths

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from conformance.bench.report import Report
    from conformance.bench.scenes import BenchScene
    from conformance.bench.settings import Settings

T = TypeVar("T")

_SCENE_SECTIONS: Final = tuple(section for section in SECTIONS if section not in {"scaling", "messages"})


def measure(settings: Settings, report: Report, say: Callable[[str], None]) -> None:
    """Fill a report.

    Parameters
    ----------
    settings : Settings
    report : Report
        It is right at every moment: a run that is broken off has what was measured until then.
    say : callable
        Is told what is being done.

    Raises
    ------
    DumpError
        If the real cells cannot be read.
    """
    rng = np.random.default_rng(settings.seed)
    native = _native(settings, report)
    report.facts["samples"] = dict(settings.sizes)
    _name_omissions(settings, report)
    if any(section in settings.sections for section in _SCENE_SECTIONS):
        for scene in _scenes(settings, say):
            contest = Contest(scene, settings, report, rng, say)
            report.facts.setdefault("polygons", {}).setdefault(scene.name, []).append(scene.size)
            for name, perform in contests_of(settings.sections, native):
                say(f"{scene.name}: {name}")
                _attempt(report, f"{scene.name}: {name}", perform, contest)
    if "scaling" in settings.sections:
        for name, curve in Scaling(settings, report, rng, say).curves():
            say(name)
            _attempt(report, name, lambda measure_it: measure_it(), curve)
    if "messages" in settings.sections:
        say("messages: reading cases")
        turns = spread(load_paths().cases, settings.case_parts)[: settings.case_rounds]
        _attempt(report, "messages", lambda chosen: measure_messages(chosen, report, say), turns)


def _attempt(report: Report, name: str, perform: Callable[[T], None], subject: T) -> None:
    """Measure one thing; what cannot be measured is an omission, a wrong answer a failure."""
    try:
        perform(subject)
    except (NoGroundError, NoAirError, NoExactError) as error:
        report.omit(name, str(error))
    except DisagreementError as error:
        report.failures.append(f"{name}: {error}")


def _scenes(settings: Settings, say: Callable[[str], None]) -> Iterator[BenchScene]:
    for name in settings.scenes:
        say(f"building {name}")
        yield make_scene(name)
    if settings.fixtures is not None:
        cells = real_scenes(settings.fixtures)
        yield max(cells, key=lambda scene: scene.size)


def _native(settings: Settings, report: Report) -> Native | None:
    if "native" not in settings.sections:
        return None
    try:
        native = Native()
    except NoCompilerError as error:
        report.omit("native", str(error))
        return None
    report.facts["native"] = native.compiler
    return native


def _name_omissions(settings: Settings, report: Report) -> None:
    """Say what was not asked for."""
    hints = {
        "native": "not asked for (--native)",
        "peers": f"not asked for (--peers): {', '.join(MODULES)}",
    }
    for section in SECTIONS:
        if section not in settings.sections:
            report.omit(section, hints.get(section, "left out by --only"))
    if settings.fixtures is None:
        report.omit(REAL, "no folder of real cells was given (--fixtures)")
