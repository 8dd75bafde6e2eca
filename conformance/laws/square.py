"""Queries whose scenes stand square to the axes: every face of a scene looks along one of them.

Then a dot product with a normal has one term that is not zero, so it is exact, and the order in which its
terms are added does not matter.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from hypothesis import strategies as st

from conformance.scenes.bsp_builder import TreeStyle, build
from conformance.scenes.primitives import make
from conformance.strategies.collisions import DISPATCHES, find_collisions, transitions
from conformance.strategies.movers import FREE_ROTATE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.query import Query
    from conformance.scenes.model import Geometry

_SHAPES: Final[Mapping[str, Mapping[str, Any]]] = {
    "floor": {"size": (6.0, 6.0), "tiles": (2, 3)},
    "room": {"size": (6.0, 5.0, 3.0)},
    "box": {"size": (2.0, 1.5, 0.5)},
    "stairs": {"width": 3.0, "rise": 0.25, "run": 0.5, "count": 4},
    "hatch": {"size": (6.0, 6.0), "hole": (1.5, 1.0), "depth": 1.0},
}
_IDENTITY: Final = [1.0, 0.0, 0.0, 0.0]
_POSES: Final = ("pose", "from", "to")
_REMEMBERED: Final = ("contact", "last_known")


def square_calls(dispatch: str) -> st.SearchStrategy[Query]:
    """Generate BSP calls of one path in scenes that are square, by movers that are not turned."""
    return find_collisions(dispatch, _geometries()).map(_squared)


def _geometries() -> st.SearchStrategy[Geometry]:
    made = [
        build(f"square-{name}-{style}", make(name, parameters), style=style, kind=name)
        for name, parameters in _SHAPES.items()
        for style in TreeStyle
    ]
    return st.sampled_from(made)


def square_queries() -> st.SearchStrategy[Query]:
    """Generate BSP calls and moves in scenes that are square, by movers that are not turned.

    Placements are not among them: where there is no room, retail looks for it in places that it goes through
    in compass order (05, find_placement_pos), which neither a turn nor a mirror leaves as it is.
    """
    return st.one_of([*map(square_calls, DISPATCHES), square_transitions().filter(_is_move)])


def square_transitions() -> st.SearchStrategy[Query]:
    """Generate moves, and now and then placements, in such scenes."""
    return transitions(_geometries()).map(_squared)


def _is_move(query: Query) -> bool:
    return query.inputs["from"] is not None


def _squared(query: Query) -> Query:
    """Turn back what a random query has turned; what the mover remembers looks along an axis, too."""
    inputs: dict[str, Any] = {
        key: _straight(value) if key in _POSES else value for key, value in query.inputs.items()
    }
    if "cells" in inputs:
        inputs["cells"] = [_straight_cell(cell) for cell in inputs["cells"]]
    seed = dict(inputs["seed"])
    for key in _REMEMBERED:
        if key in seed:
            seed[key] = {**seed[key], "plane": [*_axis(seed[key]["plane"][:3]), seed[key]["plane"][3]]}
    if "sliding" in seed:
        seed["sliding"] = _axis(seed["sliding"])
    mover = {**inputs["mover"], "state": inputs["mover"]["state"] & ~FREE_ROTATE}
    return replace(query, inputs={**inputs, "seed": seed, "mover": mover})


def _straight_cell(cell: Mapping[str, Any]) -> dict[str, Any]:
    straight = {**cell, "pose": _straight(cell["pose"])}
    if "statics" in cell:
        straight["statics"] = [{**thing, "pose": _straight(thing["pose"])} for thing in cell["statics"]]
    return straight


def _straight(pose: Mapping[str, Any] | None) -> dict[str, Any] | None:
    return None if pose is None else {**pose, "rotation": _IDENTITY}


def _axis(vector: Sequence[float]) -> list[float]:
    """Return the direction along an axis that is nearest to a vector."""
    longest = max(range(3), key=lambda axis: abs(vector[axis]))
    return [0.0 if axis != longest else 1.0 if vector[axis] >= 0.0 else -1.0 for axis in range(3)]
