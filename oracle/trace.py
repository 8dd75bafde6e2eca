"""The trace of collision calls: a letter opens a call, the digit of its result closes it.

``K`` may contain nested calls: ``KD3D1P11`` is a contact call, inside it a step down that adjusted, one
that found nothing, a placement test that passed, and then the contact call returned OK. The trace tells
where two implementations part; the port itself knows nothing of it.
"""

from __future__ import annotations

from functools import wraps
from typing import TYPE_CHECKING, Concatenate, Final, ParamSpec, TypeVar

from oracle.enums import CONTACT_OI, PATH_CLIPPED_OI, InsertType

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.enums import TransitionState
    from oracle.transition import Transition

P = ParamSpec("P")
Tree = TypeVar("Tree")

INITIAL_PLACEMENT: Final = "I"
PLACEMENT: Final = "P"
CHECK_WALKABLE: Final = "W"
STEP_DOWN: Final = "D"
LANDING: Final = "L"
CONTACT: Final = "K"
PATH_CLIPPED: Final = "M"
AIRBORNE: Final = "A"
SPHERE: Final = "S"
CYLINDER: Final = "C"
TERRAIN: Final = "T"
BUILDING: Final = "B"


def initial_placement(_transition: Transition) -> str:
    """Return the letter of ``BSPTree.placement_insert``."""
    return INITIAL_PLACEMENT


def sphere_test(_transition: Transition) -> str:
    """Return the letter of ``Sphere.intersects_sphere``."""
    return SPHERE


def cylinder_test(_transition: Transition) -> str:
    """Return the letter of ``CylSphere.intersects_sphere``."""
    return CYLINDER


def terrain(_transition: Transition) -> str:
    """Return the letter of a land cell's test of the triangle, or of the sea, under the mover."""
    return TERRAIN


def building(_transition: Transition) -> str:
    """Return the letter of ``BuildingObj.find_building_collisions``."""
    return BUILDING


def dispatch(transition: Transition) -> str:
    """Return the letter of the path that ``BSPTree.find_collisions`` will take (03 16, dispatch)."""
    path = transition.sphere_path
    state = transition.object_info.state
    if path.insert_type == InsertType.PLACEMENT or path.obstruction_ethereal:
        return PLACEMENT
    if path.check_walkable:
        return CHECK_WALKABLE
    if path.step_down:
        return STEP_DOWN
    if path.collide:
        return LANDING
    if state & CONTACT_OI:
        return CONTACT
    return PATH_CLIPPED if state & PATH_CLIPPED_OI else AIRBORNE


def traced(
    opening: Callable[[Transition], str],
) -> Callable[
    [Callable[Concatenate[Tree, Transition, P], TransitionState]],
    Callable[Concatenate[Tree, Transition, P], TransitionState],
]:
    """Make a method note its calls in ``transition.trace``, if that is not None.

    Parameters
    ----------
    opening : callable
        Gives the opening letter from the transition as it is when the call begins.
    """

    def decorate(
        call: Callable[Concatenate[Tree, Transition, P], TransitionState],
    ) -> Callable[Concatenate[Tree, Transition, P], TransitionState]:
        @wraps(call)
        def wrapper(
            self: Tree, transition: Transition, /, *args: P.args, **kwargs: P.kwargs
        ) -> TransitionState:
            if transition.trace is None:
                return call(self, transition, *args, **kwargs)
            transition.trace.append(opening(transition))
            result = call(self, transition, *args, **kwargs)
            transition.trace.append(str(result.value))
            return result

        return wrapper

    return decorate
