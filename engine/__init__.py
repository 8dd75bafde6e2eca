"""Movement and collision of Asheron's Call's 2013 client, fast, and bit for bit as retail computes it.

A `World` of cells is compiled once; then movers are asked about in it, one by one or in batches:

>>> from engine import Cell, Leaf, Move, Mover, Pose, Shape, World, resolve
>>> floor = Shape([(-5, -5, 0), (5, -5, 0), (0, 5, 0)], [(0, 1, 2)], Leaf((0, 0, 0, 10), (0,)))
>>> world = World([Cell(0x01000100, Pose(0x01000100), floor)])
>>> mover = Mover([(0, 0, 0.5, 0.5)], step_down_height=1.5)
>>> there = Pose(0x01000100, (0, 0, -0.25))
>>> result = resolve(world, Move(mover, there, 0x01000100, start=Pose(0x01000100, (0, 0, 1))))
>>> bool(result["contact_plane_valid"])
True

A `Body` moves by itself, by its velocity, tick after tick:

>>> from engine import Body, step
>>> fallen = step(world, Body(Pose(0x01000100, (0, 0, 1)), [(0, 0, 0.5, 0.5)], velocity=(0, 0, -3)), 0.1)
>>> fallen["origin"].round(3).tolist()
[0.0, 0.0, 0.7]
"""

from engine.batch import (
    find_collisions,
    find_collisions_many,
    find_object_collisions,
    find_object_collisions_many,
    resolve,
    resolve_many,
)
from engine.body import Body, body_rows
from engine.cells import Cell, Portal, Restriction
from engine.errors import (
    CrowdedError,
    EngineError,
    GeometryError,
    InputError,
    PoseError,
    QueryError,
    RecursionBoundError,
    UndeterminedError,
    WorldError,
)
from engine.geometry import Leaf, Node, Shape
from engine.landscape import Building, BuildingPortal, LandBlock
from engine.object_call import ObjectCall, Target
from engine.objects import Obstacle, Part, Weenie
from engine.placing import Placement, PlacementResult, place
from engine.plan import Plan, Stage
from engine.pose import Pose
from engine.prepared import Prepared
from engine.query import CollisionCall, ContactPlane, Move, Mover, PathState, Seed
from engine.step import set_elasticity, set_local_velocity, set_velocity, step, step_many, update_many
from engine.trees import step_down_many, strike_many
from engine.visible import find_visible_child_cell
from engine.warm import warmup
from engine.world import World

__all__ = [
    "Body",
    "Building",
    "BuildingPortal",
    "Cell",
    "CollisionCall",
    "ContactPlane",
    "CrowdedError",
    "EngineError",
    "GeometryError",
    "InputError",
    "LandBlock",
    "Leaf",
    "Move",
    "Mover",
    "Node",
    "ObjectCall",
    "Obstacle",
    "Part",
    "PathState",
    "Placement",
    "PlacementResult",
    "Plan",
    "Portal",
    "Pose",
    "PoseError",
    "Prepared",
    "QueryError",
    "RecursionBoundError",
    "Restriction",
    "Seed",
    "Shape",
    "Stage",
    "Target",
    "UndeterminedError",
    "Weenie",
    "World",
    "WorldError",
    "body_rows",
    "find_collisions",
    "find_collisions_many",
    "find_object_collisions",
    "find_object_collisions_many",
    "find_visible_child_cell",
    "place",
    "resolve",
    "resolve_many",
    "set_elasticity",
    "set_local_velocity",
    "set_velocity",
    "step",
    "step_down_many",
    "step_many",
    "strike_many",
    "update_many",
    "warmup",
]
