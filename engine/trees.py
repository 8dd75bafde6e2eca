"""A cell's tree asked directly, many spheres at a time: what is struck, and what is walked on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from engine import layout as at
from engine.answering import answer
from engine.checks import LARGEST_INDEX, whole
from engine.errors import QueryError
from engine.given import room, rooms
from engine.kernels import tree_calls
from engine.kernels.within import all_within
from engine.plan import CALL_PLAN, Plan
from engine.world import CHECK_WORLD

if TYPE_CHECKING:
    import numpy.typing as npt

    from engine.kernels.types import Array
    from engine.world import World

_WHOLE: Final = whole(-LARGEST_INDEX, LARGEST_INDEX)
_LARGEST: Final = float(np.finfo(np.float32).max)


def strike_many(
    world: World,
    cell: int,
    spheres: npt.ArrayLike,
    movements: npt.ArrayLike,
    *,
    threads: int = 1,
    plan: Plan = CALL_PLAN,
    coherent: bool = True,
    out: tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]] | None = None,
) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int32]]:
    """Find for each moving sphere a polygon of a cell that it overlaps and that faces its movement.

    Parameters
    ----------
    world : World
    cell : int
        Index of the cell.
    spheres : array_like, shape (n, 4)
        Centre x, y, z where the sphere is, and radius; metres, cell-local. Rounded to float32.
    movements : array_like, shape (n, 3)
        How it came there; metres, cell-local. Rounded to float32.
    threads : int
        How many share the work; the answers are the same for any number.
    plan : Plan
        Which work may be left out; of it, `Stage.BOUNDS` concerns these walks. It changes no answer.
    coherent : bool
        Whether spheres that are near each other are answered one after the other (`engine.coherence`); the
        answers are the same, and in the same order.
    out : tuple of arrays, optional
        Where to write the answers: `struck` and `polygons` (`engine.given`).

    Returns
    -------
    struck : ndarray of int32, shape (n,)
        1 if there is such a polygon, else 0.
    polygons : ndarray of int32, shape (n,)
        Id of the last polygon that the sphere overlapped, or -1; the struck one if it is struck.

    Raises
    ------
    QueryError
        If the cell has no tree, an array another shape or numbers that are no finite float32, or `out` cannot
        take the answers.

    Notes
    -----
    retail: BSPNODE::sphere_intersects_poly 0x0053CA30, SP-1...SP-6
    """
    root = _tree(world, cell)
    given = _numbers(spheres, at.SPHERE_SIZE, "spheres")
    count = len(given)
    asked = given, _vectors(movements, count, "movements")
    hits, ids = rooms(out, 2, "out")
    struck = room(hits, np.int32, (count,), asked, "out[0], struck")
    polygons = room(ids, np.int32, (count,), (*asked, struck), "out[1], polygons")
    rows = (root, *asked, struck, polygons)
    answer(world, tree_calls.strike_many, lambda: rows, count, threads, plan=plan, coherent=coherent)
    return struck, polygons


def step_down_many(
    world: World,
    cell: int,
    spheres: npt.ArrayLike,
    movements: npt.ArrayLike,
    ups: npt.ArrayLike,
    allowances: npt.ArrayLike,
    interps: npt.ArrayLike,
    *,
    threads: int = 1,
    plan: Plan = CALL_PLAN,
    coherent: bool = True,
    out: tuple[Array, Array, npt.NDArray[np.int32]] | None = None,
) -> tuple[Array, Array, npt.NDArray[np.int32]]:
    """Move each sphere back along its movement on to the polygons of a cell that it can walk on.

    Parameters
    ----------
    world : World
    cell : int
        Index of the cell.
    spheres : array_like, shape (n, 4)
        Centre x, y, z and radius; metres, cell-local. Everything is rounded to float32.
    movements : array_like, shape (n, 3)
        The way down that the sphere has made; metres.
    ups : array_like, shape (n, 3)
        The world's z axis in cell space.
    allowances : array_like, shape (n,)
        Least component of a walkable polygon's normal along `ups`.
    interps : array_like, shape (n,)
        How much of the movement may be used: retail's walk_interp, 1 at first.
    threads : int
        How many share the work; the answers are the same for any number.
    plan : Plan
        Which work may be left out; of it, `Stage.BOUNDS` concerns these walks. It changes no answer.
    coherent : bool
        Whether spheres that are near each other are answered one after the other (`engine.coherence`); the
        answers are the same, and in the same order.
    out : tuple of arrays, optional
        Where to write the answers: `centers`, `interps` (these may be the given ones) and `polygons`
        (`engine.given`).

    Returns
    -------
    centers : ndarray of float64, shape (n, 3)
        Where the sphere rests; its centre as given if nothing carries it.
    interps : ndarray of float64, shape (n,)
        What is left of the movement.
    polygons : ndarray of int32, shape (n,)
        Id of the last polygon that moved it, or -1.

    Raises
    ------
    QueryError
        If the cell has no tree, an array another shape or numbers that are no finite float32, or `out` cannot
        take the answers.

    Notes
    -----
    retail: BSPNODE::find_walkable 0x0053CC80, FW-1...FW-5
    """
    root = _tree(world, cell)
    given = _numbers(spheres, at.SPHERE_SIZE, "spheres")
    count = len(given)
    asked = (
        given,
        _vectors(movements, count, "movements"),
        _vectors(ups, count, "ups"),
        _scalars(allowances, count, "allowances"),
    )
    places, rests, ids = rooms(out, 3, "out")
    left = room(rests, np.float64, (count,), asked, "out[1], interps")
    left[:] = _scalars(interps, count, "interps")
    centers = room(places, np.float64, (count, int(at.VECTOR_SIZE)), (*asked, left), "out[0], centers")
    polygons = room(ids, np.int32, (count,), (*asked, left, centers), "out[2], polygons")
    rows = (root, *asked, left, centers, polygons)
    answer(world, tree_calls.step_down_many, lambda: rows, count, threads, plan=plan, coherent=coherent)
    return centers, left, polygons


def _tree(world: World, cell: int) -> int:
    CHECK_WORLD(world, "world", QueryError)
    _WHOLE(cell, "cell", QueryError)
    if not 0 <= cell < len(world.cell_ids):
        raise QueryError("cell", f"{cell} does not exist ({len(world.cell_ids)} cells)")
    root = world.tree_of(cell)
    if root == at.NO_TREE:
        raise QueryError("cell", f"{cell} has no tree to collide with")
    return root


def _numbers(values: npt.ArrayLike, width: int, where: str) -> Array:
    """Return rows of numbers without copying what is laid out right."""
    array = _array(values, where)
    if array.ndim != 2 or array.shape[1] != width:
        raise QueryError(where, f"shape {array.shape} where ('n', {int(width)}) is needed")
    return array


def _vectors(values: npt.ArrayLike, count: int, where: str) -> Array:
    array = _numbers(values, at.VECTOR_SIZE, where)
    if len(array) != count:
        raise QueryError(where, f"{len(array)} of them for {count} spheres")
    return array


def _scalars(values: npt.ArrayLike, count: int, where: str) -> Array:
    array = _array(values, where)
    if array.shape != (count,):
        raise QueryError(where, f"shape {array.shape} where ({count},) is needed")
    return array


def _array(values: npt.ArrayLike, where: str) -> Array:
    """Return an array of the one kind that kernels are compiled for: it could also be written to.

    Its numbers are rounded to float32 by the kernels, which takes each as it is: so all of them are looked at
    here.
    """
    try:
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise QueryError(where, f"not an array of numbers ({error})") from error
    array = array if array.flags.carray else array.copy()
    if not all_within(array.reshape(-1), _LARGEST):
        raise QueryError(where, "not all of them are finite float32s")
    return array
