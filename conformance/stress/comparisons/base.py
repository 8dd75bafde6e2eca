"""A comparison of retail that can be asked about by itself, and the geometry that it is asked with."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from conformance.scenes.bounds import Bounds
from conformance.scenes.model import Geometry, Leaf, Node
from conformance.scenes.planes import plane_of
from conformance.scenes.polygons import merge
from conformance.vector_io import query_from_record

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Fields, Query
    from conformance.scenes.model import PlaneData
    from conformance.scenes.polygons import Corners

RADIUS: Final = 0.48
"""Of the spheres that are asked about: a human's, metres."""
TRIANGLE: Final[Corners] = ((-1.7, -1.3, -0.45), (1.9, -0.8, -0.2), (0.3, 1.6, 0.55))
"""A floor at an odd angle; three corners are always flat."""


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """One comparison of retail, as a function of two numbers.

    Attributes
    ----------
    name : str
        What is compared.
    retail : str
        Function and step.
    axes : (str, str)
        What the two numbers are, with units.
    query : callable
        Makes the query of the two.
    decide : callable
        Reads the decision from an answer's fields.
    between : (float, float)
        Values of the first number between which the decision turns once.
    beside : float
        The second number: it enters the same sums.
    share : int
        What the edge of its squares is divided by, where asking takes long.
    """

    name: str
    retail: str
    axes: tuple[str, str]
    query: Callable[[float, float], Query]
    decide: Callable[[Fields], bool]
    between: tuple[float, float]
    beside: float
    share: int = 1


@cache
def single(corners: Corners = TRIANGLE, name: str = "single") -> Geometry:
    """Make a geometry of one polygon in one leaf."""
    return in_leaf(corners, name)


def in_leaf(corners: Corners, name: str) -> Geometry:
    """Make a geometry of one polygon in one leaf, a new one each time."""
    vertices, polygons = merge([corners])
    return Geometry(
        name, vertices, polygons, Leaf(0, solid=False, sphere=Bounds([corners]).sphere((0,)), polygons=(0,))
    )


def behind_plane(plane: PlaneData, corners: Corners, *, positive: bool) -> Geometry:
    """Make a geometry with one polygon on one side of a node; the other side is empty."""
    vertices, polygons = merge([corners])
    sphere = (0.0, 0.0, 0.0, 8.0)
    full, empty = (
        Leaf(0, solid=True, sphere=sphere, polygons=(0,)),
        Leaf(1, solid=False, sphere=sphere, polygons=()),
    )
    children = (full, empty) if positive else (empty, full)
    return Geometry("split", vertices, polygons, Node(plane, sphere, (), *children))


def contained_by(*planes: PlaneData) -> Geometry:
    """Make a geometry that contains what is in front of all planes."""
    vertices, polygons = merge([TRIANGLE])
    leaf = Leaf(0, solid=False, sphere=(0.0, 0.0, 0.0, 8.0), polygons=(0,))
    return Geometry("contained", vertices, polygons, leaf, planes)


def triangle_plane() -> PlaneData:
    """Return the plane of `TRIANGLE`, float32."""
    return plane_of(single().corners(0))


def ask(op: str, geometry: Geometry | None = None, **inputs: Any) -> Query:
    """Return a query, about a polygon or tree of a geometry if there is one."""
    if geometry is None:
        return query_from_record({"op": op, **inputs}, {})
    named = {"geometry": geometry.name, **inputs}
    return query_from_record({"op": op, **named}, {geometry.name: geometry})


def sphere(x: float, y: float, z: float) -> list[float]:
    """Return a sphere of `RADIUS`."""
    return [x, y, z, RADIUS]


def says_yes(fields: Fields) -> bool:
    """Read the decision of most operations."""
    return bool(fields["r"])
