"""Comparisons of documents 01, 04 and 05 that one call decides: offsets, slides, slopes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.strategies.human import HUMAN, MOVER
from conformance.stress.comparisons.base import RADIUS, Comparison, ask, in_leaf, triangle_plane
from conformance.stress.moves import CELL, IDENTITY, ON_GROUND, pose
from conformance.vector_io import query_from_record
from oracle.constants import EPS, FLOOR_Z, Z_LANDING

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from conformance.scenes.model import Quaternion

PLACE: Final = (100.3, 50.7, 12.1)
"""Where a frame is, metres: in the middle of a landblock."""
TURN: Final = (0.8, 0.4, 0.4, 0.2)
"""Its rotation."""
VIEWER: Final = 0x4
OWN: Final = 1.5
"""A body's velocity along an axis, m/s."""
FLOOR: Final = (0.0, 0.0, 1.0, 0.0)
_XY: Final = ("end x (m)", "end y (m)")


def _moved(end: tuple[float, float, float], **inputs: Any) -> dict[str, Any]:
    mover = {**MOVER, "spheres": HUMAN, "state": ON_GROUND}
    return {"mover": mover, "from": pose(IDENTITY, (0.0, 0.0, 0.0)), "to": pose(IDENTITY, end), **inputs}


def _seed(plane: tuple[float, ...]) -> dict[str, Any]:
    return {"contact": {"plane": list(plane), "cell": CELL, "is_water": 0}}


def _equal_frames(x: float, other: float) -> Query:
    here, there = (pose(IDENTITY, (value, *PLACE[1:])) for value in (other, x))
    return ask("frame_is_equal", a=here, b=there)


def _turn(part: int, value: float) -> Quaternion:
    w, x, y, z = (value if index == part else number for index, number in enumerate(TURN))
    return w, x, y, z


def _equal_rotations(part: int) -> Callable[[float, float], Query]:
    """Make queries about frames whose rotations differ in one part of the quaternion."""

    def query(value: float, other: float) -> Query:
        here, there = (pose(_turn(part, number), PLACE) for number in (other, value))
        return ask("frame_is_equal", a=here, b=there)

    return query


def _other_velocity(axis: int) -> Callable[[float, float], Query]:
    """Make queries about a body that is given a velocity which differs from its own along one axis."""

    def query(value: float, own: float) -> Query:
        old, new = ([0.3 if index != axis else number for index in range(3)] for number in (own, value))
        return ask("set_velocity", body={"velocity": old}, v=new, update_time=3.0, cur_time=7.0)

    return query


def _small(x: float, y: float) -> Query:
    return ask("normalize_check_small", v=[x, y, 5e-5])


def _against_sliding(x: float, y: float) -> Query:
    seed = {**_seed(FLOOR), "sliding": [0.6, 0.8, 0.0]}
    return ask("adjust_offset", **_moved((0.1, 0.0, 0.0), seed=seed, offset=[x, y, 0.02]))


def _lifted(z: float, x: float) -> Query:
    end, ball = (x, -0.1, z), {**MOVER, "spheres": [(0.0, 0.0, 0.0, RADIUS)], "state": ON_GROUND}
    return ask(
        "adjust_offset", **_moved(end, mover=ball, seed=_seed(triangle_plane()), offset=[0.1, 0.02, 0.0])
    )


def _too_deep(nz: float, x: float) -> Query:
    """Lie in a plane that is so steep that the way up is longer than the sphere's radius."""
    ball = {**MOVER, "spheres": [(0.0, 0.0, 0.0, RADIUS)], "state": ON_GROUND}
    plane = (1.0, 0.0, nz, 0.0)
    return ask(
        "adjust_offset", **_moved((x, -0.1, 0.0), mover=ball, seed=_seed(plane), offset=[0.0, 0.1, 0.0])
    )


def _off_a_cliff(x: float, y: float) -> Query:
    seed = {"last_known": {"plane": [0.6, 0.0, 0.8, 0.0], "cell": CELL, "is_water": 0}}
    return ask("cliff_slide", **_moved((x, y, -0.1), seed=seed, plane=[-0.6, 0.64, 0.48, 0.0]))


def _sub_steps(x: float, y: float) -> Query:
    return ask("calc_num_steps", **_moved((x, y, 0.1)))


def _seen_sub_steps(x: float, y: float) -> Query:
    return ask("calc_num_steps", **_moved((x, y, 0.0), mover={**MOVER, "spheres": HUMAN, "state": VIEWER}))


def _too_short(x: float, y: float) -> Query:
    return ask("slide_sphere", **_moved((x, y, 0.0), seed=_seed(FLOOR), normal=[0.0, -0.6, 0.8]))


def _parallel(x: float, y: float) -> Query:
    return ask("slide_sphere", **_moved((0.1, 0.2, -0.1), seed=_seed(FLOOR), normal=[x, y, -0.99]))


def _tilted(rise: float, depth: float, allowance: float, path: dict[str, float]) -> Query:
    """Step or land on a polygon that rises over a depth; the sphere is in its plane by half the radius."""
    corners = ((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, depth, rise))
    length = (rise * rise + depth * depth) ** 0.5
    out, up = -rise / length, depth / length
    foot = (0.1, depth * 0.3 + 0.24 * out, rise * 0.3 + 0.24 * up - 0.48)
    geometry = in_leaf(corners, "slope")
    record = {
        "op": "find_collisions",
        "geometry": geometry.name,
        "pose": pose(IDENTITY, (0.0, 0.0, 0.0)),
        "scale": 1.0,
        "as": "cell",
        **_moved(foot),
        "from": pose(IDENTITY, (foot[0], foot[1] + out, foot[2] + up)),
        "seed": {},
        "path": {"walk_interp": 1.0, "walkable_allowance": allowance, **path},
    }
    return query_from_record(record, {geometry.name: geometry})


