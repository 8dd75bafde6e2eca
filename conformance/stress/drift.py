"""Drift: bodies that stand, walk to and fro, walk in circles and push at a wall, for 100,000 ticks.

Each tick begins from what the last one rounded. Does it add up? Retail and the candidate walk the same way;
what is right is known without walking: the lower sphere stays in touch with the plane that it is on, and a
body on open ground goes where its velocities lead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.query import Result
from conformance.stress.courses import COURSES, SETTLED
from conformance.stress.findings import CANDIDATE, DIFFERING, RETAIL, Findings, Reading
from conformance.stress.gait import Gait
from conformance.stress.standing import Standing
from conformance.stress.sweep import Sweep

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from conformance.query import Outcome, Query
    from conformance.stress.courses import Course
    from conformance.stress.models import Models
    from conformance.stress.settings import Settings
    from conformance.stress.sweep import Say

FAMILY: Final = "drift"
AXIS: Final = "ticks"
SAID_TICKS: Final = 100
"""How often a walk tells how far it is, ticks."""
SHARE: Final = 5
"""What part of the walk other roundings take, one in so many: their ticks take longer."""
LEAST: Final = SETTLED + 40
"""Length of the shortest walk that shows anything, ticks."""
MOST: Final = 1000
"""Ticks that they take at most."""


def sweeps(settings: Settings) -> Sequence[Sweep]:
    """Return the family: a sweep for each course."""
    return [DriftSweep(course, settings.ticks) for course in COURSES]


class DriftSweep(Sweep):
    """A course, walked once; severities are the ticks until then.

    Parameters
    ----------
    course : Course
    ticks : int
        Of a whole walk; a course may take a share of it.
    """

    family = FAMILY
    axis = AXIS
    cost = 1000

    def __init__(self, course: Course, ticks: int) -> None:
        self.name = course.name
        self._course = course
        self._ticks = max(ticks // course.share, LEAST)
        self._others = min(self._ticks // SHARE, MOST)

    @property
    def parts(self) -> int:
        """A walk is one part: each tick begins where the last one ended."""
        return 1

    def run(self, part: int, models: Models, say: Say) -> Findings:
        """Walk the course with everyone, and compare retail and the candidate tick by tick."""
        query, found = self._course.query(), Findings()
        outcomes: dict[str, Outcome] = {}
        for name, ask in (*models.roundings.items(), (CANDIDATE, models.candidate.answer)):
            count = self._ticks if name in {RETAIL, CANDIDATE} else self._others
            told = f"{self.family}, {self.name}: {name}, part {part}"
            outcomes[name] = ask(self._lasting(query, count, told, say))
        standing = Standing(self, models.candidate.name)
        differs = standing.differs(query.op, outcomes[RETAIL], outcomes[CANDIDATE])
        standing.tell(found)
        if not standing.asked:
            del outcomes[CANDIDATE]
        for name, outcome in outcomes.items():
            differing = {DIFFERING: float(differs)} if name == CANDIDATE else {}
            found.readings += self._readings(name, outcome, differing)
        walked = f"{self._others} ticks by single and double, {self._ticks} by retail and the candidate"
        found.notes.append(f"{self.family}, {self.name}: {walked}")
        return found

    def _lasting(self, query: Query, count: int, told: str, say: Say) -> Query:
        """Return the query with so many ticks."""
        ticks = Ticks(self._course, count, told, say)
        return type(query)(query.op, {**query.inputs, "ticks": ticks}, query.geometries, query.label)

    def _readings(self, model: str, outcome: Outcome, differing: Mapping[str, float]) -> Iterator[Reading]:
        if not isinstance(outcome, Result):
            yield Reading(self.family, self.name, 1.0, model, {"refused": 1.0, **differing})
            return
        gait = Gait(self._course)
        ticks = outcome.fields["ticks"]
        told = set(checkpoints(len(ticks)))
        for number, tick in enumerate(ticks, start=1):
            gait.take(tick)
            if number in told:
                quantities = {**gait.quantities(), **differing}
                yield Reading(self.family, self.name, float(number), model, quantities)


class Ticks(list[Any]):
    """The ticks of a course; whoever goes through them tells now and then how far it is."""

    def __init__(self, course: Course, count: int, told: str, say: Say) -> None:
        super().__init__(course.tick(number) for number in range(count))
        self._told = told
        self._say = say

    def __iter__(self) -> Iterator[Any]:
        for number, tick in enumerate(super().__iter__()):
            if number % SAID_TICKS == 0:
                self._say(f"{self._told}, tick {number} of {len(self)}")
            yield tick


def checkpoints(count: int) -> list[int]:
    """Return the ticks at which a walk is told: powers of ten and their threefold, and the last."""
    powers = [digit * 10**power for power in range(2, len(str(count))) for digit in (1, 3)]
    return [*(number for number in powers if SETTLED < number < count), count]
