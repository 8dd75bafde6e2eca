"""Laws of the axes: quarter turns about z, and mirrors. They hold bit for bit where all faces are square.

A quarter turn of the *pose* is not exact: the nearest float32 quaternion gives a matrix with 6e-8 where a
zero should be. Here the coordinates themselves are exchanged and negated, which rounds nothing, and rotations
stay the identity. Each coordinate then goes through the same operations as before under another name. What
could differ is the order in which products of different coordinates are added; where every face is square
to the axes, all but one of the products are zero.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

from conformance.laws.law import Law, unlike
from conformance.laws.square import square_queries
from conformance.scenes.model import Geometry, Leaf, Node, Polygon

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.laws.law import Ask
    from conformance.query import Fields, Query
    from conformance.scenes.model import Tree

_POINTS: Final = ("collision_normal", "sliding_normal", "step_up_normal", "neg_normal")
_PLANES: Final = ("contact_plane", "last_known_contact_plane")
_POSES: Final = ("pose", "from", "to", "check", "curr")


@dataclass(frozen=True, slots=True)
class SignedAxes:
    """Takes x and y to each other, or keeps them, with signs; z stays, for it is up.

    Attributes
    ----------
    name : str
        For messages.
    exchange : bool
        Whether x and y change places.
    signs : (float, float)
        What the new x and y are multiplied by.
    """

    name: str
    exchange: bool
    signs: tuple[float, float]

    @property
    def mirrors(self) -> bool:
        """Whether it makes counter-clockwise clockwise."""
        return (self.signs[0] * self.signs[1] < 0.0) is not self.exchange

    def __call__(self, vector: Sequence[float]) -> list[float]:
        """Take a point, a direction, a plane or a sphere there; what follows x, y, z stays."""
        x, y, *rest = vector
        if self.exchange:
            x, y = y, x
        return [self.signs[0] * x, self.signs[1] * y, *rest]

    def query(self, query: Query) -> Query:
        """Take a whole query there."""
        geometries = {name: self._geometry(shape) for name, shape in query.geometries.items()}
        return replace(query, inputs=self._inputs(query.inputs), geometries=geometries)

    def answer(self, fields: Fields) -> Fields:
        """Take an answer there."""
        taken = dict(fields)
        for name in _POINTS:
            if fields.get(name) is not None:
                taken[name] = self(fields[name])
        for name in _PLANES:
            if "plane" in fields[name]:
                taken[name] = {**fields[name], "plane": self(fields[name]["plane"])}
        for name in ("check", "curr"):
            taken[name] = self._pose(fields[name])
        taken["global_spheres"] = [self(center) for center in fields["global_spheres"]]
        return taken

    def _inputs(self, inputs: Any) -> dict[str, Any]:
        taken = {key: self._pose(value) if key in _POSES else value for key, value in inputs.items()}
        taken["mover"] = {**inputs["mover"], "spheres": [self(s) for s in inputs["mover"]["spheres"]]}
        taken["seed"] = {key: self._remembered(value) for key, value in inputs["seed"].items()}
        if "cells" in inputs:
            taken["cells"] = [self._cell(cell) for cell in inputs["cells"]]
        return taken

    def _remembered(self, value: Any) -> Any:
        if isinstance(value, dict):
            return {**value, "plane": self(value["plane"])}
        return self(value) if isinstance(value, list | tuple) else value

    def _cell(self, cell: Any) -> dict[str, Any]:
        taken = {**cell, "pose": self._pose(cell["pose"])}
        if "statics" in cell:
            taken["statics"] = [{**thing, "pose": self._pose(thing["pose"])} for thing in cell["statics"]]
        return taken

    def _pose(self, pose: Any) -> Any:
        return None if pose is None else {**pose, "origin": self(pose["origin"])}

    def _geometry(self, shape: Geometry) -> Geometry:
        vertices: Any = tuple(tuple(self(vertex)) for vertex in shape.vertices)
        polygons = tuple(self._polygon(polygon) for polygon in shape.polygons)
        return Geometry(shape.name, vertices, polygons, self._tree(shape.tree), None, shape.kind)

    def _polygon(self, polygon: Polygon) -> Polygon:
        """Keep the front in front: a mirror walks round the same corners the other way."""
        first, *others = polygon.vertices
        return Polygon((first, *(others[::-1] if self.mirrors else others)), polygon.sides)

    def _tree(self, tree: Tree) -> Tree:
        sphere: Any = tuple(self(tree.sphere))
        if isinstance(tree, Leaf):
            return replace(tree, sphere=sphere)
        plane: Any = tuple(self(tree.plane))
        return Node(plane, sphere, tree.polygons, self._tree(tree.positive), self._tree(tree.negative))


QUARTER_TURN: Final = SignedAxes("a quarter turn", exchange=True, signs=(-1.0, 1.0))
HALF_TURN: Final = SignedAxes("a half turn", exchange=False, signs=(-1.0, -1.0))
MIRROR: Final = SignedAxes("a mirror", exchange=False, signs=(-1.0, 1.0))


def quarter_turn(query: Query, ask: Ask) -> str:
    """Quarter turn: x becomes y and y becomes -x, in the scene, the mover and the move.

    Condition: all faces look along the axes, poses and movers are not turned, and what is remembered looks
    along an axis. A mover comes from somewhere: room for one that is put down is looked for in compass order.
    """
    return _taken(QUARTER_TURN, query, ask)


def half_turn(query: Query, ask: Ask) -> str:
    """Half turn: x and y are negated.

    Condition: all faces look along the axes, poses and movers are not turned, and what is remembered looks
    along an axis. A mover comes from somewhere: room for one that is put down is looked for in compass order.
    """
    return _taken(HALF_TURN, query, ask)


def mirror(query: Query, ask: Ask) -> str:
    """Mirror: x is negated, and the corners of every polygon are listed the other way round.

    Condition: all faces look along the axes, poses and movers are not turned, and what is remembered looks
    along an axis. A mover comes from somewhere: room for one that is put down is looked for in compass order.
    """
    return _taken(MIRROR, query, ask)


def _taken(axes: SignedAxes, query: Query, ask: Ask) -> str:
    return unlike(query.op, axes.answer(ask(query)), ask(axes.query(query)), f"after {axes.name}")


LAWS: Final = (
    Law("quarter turn", square_queries(), quarter_turn),
    Law("half turn", square_queries(), half_turn),
    Law("mirror", square_queries(), mirror),
)
