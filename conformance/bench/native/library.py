"""The compiled yardstick, and scenes in the form that it takes."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
import numpy.typing as npt

from conformance.scenes.model import Leaf

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.bench.scenes import BenchScene
    from conformance.scenes.model import Geometry, Tree

Singles: TypeAlias = npt.NDArray[np.float32]
Integers: TypeAlias = npt.NDArray[np.int32]

_NO_CHILD: Final = -1


def _pointer(array: npt.NDArray[Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


class Yardstick:
    """The loaded library.

    Parameters
    ----------
    path : Path
        What `conformance.bench.native.compiler.compile_yardstick` returns.
    """

    def __init__(self, path: Path) -> None:
        self._library: Final = ctypes.CDLL(str(path))
        self._library.tree_new.restype = ctypes.c_void_p

    def tree(self, scene: BenchScene) -> NativeTree:
        """Compile a scene's tree into the library's own memory."""
        return NativeTree(self._library, scene)


class NativeTree:
    """A tree of the yardstick; its memory is given back with the object."""

    def __init__(self, library: ctypes.CDLL, scene: BenchScene) -> None:
        self._library: Final = library
        geometry = scene.geometry
        vertices = np.array(geometry.vertices, dtype=np.float32)
        planes = _planes(scene)
        corners, starts = _corners(geometry)
        floats, ints, lists = _nodes(geometry.tree)
        self._tree: Final = ctypes.c_void_p(
            library.tree_new(
                *(_pointer(array) for array in (vertices, planes, corners, starts)),
                ctypes.c_int64(len(planes)),
                *(_pointer(array) for array in (floats, ints)),
                ctypes.c_int64(len(floats)),
                _pointer(lists),
                ctypes.c_int64(len(lists)),
            )
        )

    def strike(self, spheres: Singles, movements: Singles, struck: Integers, polygons: Integers) -> None:
        """Write whether each sphere strikes, and the polygon that overlapped last (-1: none)."""
        self._library.strike_many(
            self._tree,
            *(_pointer(array) for array in (spheres, movements)),
            ctypes.c_int64(len(spheres)),
            *(_pointer(array) for array in (struck, polygons)),
        )

    def step_down(
        self,
        spheres: Singles,
        movements: Singles,
        ups: Singles,
        limits: Singles,
        moved: Singles,
        polygons: Integers,
    ) -> None:
        """Write each sphere's centre and what is left of its step, and the polygon that took it (or -1)."""
        self._library.step_down_many(
            self._tree,
            *(_pointer(array) for array in (spheres, movements, ups, limits)),
            ctypes.c_int64(len(spheres)),
            *(_pointer(array) for array in (moved, polygons)),
        )

    def __del__(self) -> None:
        self._library.tree_delete(self._tree)


def _planes(scene: BenchScene) -> Singles:
    """Return the planes as the engine has computed them: how a plane is made is not what is clocked."""
    world = scene.world
    offsets = [world.polygon(0, i) for i in range(scene.size)]
    return np.array([world.floats[at : at + 4] for at in offsets], dtype=np.float32)


def _corners(geometry: Geometry) -> tuple[Integers, Integers]:
    lengths = [len(polygon.vertices) for polygon in geometry.polygons]
    corners = [index for polygon in geometry.polygons for index in polygon.vertices]
    return np.array(corners, dtype=np.int32), np.cumsum([0, *lengths], dtype=np.int32)


def _nodes(root: Tree) -> tuple[Singles, Integers, Integers]:
    """Lay out a tree depth first, positive children next to their parents, without recursion."""
    floats: list[tuple[float, ...]] = []
    ints: list[list[int]] = []
    lists: list[int] = []
    waiting: list[tuple[Tree, int, int]] = [(root, _NO_CHILD, 0)]
    while waiting:
        node, parent, place = waiting.pop()
        here = len(floats)
        if parent != _NO_CHILD:
            ints[parent][place] = here
        if isinstance(node, Leaf):
            floats.append((0.0, 0.0, 0.0, 0.0, *node.sphere))
            ints.append([_NO_CHILD, _NO_CHILD, len(lists), len(node.polygons)])
            lists += node.polygons
        else:
            floats.append((*node.plane, *node.sphere))
            ints.append([0, 0, 0, 0])
            waiting += [(node.negative, here, 1), (node.positive, here, 0)]
    return np.array(floats, dtype=np.float32), np.array(ints, dtype=np.int32), np.array(lists, dtype=np.int32)
