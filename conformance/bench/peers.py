"""What a Python user would pick instead, for the one question it can answer: whether a sphere touches.

The libraries take triangles, not a BSP tree of convex polygons, and their spheres touch at distance
``radius``; retail's at ``radius - EPS``, rounded on the way. Where answers differ, the true distance,
computed here by brute force, says whether that explains it.
"""

from __future__ import annotations

from collections import Counter
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, TypeAlias
from weakref import WeakKeyDictionary

import numpy as np
import numpy.typing as npt

from conformance.bench.timing import Answer, Job, equal_rows
from engine.constants import EPS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, MutableMapping, Sequence

    from conformance.bench.scenes import BenchScene, Floats
    from conformance.bench.timing import Maker
    from conformance.bench.work import KernelWork
    from conformance.scenes.model import Geometry

MODULES: Final[Mapping[str, str]] = {"fcl": "fcl", "coal": "coal", "trimesh": "trimesh"}
"""Name of each peer, and the module that it is."""
EXPLAINED: Final = 2.0 * float(EPS)
"""A difference is explained if distance and radius are this close, metres: retail's own slack, twice."""

Triangles: TypeAlias = npt.NDArray[np.int64]


def triangles(geometry: Geometry) -> Triangles:
    """Return every polygon as a fan of triangles, by vertex indices; shape (n, 3)."""
    fans = [
        (polygon.vertices[0], polygon.vertices[i], polygon.vertices[i + 1])
        for polygon in geometry.polygons
        for i in range(1, len(polygon.vertices) - 1)
    ]
    return np.array(fans, dtype=np.int64)


def peer_maker(name: str) -> Maker:
    """Return a peer as an implementation of ``touch``.

    Raises
    ------
    ImportError
        If it is not installed.
    """
    module = import_module(MODULES[name])
    prepare = {"fcl": _fcl, "coal": _coal, "trimesh": _trimesh}[name]
    meshes: MutableMapping[BenchScene, Any] = WeakKeyDictionary()
    return partial(prepare, module, meshes)


def _cached(meshes: MutableMapping[BenchScene, Any], scene: BenchScene, make: Callable[[], Any]) -> Any:
    if scene not in meshes:
        meshes[scene] = make()
    return meshes[scene]


def _column(done: Any) -> Answer:
    return np.array(done, dtype=np.float64).reshape(-1, 1)


def _fcl(fcl: Any, meshes: MutableMapping[BenchScene, Any], work: KernelWork) -> Job:
    def make() -> Any:
        vertices, faces = np.array(work.scene.geometry.vertices), triangles(work.scene.geometry)
        model = fcl.BVHModel()
        model.beginModel(len(vertices), len(faces))
        model.addSubModel(vertices, faces)
        model.endModel()
        return fcl.CollisionObject(model)

    mesh = _cached(meshes, work.scene, make)
    balls = [
        fcl.CollisionObject(fcl.Sphere(radius), fcl.Transform(np.array(center)))
        for *center, radius in work.spheres.tolist()
    ]
    request = fcl.CollisionRequest()
    return Job(
        lambda: [fcl.collide(ball, mesh, request, fcl.CollisionResult()) > 0 for ball in balls],
        _column,
        len(balls),
    )


def _coal(coal: Any, meshes: MutableMapping[BenchScene, Any], work: KernelWork) -> Job:
    def make() -> Any:
        vertices, faces = np.array(work.scene.geometry.vertices), triangles(work.scene.geometry)
        model = coal.BVHModelOBBRSS()
        model.beginModel(len(faces), len(vertices))
        model.addVertices(vertices)
        model.addTriangles(faces)
        model.endModel()
        return model

    mesh = _cached(meshes, work.scene, make)
    here = coal.Transform3s()
    balls = []
    for *center, radius in work.spheres.tolist():
        there = coal.Transform3s()
        there.setTranslation(np.array(center))
        balls.append((coal.Sphere(radius), there))
    request = coal.CollisionRequest()

    def touches(ball: Any, there: Any) -> bool:
        result = coal.CollisionResult()
        coal.collide(ball, there, mesh, here, request, result)
        return bool(result.isCollision())

    return Job(lambda: [touches(*ball) for ball in balls], _column, len(balls))


def _trimesh(trimesh: Any, meshes: MutableMapping[BenchScene, Any], work: KernelWork) -> Job:
    def make() -> Any:
        vertices = np.array(work.scene.geometry.vertices)
        mesh = trimesh.Trimesh(vertices, triangles(work.scene.geometry), process=False)
        return trimesh.proximity.ProximityQuery(mesh)

    query = _cached(meshes, work.scene, make)
    centers, radii = work.spheres[:, :3], work.spheres[:, 3]
    return Job(lambda: query.on_surface(centers)[1] <= radii, _column, len(radii))


def distance_to(geometry: Geometry, center: Floats) -> float:
    """Return how far a point is from the nearest polygon, in float64, by asking all of them; metres."""
    corners = np.array(geometry.vertices)[triangles(geometry)]
    return float(np.sqrt(_squared_distances(corners, center).min()))


def _squared_distances(corners: Floats, point: Floats) -> Floats:
    """Return the squared distance of a point from each triangle; corners of shape (n, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    edges = [_to_segment(start, end, point) for start, end in ((a, b), (b, c), (c, a))]
    normal = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normal, axis=1)
    inside = np.ones(len(a), dtype=bool)
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= np.einsum("nd,nd->n", np.cross(end - start, point - start), normal) >= 0.0
    height = np.einsum("nd,nd->n", point - a, normal) / lengths
    nearest: Floats = np.minimum.reduce([*edges, np.where(inside, height**2, np.inf)])
    return nearest


def _to_segment(start: Floats, end: Floats, point: Floats) -> Floats:
    along = end - start
    share = np.einsum("nd,nd->n", point - start, along) / np.einsum("nd,nd->n", along, along)
    offsets = point - (start + np.clip(share, 0.0, 1.0)[:, np.newaxis] * along)
    squared: Floats = np.einsum("nd,nd->n", offsets, offsets)
    return squared


def unexplained(work: KernelWork, different: npt.NDArray[np.bool_]) -> int:
    """Count the queries that were answered differently although the sphere is not just touching."""
    spheres = work.spheres[different]
    distances = np.array([distance_to(work.scene.geometry, ball[:3]) for ball in spheres])
    return int((np.abs(distances - spheres[:, 3]) > EXPLAINED).sum()) if len(spheres) else 0


class Agreement:
    """Judges answers that may differ from the first's: counts the differences, and those not explained."""

    def __init__(self) -> None:
        self._asked: Counter[int] = Counter()
        self._different: Counter[int] = Counter()
        self._open: Counter[int] = Counter()

    def __call__(self, work: KernelWork, answers: Sequence[Answer]) -> None:
        """Take the answers of a round, of a sample of the queries or of all."""
        for side, some in enumerate(answers):
            differs = ~equal_rows(answers[0][: len(some)], some)
            self._asked[side] += len(some)
            self._different[side] += int(np.count_nonzero(differs))
            self._open[side] += unexplained(work.part(0, len(some)), differs)

    def share(self, side: int) -> float:
        """Return the share of queries that are answered as the first does."""
        return 1.0 - self._different[side] / self._asked[side]

    def explain(self, side: int) -> str:
        """Say what the differences are."""
        if not self._different[side]:
            return "all answers agree"
        differ = f"{self._different[side]} of {self._asked[side]} differ"
        return f"{differ}, {self._open[side]} of them beyond retail's slack"
