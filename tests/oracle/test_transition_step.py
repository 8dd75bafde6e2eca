"""CTransition, steps and edges: what a probe leaves behind."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from oracle_worlds import (
    CELL,
    FLOOR,
    ScriptedCell,
    ScriptedWorld,
    at,
    mover,
    polygon,
    transition,
    vec,
    world_of,
    xyz,
)

from oracle.arithmetic import f32
from oracle.constants import FLOOR_Z, SMALL_STEP, Z_LANDING
from oracle.enums import CONTACT_OI, EDGE_SLIDE, ON_WALKABLE_OI, InsertType, TransitionState
from oracle.plane import Plane
from oracle.position import Position
from oracle.sphere import Sphere

if TYPE_CHECKING:
    from collections.abc import Callable

    from oracle.transition import Transition

OK, COLLIDED, ADJUSTED, SLID = (
    TransitionState.OK,
    TransitionState.COLLIDED,
    TransitionState.ADJUSTED,
    TransitionState.SLID,
)
WALKING = CONTACT_OI | ON_WALKABLE_OI | EDGE_SLIDE
STEEP = (0.8, 0.0, f32(0.6))


def scripted(
    *answers: TransitionState, state: int = 0, acts: tuple[Callable[[Transition], None], ...] = ()
) -> tuple[Transition, ScriptedCell]:
    """Return a transition in one cell that answers from a script."""
    cell = ScriptedCell(answers, acts=acts)
    made = transition(
        ScriptedWorld(cell),
        at(0.0, 0.0, 8.0),
        at(1.0, 0.0, 8.0),
        state=state,
        spheres=((0.0, 0.5), (1.0, 0.5)),
        moving=mover(step_up=0.5, step_down=0.75),
    )
    return made, cell


def contact(*normal: float) -> Callable[[Transition], None]:
    """Return an act that gives a contact plane, as a tree would."""
    return lambda made: made.collision_info.set_contact_plane(
        Plane(vec(*(normal or (0.0, 0.0, 1.0))), 0.0), 0
    )


def nothing(_: Transition) -> None:
    """Do nothing."""


def floor_walkable(made: Transition, *, x: float = 0.0) -> None:
    """Remember the floor as walkable, with the sphere at `x` in its space."""
    sphere = Sphere(vec(x, 0.0, 0.4), 0.5)
    made.sphere_path.set_walkable(sphere, polygon(FLOOR), vec(0.0, 0.0, 1.0), Position(CELL), 1.0)


def test_a_failed_step_up_goes_back_without_its_contact_plane() -> None:
    """SU-6: the check position is restored; the contact plane is not."""
    made, _ = scripted(OK)
    contact()(made)
    made.sphere_path.add_offset_to_check_pos(vec(0.25, 0.0, 0.0))
    assert made.step_up(vec(-1.0, 0.0, 0.0)) == 0
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.25, 0.0, 8.0)
    assert made.collision_info.contact_plane_valid == 0
    assert (made.sphere_path.step_up, xyz(made.sphere_path.step_up_normal)) == (0, (-1.0, 0.0, 0.0))


def test_a_step_up_onto_ground_too_steep_keeps_the_plane_it_found() -> None:
    """SU-6, SD-4: the failure leaves whatever plane the probe found, valid."""
    made, _ = scripted(OK, state=ON_WALKABLE_OI, acts=(contact(*STEEP),))
    assert made.step_up(vec(-1.0, 0.0, 0.0)) == 0
    assert made.collision_info.contact_plane_valid == 1
    assert made.sphere_path.walkable_allowance == FLOOR_Z


@pytest.mark.parametrize(("state", "height"), [(0, SMALL_STEP), (ON_WALKABLE_OI, 0.5)])
def test_the_step_height_depends_on_the_ground(state: int, height: float) -> None:
    """SU-2: 0.04 unless on a walkable; stepping up moves nothing down (SD-2)."""
    made, cell = scripted(OK, OK, state=state, acts=(contact(),))
    assert made.step_up(vec(-1.0, 0.0, 0.0)) == 1
    assert made.sphere_path.step_down_amt == height
    assert cell.origins == [(0.0, 0.0, 8.0)] * 2


def test_a_step_down_lowers_and_stays_lowered_when_it_fails() -> None:
    """SD-2, SD-5."""
    made, cell = scripted(OK)
    assert made.step_down(0.5, Z_LANDING) == 0
    assert cell.origins == [(0.0, 0.0, 7.5)]
    sp = made.sphere_path
    assert (sp.check_pos.frame.origin.z, sp.global_sphere[0].center.z, sp.step_down) == (7.5, 7.5, 0)


def test_ground_at_the_limit_is_accepted() -> None:
    """SD-4: the plane's z may equal the limit, unlike a polygon's."""
    made, _ = scripted(OK, OK, acts=(contact(0.0, 0.0, FLOOR_Z),))
    assert made.step_down(0.5, FLOOR_Z) == 1


def test_the_ground_must_also_hold_the_mover_as_a_placement() -> None:
    """SD-6: the insert type is PLACEMENT for one more insert, then comes back through the slot."""
    seen: list[InsertType] = []

    def note(made: Transition) -> None:
        seen.append(made.sphere_path.insert_type)

    made, _ = scripted(OK, COLLIDED, acts=(contact(), note))
    assert made.step_down(0.5, Z_LANDING) == 0
    assert seen == [InsertType.PLACEMENT]
    assert (made.sphere_path.insert_type, made.sphere_path.backup) == (InsertType.TRANSITION,) * 2


def test_off_walkable_ground_everything_supports() -> None:
    """WK-1: no probe."""
    made, cell = scripted()
    assert made.check_walkable(FLOOR_Z) == 1
    assert cell.origins == []


@pytest.mark.parametrize(("answer", "supported"), [(COLLIDED, 1), (OK, 0)])
def test_the_probe_touches_or_not_and_leaves_no_trace(answer: TransitionState, supported: int) -> None:
    """WK-3…8: the position comes back from locals, the backup slot is untouched, the allowance stays."""
    made, cell = scripted(answer, state=ON_WALKABLE_OI)
    floor_walkable(made, x=9.0)
    sp = made.sphere_path
    sp.backup_check_pos.assign(at(3.0, 3.0, 3.0))
    assert made.check_walkable(FLOOR_Z) == supported
    assert cell.origins == [(0.0, 0.0, 7.25)]
    assert xyz(sp.check_pos.frame.origin) == (0.0, 0.0, 8.0)
    assert xyz(sp.backup_check_pos.frame.origin) == (3.0, 3.0, 3.0)
    assert (sp.walkable_allowance, sp.check_walkable) == (FLOOR_Z, 0)


def test_the_probe_of_one_sphere_is_half_its_radius() -> None:
    """WK-5: a step longer than the diameter becomes half the radius, unrounded."""
    cell = ScriptedCell([OK])
    made = transition(
        ScriptedWorld(cell), at(0.0, 0.0, 8.0), at(1.0, 0.0, 8.0), state=ON_WALKABLE_OI, spheres=((0.0, 0.5),)
    )
    floor_walkable(made, x=9.0)
    made.check_walkable(FLOOR_Z)
    assert cell.origins == [(0.0, 0.0, 7.75)]


def test_the_probe_of_two_spheres_is_halved_only_beyond_the_diameter() -> None:
    """WK-5: a step of exactly the diameter is probed whole."""
    for step, depth in ((1.0, 1.0), (1.25, 0.625)):
        made, cell = scripted(OK, state=ON_WALKABLE_OI)
        made.object_info.step_down_height = step
        floor_walkable(made, x=9.0)
        made.check_walkable(FLOOR_Z)
        assert cell.origins == [(0.0, 0.0, 8.0 - depth)]


def lowered(state: int, **changes: object) -> Transition:
    """Return a grounded transition after a failed step down of 0.5 from a saved position."""
    made, _ = scripted(*[OK] * 5, state=state)
    made.sphere_path.save_check_pos()
    made.step_down(0.5, FLOOR_Z)
    for name, value in changes.items():
        setattr(made.sphere_path, name, value)
    return made


def test_without_edge_slide_the_mover_leaves_the_ground() -> None:
    """ES-1: back to the saved position, OK, no contact."""
    made = lowered(CONTACT_OI | ON_WALKABLE_OI)
    contact()(made)
    assert made.edge_slide(0.5, FLOOR_Z) == (1, OK)
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.0, 0.0, 8.0)
    assert made.collision_info.contact_plane_valid == 0


def test_ground_too_steep_makes_a_cliff() -> None:
    """ES-2: the slide acts on the restored position and goes on with the loop."""
    made = lowered(WALKING)
    made.collision_info.last_known_contact_plane.N.assign(vec(0.0, 0.0, 1.0))
    contact(*STEEP)(made)
    made.sphere_path.backup_check_pos.assign(at(0.25, 0.0, 8.0))
    assert made.edge_slide(0.5, FLOOR_Z) == (0, ADJUSTED)
    assert made.collision_info.contact_plane_valid == 0


def test_a_known_polygon_makes_a_precipice() -> None:
    """ES-3: no crossed edge is a stop with COLLIDED."""
    made = lowered(WALKING)
    floor_walkable(made)
    assert made.edge_slide(0.5, FLOOR_Z) == (1, COLLIDED)
    assert made.sphere_path.walkable is None


def test_contact_without_a_polygon_leaves_the_ground() -> None:
    """ES-4: a plane that is walkable but has no polygon (terrain) ends with OK."""
    made = lowered(WALKING)
    contact()(made)
    assert made.edge_slide(0.5, FLOOR_Z) == (1, OK)


def test_ground_at_the_limit_is_no_cliff() -> None:
    """ES-2: only a plane strictly below the limit is; at the limit ES-4 answers."""
    made = lowered(WALKING)
    contact(0.0, 0.0, FLOOR_Z)(made)
    assert made.edge_slide(0.5, FLOOR_Z) == (1, OK)


def test_nothing_below_steps_back_and_collides() -> None:
    """ES-5, ES-7: the probe at the last accepted position finds nothing either."""
    made = lowered(WALKING)
    made.sphere_path.backup_check_pos.assign(at(0.25, 0.0, 8.0))
    assert made.edge_slide(0.5, FLOOR_Z) == (1, COLLIDED)
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.25, 0.0, 8.0)


def test_walking_off_a_floor_slides_along_its_edge() -> None:
    """ES-5, ES-6 or ES-3: a walker who leaves the floor at x = 5 obliquely stays at its rim."""
    made = transition(world_of(FLOOR), at(5.2, 0, 0.48), at(5.5, 0.2, 0.48), state=WALKING, moving=mover())
    made.init_contact_plane(CELL, Plane(vec(0.0, 0.0, 1.0), 0.0), 0)
    assert made.find_valid_position() == 1
    origin = made.sphere_path.curr_pos.frame.origin
    assert origin.x <= f32(5.2)
    assert origin.y > 0.0
    assert made.object_info.state == WALKING


def cliff(k_sign: float) -> Transition:
    """Return a transition displaced by a quarter along or against the cliff's normal, which is x."""
    made, _ = scripted()
    made.collision_info.last_known_contact_plane.N.assign(vec(0.0, 0.0, 1.0))
    made.sphere_path.add_offset_to_check_pos(vec(0.25 * k_sign, 0.5, 0.0))
    return made


