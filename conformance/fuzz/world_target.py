"""The target `world`: the engine's world compiler, given shapes, cells, land and objects made of bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from conformance.fuzz.byte_source import ByteSource
from conformance.fuzz.finding import require
from engine import (
    Building,
    BuildingPortal,
    Cell,
    EngineError,
    InputError,
    LandBlock,
    Leaf,
    Move,
    Mover,
    Node,
    Obstacle,
    Part,
    Plan,
    Portal,
    Pose,
    Shape,
    World,
    resolve,
)
from engine.plan import FULL_PLAN, NO_PLAN
from engine.probes import without_work

if TYPE_CHECKING:
    from collections.abc import Mapping

    from engine.geometry import Tree

MOVER: Final = Mover([(0.0, 0.0, 0.48, 0.48)], state=0x103, step_up_height=0.6, step_down_height=1.5)
BLOCK: Final = 0xA9B4
LONGEST: Final = 100.0
"""Metres that the mover is asked to go at most, so that an execution stays short."""
HEIGHTS: Final = 81
_IDENTITY: Final = (1.0, 0.0, 0.0, 0.0)
_DEEPEST: Final = 40
"""Levels of a tree: no longer recursion than Python allows, here or in who walks it."""


def run(data: bytes) -> bool:
    """Compile a world, and move somebody through it; return whether it was accepted.

    Raises
    ------
    FindingError
        An accepted world whose arrays point outside of themselves, in which a mover gets a cell that is
        none, or where shortcuts change the answer.
    """
    source = ByteSource(data)
    try:
        world = _world(source)
    except InputError as error:
        require(error.where and error.problem, f"an error without a place: {error!r}")
        return False
    _check_arrays(world)
    if world.cell_ids:
        _move(source, world)
    return True


def _world(source: ByteSource) -> World:
    shapes = [_shape(source, index) for index in range(source.below(3))]
    things = [_obstacle(source, shapes) for _ in range(source.below(3))]
    cells = [_cell(source, shapes, things, index) for index in range(source.below(4))]
    blocks = [_block(source) for _ in range(source.below(2))]
    houses = [_building(source, shapes) for _ in range(source.below(2))]
    late = [_obstacle(source, shapes)] if source.flag() else []
    return World(cells, blocks, houses, objects=late)


def _shape(source: ByteSource, index: int) -> Shape:
    vertices = [source.numbers(3) for _ in range(source.below(9))]
    count = max(len(vertices), 1) + source.flag()
    polygons = [[source.below(count) for _ in range(2 + source.below(4))] for _ in range(source.below(5))]
    made: list[Tree] = []
    tree = _tree(source, len(polygons), made, 0)
    planes = [source.numbers(4) for _ in range(source.below(3))] if source.flag() else None
    return Shape(vertices, polygons, tree, planes, name=f"shape {index}")


def _tree(source: ByteSource, polygons: int, made: list[Tree], level: int) -> Tree:
    """Return a tree; now and then one whose node is reached twice, or whose leaf misses a polygon."""
    kind = source.below(8)
    if kind == 1 and made:
        return made[source.below(len(made))]
    sphere = source.numbers(4) if kind == 2 else (0.0, 0.0, 0.0, 100.0)
    node: Tree
    if kind >= 5 and level < _DEEPEST:
        plane = source.numbers(4) if kind == 5 else (0.0, 0.0, 1.0, source.number())
        positive = _tree(source, polygons, made, level + 1)
        node = Node(plane, sphere, positive, _tree(source, polygons, made, level + 1))
    else:
        listed = [source.below(polygons + 1) for _ in range(2)] if kind == 3 else range(polygons)
        node = Leaf(sphere, tuple(listed), solid=source.flag())
    made.append(node)
    return node


def _pose(source: ByteSource) -> Pose:
    kind = source.byte()
    cell = source.whole() if kind % 16 == 1 else (BLOCK << 16) + 0x100 + source.below(4)
    rotation = source.numbers(4) if kind % 8 == 2 else _IDENTITY
    return Pose(cell, source.numbers(3), rotation)


def _pick(source: ByteSource, shapes: list[Shape]) -> Shape | None:
    chosen = source.below(len(shapes) + 1)
    return shapes[chosen] if chosen < len(shapes) else None


def _obstacle(source: ByteSource, shapes: list[Shape]) -> Obstacle:
    family = source.below(4)
    scale = source.number() if source.flag() else 1.0
    parts = [Part(_pick(source, shapes), _pose(source) if source.flag() else None, scale)]
    return Obstacle(
        _pose(source),
        scale,
        state=0x10001 if family == 0 else source.byte(),
        parts=parts if family == 0 else (),
        cylspheres=[source.numbers(5)] if family == 1 else (),
        spheres=[source.numbers(4)] if family == 2 else (),
        id=source.byte(),
        sorting_sphere=source.numbers(4) if family == 3 else None,
    )


def _cell(source: ByteSource, shapes: list[Shape], things: list[Obstacle], index: int) -> Cell:
    cell_id = source.whole() if source.flag() else (BLOCK << 16) + 0x100 + index
    portals = [_portal(source) for _ in range(source.below(3))]
    objects = [thing for thing in things if source.flag()]
    pose = Pose(cell_id, (0.0, 0.0, 0.0)) if source.below(4) else _pose(source)
    return Cell(cell_id, pose, _pick(source, shapes), objects, portals, [source.byte()])


def _portal(source: ByteSource) -> Portal:
    other = None if source.flag() else (BLOCK << 16) + 0x100 + source.below(5)
    polygon = [source.numbers(3) for _ in range(2 + source.below(3))] if source.below(3) else None
    return Portal(other, polygon, source.below(3))


def _block(source: ByteSource) -> LandBlock:
    height = source.number() if source.flag() else 0.0
    words = [source.byte()] * (HEIGHTS - source.flag()) if source.flag() else None
    return LandBlock(source.whole() if source.flag() else BLOCK, [height] * (HEIGHTS - source.flag()), words)


def _building(source: ByteSource, shapes: list[Shape]) -> Building:
    portals = [BuildingPortal((BLOCK << 16) + 0x100 + source.below(3), source.below(4) - 1)]
    return Building(_pose(source), _pick(source, shapes), portals)


def _check_arrays(world: World) -> None:
    """Check what kernels take for granted: that lists and trees end inside the arrays."""
    require(np.isfinite(world.ints).all(), "integers that are none")
    for index in range(len(world.cell_ids)):
        require(all(0 <= thing < world.num_objects for thing in world.objects_of(index)), f"cell {index}")
        require(0 <= world.tree_of(index) < len(world.ints), f"the tree of cell {index}")
    for shape in world.shapes:
        require(0 < shape.depth <= len(shape.node_ints), f"the depth of {shape!r}")
        require((shape.leaf_polygons < shape.num_polygons).all(), f"the leaves of {shape!r}")


def _move(source: ByteSource, world: World) -> None:
    cell_id = world.cell_ids[source.below(len(world.cell_ids))]
    start, end = (Pose(cell_id, [_near(source.number()) for _ in range(3)]) for _ in range(2))
    move = Move(MOVER, end, cell_id, start=start)
    first, slowly = (_answer(world, move, plan) for plan in (FULL_PLAN, NO_PLAN))
    world.prepare()
    for result in (first, _answer(world, move, FULL_PLAN)):
        require(result == slowly, f"with shortcuts {result}, without them {slowly}")


def _answer(world: World, move: Move, plan: Plan) -> Mapping[str, object]:
    """Return what is answered but for the work that it took: each field's bytes, or the error."""
    try:
        result = resolve(world, move, plan=plan)
    except EngineError as error:
        require(str(error), f"an error without words: {error!r}")
        return {"error": str(error)}
    require(-1 <= int(result["curr_cell"]) < len(world.cell_ids), f"the cell {result['curr_cell']}")
    return without_work(result)


def _near(number: float) -> float:
    """Return a number that is near enough to walk to; what is none stays none."""
    return number if not abs(number) > LONGEST else LONGEST
