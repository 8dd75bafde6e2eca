"""The neutral scene model: plain data that every candidate is given.

Numbers are Python floats that are exactly representable as float32. Geometry is what the game's
data files hold: vertices, polygons by vertex index, and a BSP tree that is *input*, not derived.
Nothing here computes; adapters turn it into the oracle's and the engine's own worlds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from conformance.floats import to_float32

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

Vec3: TypeAlias = tuple[float, float, float]
"""x, y, z in metres (or a direction)."""
Quaternion: TypeAlias = tuple[float, float, float, float]
"""w, x, y, z."""
PlaneData: TypeAlias = tuple[float, float, float, float]
"""nx, ny, nz, d with n . p + d = 0."""
SphereData: TypeAlias = tuple[float, float, float, float]
"""x, y, z, radius."""


@dataclass(frozen=True, slots=True)
class Pose:
    """A rigid pose in a landblock: the cell whose block the origin is in, origin, rotation.

    Attributes
    ----------
    cell : int
        Cell id; its high 16 bits name the landblock.
    origin : Vec3
        Metres, in the landblock's frame.
    rotation : Quaternion
        ``w, x, y, z``; copied unnormalised into retail's frame.
    """

    cell: int
    origin: Vec3
    rotation: Quaternion = (1.0, 0.0, 0.0, 0.0)

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Pose:
        """Read the POSE block of a vector record."""
        return cls(record["cell"], _floats(record["origin"]), _floats(record["rotation"]))

    def to_record(self) -> dict[str, Any]:
        """Write the POSE block of a vector record."""
        return {"cell": self.cell, "origin": list(self.origin), "rotation": list(self.rotation)}


@dataclass(frozen=True, slots=True)
class Polygon:
    """One polygon: vertex indices, counter-clockwise from its front; its plane comes from them."""

    vertices: tuple[int, ...]
    sides: int = 0


@dataclass(frozen=True, slots=True)
class Leaf:
    """A BSP leaf: the polygons tested in it, in order, and whether it is solid."""

    index: int
    solid: bool
    sphere: SphereData
    polygons: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Node:
    """An interior BSP node; `polygons` is informative (those on the splitting plane)."""

    plane: PlaneData
    sphere: SphereData
    polygons: tuple[int, ...]
    positive: Tree
    negative: Tree


Tree: TypeAlias = Node | Leaf


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class Geometry:
    """A cell's or a part's collision geometry, compared by identity (it is shared and large).

    Attributes
    ----------
    name : str
        What records call it.
    vertices : tuple of Vec3
        Metres, in the geometry's own (cell- or part-local) frame.
    polygons : tuple of Polygon
        A polygon's id is its index.
    tree : Tree
        The physics BSP.
    cell_planes : tuple of PlaneData or None
        The cell BSP as a chain of containment planes, outermost first; None contains everything.
    kind : str
        What made it (``room``, ``ramp`` ...), for reports.
    """

    name: str
    vertices: tuple[Vec3, ...]
    polygons: tuple[Polygon, ...]
    tree: Tree
    cell_planes: tuple[PlaneData, ...] | None = None
    kind: str = ""

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Geometry:
        """Read a line of a geometry file."""
        planes = record.get("cell_bsp")
        return cls(
            name=record["name"],
            vertices=tuple(_floats(v) for v in record["vertices"]),
            polygons=tuple(Polygon(tuple(p["v"]), p.get("sides", 0)) for p in record["polygons"]),
            tree=tree_from_record(record["bsp"]),
            cell_planes=None if planes is None else tuple(_floats(p) for p in planes),
            kind=record.get("kind", ""),
        )

    def to_record(self) -> dict[str, Any]:
        """Write a line of a geometry file."""
        record: dict[str, Any] = {
            "name": self.name,
            "kind": self.kind,
            "vertices": [list(v) for v in self.vertices],
            "polygons": [{"v": list(p.vertices), "sides": p.sides} for p in self.polygons],
            "bsp": tree_to_record(self.tree),
        }
        if self.cell_planes is not None:
            record["cell_bsp"] = [list(p) for p in self.cell_planes]
        return record

    def corners(self, polygon: int) -> tuple[Vec3, ...]:
        """Return the corner points of a polygon, in winding order."""
        return tuple(self.vertices[i] for i in self.polygons[polygon].vertices)


@dataclass(frozen=True, slots=True)
class Static:
    """A static object with one BSP-shaped part."""

    geometry: Geometry
    pose: Pose
    scale: float = 1.0
    state: int = 0x10001

    def to_record(self) -> dict[str, Any]:
        """Write the STATIC block of a vector record."""
        return {
            "geometry": self.geometry.name,
            "pose": self.pose.to_record(),
            "scale": self.scale,
            "state": self.state,
        }


@dataclass(frozen=True, slots=True)
class Cell:
    """An environment cell: a pose, a physics BSP (or none), static objects, portals to other cells."""

    id: int
    pose: Pose
    geometry: Geometry | None
    statics: tuple[Static, ...] = ()
    portals: tuple[int, ...] = ()

    def to_record(self) -> dict[str, Any]:
        """Write one entry of the CELLS block of a vector record."""
        record: dict[str, Any] = {
            "id": self.id,
            "pose": self.pose.to_record(),
            "geometry": None if self.geometry is None else self.geometry.name,
        }
        if self.portals:
            record["portals"] = list(self.portals)
        if self.statics:
            record["statics"] = [static.to_record() for static in self.statics]
        return record


@dataclass(frozen=True, slots=True)
class Scene:
    """The cells that a query runs in."""

    cells: tuple[Cell, ...]
    title: str = field(default="", compare=False)

    def geometries(self) -> Iterator[Geometry]:
        """Yield every geometry of the scene once, in order of first use."""
        seen: set[int] = set()
        for cell in self.cells:
            shapes = [cell.geometry, *(static.geometry for static in cell.statics)]
            for geometry in shapes:
                if geometry is not None and id(geometry) not in seen:
                    seen.add(id(geometry))
                    yield geometry


def walk_tree(tree: Tree) -> Iterator[Tree]:
    """Yield a tree's nodes and leaves, positive before negative, without recursion."""
    stack = [tree]
    while stack:
        node = stack.pop()
        yield node
        if isinstance(node, Node):
            stack.append(node.negative)
            stack.append(node.positive)


