"""Neutral geometry and cells as the engine's shapes and worlds; a geometry is compiled once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final
from weakref import WeakKeyDictionary

from conformance.scenes import model
from engine.cells import Cell
from engine.geometry import Leaf, Node, Shape
from engine.objects import Obstacle
from engine.pose import Pose
from engine.world import World

if TYPE_CHECKING:
    from collections.abc import Mapping, MutableMapping, Sequence

    from engine.geometry import Tree


SOLE_CELL: Final = 0x00010100
"""Id of the cell that holds a geometry which is asked about by itself."""

_shapes: Final[MutableMapping[model.Geometry, Shape]] = WeakKeyDictionary()
_worlds: Final[MutableMapping[model.Geometry, World]] = WeakKeyDictionary()


def engine_shape(geometry: model.Geometry) -> Shape:
    """Return the engine's form of a geometry, the same one for the same geometry object."""
    shape = _shapes.get(geometry)
    if shape is None:
        shape = _shapes[geometry] = _shape(geometry, geometry.cell_planes)
    return shape


def unbounded_shape(geometry: model.Geometry) -> Shape:
    """Return the form of a geometry that, as a cell, contains every point."""
    return engine_shape(geometry) if geometry.cell_planes is None else _shape(geometry, None)


def _shape(geometry: model.Geometry, cell_planes: Sequence[Sequence[float]] | None) -> Shape:
    return Shape(
        geometry.vertices,
        [polygon.vertices for polygon in geometry.polygons],
        _tree(geometry.tree),
        cell_planes,
        name=geometry.name,
    )


def sole_world(geometry: model.Geometry) -> World:
    """Return a world of one cell at the origin, with this geometry."""
    world = _worlds.get(geometry)
    if world is None:
        cell = Cell(SOLE_CELL, Pose(SOLE_CELL), engine_shape(geometry))
        world = _worlds[geometry] = World([cell])
    return world


def world_of(cells: Sequence[Mapping[str, Any]], geometries: Mapping[str, model.Geometry]) -> World:
    """Return the world of a CELLS block."""
    return World([_cell(cell, geometries) for cell in cells])


def world_around(inputs: Mapping[str, Any], geometry: model.Geometry) -> World:
    """Return the world of a ``find_collisions`` query: one cell, which is or holds the geometry."""
    pose, shape = engine_pose(inputs["pose"]), engine_shape(geometry)
    if inputs["as"] == "cell":
        if inputs["scale"] != 1.0:
            raise ValueError(f"a cell is tested at scale 1, not {inputs['scale']}")
        return World([Cell(pose.cell, pose, shape)])
    return World([Cell(pose.cell, pose, None, [Obstacle.solid(shape, pose, inputs["scale"])])])


def engine_pose(pose: Mapping[str, Any]) -> Pose:
    """Return the engine's form of a POSE block."""
    return Pose(pose["cell"], pose["origin"], pose["rotation"])


def _cell(cell: Mapping[str, Any], geometries: Mapping[str, model.Geometry]) -> Cell:
    objects = [
        Obstacle.solid(
            engine_shape(geometries[static["geometry"]]),
            engine_pose(static["pose"]),
            static["scale"],
            static["state"],
        )
        for static in cell.get("statics", ())
    ]
    name = cell["geometry"]
    shape = None if name is None else engine_shape(geometries[name])
    return Cell(cell["id"], engine_pose(cell["pose"]), shape, objects, cell.get("portals", ()))


def _tree(tree: model.Tree) -> Tree:
    """Convert a tree, children before parents, without recursion: trees can be deep."""
    done: list[Tree] = []
    stack: list[tuple[model.Tree, bool]] = [(tree, False)]
    while stack:
        item, children_done = stack.pop()
        if isinstance(item, model.Leaf):
            done.append(Leaf(item.sphere, item.polygons, item.solid))
        elif children_done:
            negative, positive = done.pop(), done.pop()
            done.append(Node(item.plane, item.sphere, positive, negative))
        else:
            stack += [(item, True), (item.negative, False), (item.positive, False)]
    return done.pop()
