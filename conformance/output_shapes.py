"""The shapes of output fields that several operations share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.shapes import Block, Kind, Listing, Nullable, Scalar, Vector

if TYPE_CHECKING:
    from conformance.shapes import Shape

FLOAT: Final = Scalar(Kind.FLOAT32)
DOUBLE: Final = Scalar(Kind.FLOAT64)
FLAG: Final = Scalar(Kind.FLAG)
COUNT: Final = Scalar(Kind.COUNT)
STATE: Final = Scalar(Kind.STATE)
BITS: Final = Scalar(Kind.BITS)
MOVER_BITS: Final = Scalar(Kind.MOVER_BITS)
CELL: Final = Scalar(Kind.CELL)
POLYGON: Final = Nullable(Scalar(Kind.POLYGON))
TEXT: Final = Scalar(Kind.TEXT)
ANSWER: Final = Scalar(Kind.ANSWER)
POINT: Final = Vector(("x", "y", "z"))
OPTIONAL_POINT: Final = Nullable(POINT)
QUATERNION: Final = Vector(("w", "x", "y", "z"))
PLANE: Final = Vector(("n.x", "n.y", "n.z", "d"))
MATRIX: Final = Vector(tuple(f"m{i}" for i in range(9)))
POINTS: Final = Listing(POINT)
SPHERES: Final = Listing(Vector(("x", "y", "z", "r")))

POSE: Final = Block({"cell": CELL, "origin": POINT, "rotation": QUATERNION})
SEEDED_PLANE: Final = Block(
    {"valid": FLAG, "plane": PLANE, "cell_id": CELL, "is_water": FLAG},
    optional=frozenset({"plane", "cell_id", "is_water"}),
    silent=frozenset({"plane"}),
)

STATE_FIELDS: Final[dict[str, Shape]] = {
    "trace": TEXT,
    "check": POSE,
    "curr": POSE,
    "check_cell": CELL,
    "curr_cell": CELL,
    "global_spheres": POINTS,
    "contact_plane": SEEDED_PLANE,
    "last_known_contact_plane": SEEDED_PLANE,
    "collision_normal": OPTIONAL_POINT,
    "sliding_normal": OPTIONAL_POINT,
    "walkable": POLYGON,
    "walkable_geometry": TEXT,
    "walk_interp": FLOAT,
    "walkable_allowance": FLOAT,
    "collide": FLAG,
    "step_up": FLAG,
    "step_up_normal": POINT,
    "neg_poly_hit": FLAG,
    "neg_step_up": FLAG,
    "neg_normal": POINT,
    "frames_stationary_fall": COUNT,
    "collided_with_environment": FLAG,
    "state": MOVER_BITS,
    "kill_velocity": COUNT,
}
OBJECT_FIELDS: Final[dict[str, Shape]] = {
    "collide_objects": Listing(COUNT),
    "last_collided": COUNT,
    "obstruction_ethereal": FLAG,
    "hits_interior_cell": FLAG,
}
_WHEN_SET: Final = frozenset({"walkable_geometry", "neg_step_up", "neg_normal"})


def only(**fields: Shape) -> Block:
    """Return a block of these fields, all of them always there."""
    return Block(fields)


def state(first: dict[str, Shape], *, objects: bool = False) -> Block:
    """Return some fields and the state block, where there are objects also what was touched."""
    more = OBJECT_FIELDS if objects else {}
    return Block({**first, **STATE_FIELDS, **more}, optional=_WHEN_SET)


MOVED: Final = only(v=POINT)
ACCELERATED: Final[dict[str, Shape]] = {"acceleration": POINT, "omega": POINT}
WRITTEN_BACK: Final[dict[str, Shape]] = {
    "lost": FLAG,
    "position": POSE,
    "contact_plane": PLANE,
    "contact_plane_cell": CELL,
    "sliding_normal": POINT,
    "transient_state": BITS,
    "velocity": POINT,
    **ACCELERATED,
    "state": BITS,
    "colliding_with_environment": FLAG,
}
"""What a body has taken over from a finished transition."""