def _walkable(rise: float, depth: float) -> Query:
    return _tilted(rise, depth, FLOOR_Z, {"step_down": 1, "step_down_amt": 1.0})


def _landing(rise: float, depth: float) -> Query:
    return _tilted(rise, depth, Z_LANDING, {"collide": 1})


def _resting(share: float) -> float:
    """Return the z of a centre whose sphere is in the triangle's plane by a share of EPS, metres."""
    nx, ny, nz, d = triangle_plane()
    return (RADIUS - share * EPS - d - 0.2 * nx + 0.1 * ny) / nz


def _is_equal(fields: Fields) -> bool:
    return bool(fields["r"])


def _is_kept(fields: Fields) -> bool:
    return not fields["jumped"]


def _is_small(fields: Fields) -> bool:
    return bool(fields["small"])


def _keeps_sliding(fields: Fields) -> bool:
    return bool(fields["sliding_valid"])


def _is_lifted(fields: Fields) -> bool:
    """Tell a sphere that was lifted onto the plane from one that is still in it by nearly EPS."""
    nx, ny, nz, d = triangle_plane()
    x, y, z = fields["global_spheres"][0]
    return bool(nx * x + ny * y + nz * z + d > RADIUS - 0.5 * EPS)


def _is_moved_up(fields: Fields) -> bool:
    return bool(fields["check_origin"][2] != 0.0)


def _turns_round(fields: Fields) -> bool:
    """Tell a crease's normal that points back against the way from one that was turned round."""
    return bool(fields["collision_normal"][0] > 0.0)


def _is_one_step(fields: Fields) -> bool:
    return bool(fields["num_steps"] == 1)


def _is_no_step(fields: Fields) -> bool:
    return bool(fields["num_steps"] == 0)


def _has_slid(fields: Fields) -> bool:
    return bool(fields["result"] == "SLID")


def _has_contact(fields: Fields) -> bool:
    return bool(fields["contact_plane"]["valid"])


STATES: Final = (
    Comparison(
        "frames equal within EPS",
        "01 4.9",
        ("x (m)", "other x (m)"),
        _equal_frames,
        _is_equal,
        (100.3, 100.4),
        100.3,
    ),
    *(
        Comparison(
            f"rotations equal within EPS, {axis}",
            "04 3",
            (axis, f"other {axis}"),
            _equal_rotations(part),
            _is_equal,
            (TURN[part], TURN[part] + 0.1),
            TURN[part],
        )
        for part, axis in enumerate(("w", "x", "y", "z"))
    ),
    *(
        Comparison(
            f"velocities equal within EPS, {name}",
            "04 3",
            (f"{name} (m/s)", f"own {name} (m/s)"),
            _other_velocity(axis),
            _is_kept,
            (OWN, OWN + 0.1),
            OWN,
        )
        for axis, name in enumerate("xyz")
    ),
    Comparison("vector too short", "01 VEC", ("x", "y"), _small, _is_small, (1e-6, 1e-3), 1e-4),
    Comparison(
        "against the sliding normal",
        "05 AD-1",
        ("offset x (m)", "offset y (m)"),
        _against_sliding,
        _keeps_sliding,
        (-0.5, 0.5),
        0.1,
    ),
    Comparison(
        "deep enough to be lifted",
        "05 AD-7",
        ("centre z (m)", "centre x (m)"),
        _lifted,
        _is_lifted,
        (_resting(100.0), _resting(0.75)),
        0.2,
    ),
    Comparison(
        "plane too steep to be lifted",
        "05 AD-7",
        ("normal z", "centre x (m)"),
        _too_deep,
        _is_moved_up,
        (0.5, 3.0),
        -0.4,
    ),
    Comparison("way along a crease", "05 CS-5", _XY, _off_a_cliff, _turns_round, (-0.3, 0.3), 0.2),
    Comparison("one sub-step", "05 NS-5", _XY, _sub_steps, _is_one_step, (0.3, 0.6), 0.1),
    Comparison("camera that does not move", "05 NS-4", _XY, _seen_sub_steps, _is_no_step, (1e-5, 1e-3), 1e-4),
    Comparison("slide too short", "07 6.B", _XY, _too_short, _has_slid, (0.3, 0.0), 0.001),
    Comparison(
        "normal against the contact plane",
        "07 6.B",
        ("normal x", "normal y"),
        _parallel,
        _has_slid,
        (0.2, 0.0),
        0.003,
    ),
    Comparison(
        "slope at floor_z",
        "02 WH-1, floor_z",
        ("rise (m)", "depth (m)"),
        _walkable,
        _has_contact,
        (2.0, 2.5),
        2.0,
    ),
    Comparison(
        "slope at z_for_landing",
        "02 WH-1, landing",
        ("rise (m)", "depth (m)"),
        _landing,
        _has_contact,
        (20.0, 25.0),
        2.0,
    ),
)
"""In the order of the documents."""