def test_a_cliff_removes_a_displacement_along_its_normal() -> None:
    """CS-6: the component goes, the collision normal is turned round."""
    made = cliff(1.0)
    assert made.cliff_slide(Plane(vec(*STEEP), 0.0)) == ADJUSTED
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.0, 0.5, 8.0)
    assert xyz(made.collision_info.collision_normal) == (-1.0, 0.0, 0.0)


def test_a_cliff_doubles_a_displacement_against_its_normal() -> None:
    """CS-5: not removed but doubled; so it is in retail."""
    made = cliff(-1.0)
    assert made.cliff_slide(Plane(vec(*STEEP), 0.0)) == ADJUSTED
    assert xyz(made.sphere_path.check_pos.frame.origin) == (-0.5, 0.5, 8.0)
    assert xyz(made.collision_info.collision_normal) == (1.0, 0.0, 0.0)


def test_a_cliff_across_the_displacement_keeps_its_normal() -> None:
    """CS-5: no displacement along the normal counts as against it."""
    made = cliff(0.0)
    assert made.cliff_slide(Plane(vec(*STEEP), 0.0)) == ADJUSTED
    assert xyz(made.sphere_path.check_pos.frame.origin) == (0.0, 0.5, 8.0)
    assert xyz(made.collision_info.collision_normal) == (1.0, 0.0, 0.0)


def test_equal_planes_make_no_cliff() -> None:
    """CS-3: parallel planes have no common line."""
    made = cliff(1.0)
    assert made.cliff_slide(Plane(vec(0.0, 0.0, 1.0), 0.0)) == OK
    assert made.collision_info.collision_normal_valid == 0
