"""Plans: what a query does not need is not done.

A transition is a chain of tests, most of which find nothing: of objects that are far away, of cells behind
portals that nobody is near, of a tree while the mover flies through the middle of a room. A *shortcut*
leaves such tests out where a broad phase shows that they find nothing. None of them can change a bit of
a result: the kernels that take them prove it, each at its place (`engine.kernels.plan`, `plan_portals`,
`plan_flight`, `gate`, `lattice`), most of them from bounds that are derived in `engine.kernels.broad`. What
may differ is counters of work.

Batches, prepared queries and ticks use all shortcuts unless they are told otherwise. A row of state that
records a trace uses none, since a trace tells of every call that retail makes; nor does `recording`.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntFlag
from typing import Final

from engine import layout as at
from engine.checks import record, whole
from engine.errors import QueryError


class Stage(IntFlag):
    """What may be left out.

    The order of the bits is that of the counters in ``skipped`` of results and bodies.
    """

    PORTALS = int(at.PLAN_PORTALS)
    """Looking behind the portals of an environment cell when none is in reach: the cell list is the cell."""
    OBJECTS = int(at.PLAN_OBJECTS)
    """Testing objects, and the outsides of houses, that are out of reach."""
    GROUND = int(at.PLAN_GROUND)
    """Testing the ground of a land cell that is far below."""
    FLIGHT = int(at.PLAN_FLIGHT)
    """Inserting the mover in each sub-step of a move indoors of which nothing at all is in reach."""
    BOUNDS = int(at.PLAN_BOUNDS)
    """Testing bounding spheres below a tree's root, where no polygon is outside of one above it."""
    WALKS = int(at.PLAN_WALKS)
    """Walking through a cell's tree for what a sphere touches, where nothing that is near it does."""


ALL_STAGES: Final = Stage.PORTALS | Stage.OBJECTS | Stage.GROUND | Stage.FLIGHT | Stage.BOUNDS | Stage.WALKS
_CHECK_STAGES: Final = whole(0, int(ALL_STAGES))


@dataclass(frozen=True, slots=True)
class Plan:
    """Which shortcuts may be taken.

    Attributes
    ----------
    skip : Stage
        What may be left out where it is certain to find nothing.

    Examples
    --------
    >>> Plan.none().skip == Stage(0)
    True
    >>> Plan(skip=Stage.PORTALS | Stage.OBJECTS).skip & Stage.FLIGHT == 0
    True
    """

    skip: Stage = ALL_STAGES

    def __post_init__(self) -> None:
        """Raise `QueryError` if `skip` is no set of stages."""
        _CHECK_STAGES(self.skip, "plan, skip", QueryError)

    @classmethod
    def none(cls) -> Plan:
        """Return the plan that leaves nothing out: retail's own way, test by test."""
        return cls(Stage(0))


CHECK_PLAN: Final = record(Plan)
"""Refuses what is no plan."""
FULL_PLAN: Final = Plan()
"""What is used where nothing else is said."""
CALL_PLAN: Final = Plan(Stage.BOUNDS | Stage.WALKS)
"""What is used of single calls of trees and objects: the other shortcuts are those of whole transitions."""
NO_PLAN: Final = Plan.none()


def of_calls(plan: Plan) -> Plan:
    """Return what of a plan single calls take: the other shortcuts are proven of whole transitions.

    Raises
    ------
    QueryError
        If it is none.
    """
    # To combine flags takes as long as a query.
    if plan is CALL_PLAN:
        return plan
    CHECK_PLAN(plan, "plan", QueryError)
    return Plan(plan.skip & CALL_PLAN.skip)