def tree_from_record(record: Mapping[str, Any]) -> Tree:
    """Read a NODE of a geometry record, however deep it is."""
    done: list[Tree] = []
    stack: list[tuple[Mapping[str, Any], bool]] = [(record, False)]
    while stack:
        item, children_done = stack.pop()
        sphere = _floats(item["sphere"])
        polygons = tuple(item["polys"])
        if "leaf" in item:
            done.append(Leaf(item["leaf"], bool(item["solid"]), sphere, polygons))
        elif children_done:
            negative, positive = done.pop(), done.pop()
            done.append(Node(_floats(item["plane"]), sphere, polygons, positive, negative))
        else:
            stack += [(item, True), (item["neg"], False), (item["pos"], False)]
    return done.pop()


def tree_to_record(tree: Tree) -> dict[str, Any]:
    """Write a NODE of a geometry record, however deep it is."""
    root: dict[str, Any] = {}
    stack: list[tuple[Tree, dict[str, Any]]] = [(tree, root)]
    while stack:
        node, out = stack.pop()
        if isinstance(node, Leaf):
            out.update(leaf=node.index, solid=int(node.solid))
        else:
            out["plane"] = list(node.plane)
        out.update(sphere=list(node.sphere), polys=list(node.polygons))
        if isinstance(node, Node):
            out["pos"], out["neg"] = {}, {}
            stack += [(node.negative, out["neg"]), (node.positive, out["pos"])]
    return root


def _floats(values: Sequence[float]) -> Any:
    return tuple(to_float32(v) for v in values)
