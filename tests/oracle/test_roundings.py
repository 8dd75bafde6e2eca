"""Where the port rounds and in which order it adds: checked on expressions, not on numbers.

A formula of the specification, written with symbols, is compared with what the port computed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from symbols import Symbol, assert_compared, assert_vector, f, frame, text_of, vec

from oracle import bsp_tree_steps
from oracle.bsp_leaf import BSPLeaf
from oracle.bsp_tree import BSPTree
from oracle.frame import Frame
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.position import Position
from oracle.ray import Ray
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Iterator

    from oracle.enums import TransitionState

EAST, HERE = 0xAAB40101, 0xA9B40101
BLOCK = 192.0


@pytest.fixture(autouse=True)
def _no_comparisons_yet() -> Iterator[None]:
    """Forget the comparisons of other tests."""
    Symbol.compared.clear()
    yield
    Symbol.compared.clear()


def ball(name: str, z: float = 0.125, radius: float = 0.5) -> Any:
    """Return a sphere of symbols."""
    return Sphere(vec(name, z=z), Symbol(radius, f"{name}.r"))  # type: ignore[arg-type]


def plane_of(name: str = "N") -> Any:
    """Return the floor plane as symbols."""
    return Plane(vec(name, 0.0, 0.0, 1.0), Symbol(0.0, "d"))  # type: ignore[arg-type]


def floor() -> Any:
    """Return the triangle (-4, -4), (4, -4), (0, 4) of symbols, with a plane of symbols."""
    made = Polygon([vec("a", -4.0, -4.0, 0.0), vec("b", 4.0, -4.0, 0.0), vec("c", 0.0, 4.0, 0.0)])
    made.plane = plane_of()
    return made


class TestVector:
    """Document 01, section 2."""

    @pytest.mark.parametrize("method", ["normalize", "normalize_check_small"])
    def test_normalising(self, method: str) -> None:
        """One reciprocal in the register, three stores."""
        v, n = vec("v"), vec("v")
        getattr(n, method)()
        inv = 1.0 / ((v.x * v.x + v.y * v.y) + v.z * v.z).sqrt()
        assert_vector(n, f(inv * v.x), f(inv * v.y), f(inv * v.z))


class TestFrame:
    """Document 01, section 4."""

    def test_cache(self) -> None:
        """No intermediate is rounded, each cell once."""
        m = frame("f")
        w, x, y, z = m.qw, m.qx, m.qy, m.qz
        m.cache()
        assert m.m0.text == f((1.0 - y * (y + y)) - z * (z + z)).text
        assert m.m1.text == f(x * (y + y) + w * (z + z)).text
        assert m.m2.text == f(x * (z + z) - w * (y + y)).text
        assert m.m3.text == f(x * (y + y) - w * (z + z)).text
        assert m.m4.text == f((1.0 - x * (x + x)) - z * (z + z)).text
        assert m.m5.text == f(y * (z + z) + w * (x + x)).text
        assert m.m6.text == f(x * (z + z) + w * (y + y)).text
        assert m.m7.text == f(y * (z + z) - w * (x + x)).text
        assert m.m8.text == f((1.0 - x * (x + x)) - y * (y + y)).text

    def test_transforms(self) -> None:
        """The y term is added last; the origin after it, before the only store."""
        m, v = frame("f"), vec("v")
        o = m.origin
        gx = (m.m6 * v.z + m.m0 * v.x) + m.m3 * v.y
        gy = (m.m7 * v.z + m.m1 * v.x) + m.m4 * v.y
        gz = (m.m8 * v.z + m.m2 * v.x) + m.m5 * v.y
        assert_vector(m.localtoglobalvec(v), f(gx), f(gy), f(gz))
        assert_vector(m.localtoglobal(v), f(gx + o.x), f(gy + o.y), f(gz + o.z))
        assert_vector(
            m.globaltolocalvec(v),
            f((m.m2 * v.z + m.m0 * v.x) + m.m1 * v.y),
            f((m.m5 * v.z + m.m3 * v.x) + m.m4 * v.y),
            f((m.m8 * v.z + m.m6 * v.x) + m.m7 * v.y),
        )

    def test_globaltolocal(self) -> None:
        """Only the z row reads the unrounded z difference."""
        m, v = frame("f"), vec("v")
        dx, dy, dz = f(v.x - m.origin.x), f(v.y - m.origin.y), v.z - m.origin.z
        assert_vector(
            m.globaltolocal(v),
            f((f(dz) * m.m2 + dx * m.m0) + dy * m.m1),
            f((f(dz) * m.m5 + dx * m.m3) + dy * m.m4),
            f((dz * m.m8 + dx * m.m6) + dy * m.m7),
        )

    @pytest.mark.parametrize("overload", ["combine", "combine_aframe", "combine_scaled"])
    def test_combinations(self, overload: str, monkeypatch: pytest.MonkeyPatch) -> None:
        """The three overloads differ in the order of x, and the scaled one in y and z too."""
        turned: list[Any] = []
        monkeypatch.setattr(Frame, "set_rotate", lambda _self, *q: turned.extend(q))
        a, b, out, s = frame("a"), frame("b"), Frame(), vec("s")
        p = b.origin
        if overload == "combine_scaled":
            out.combine_scaled(a, b, s)
            sx, sy, sz = p.x * s.x, p.y * s.y, p.z * s.z
        else:
            getattr(out, overload)(a, b)
            sx, sy, sz = p.x, p.y, p.z
        assert_vector(
            out.origin,
            f(((sx * a.m0 + sz * a.m6) + sy * a.m3) + a.origin.x),
            f(((sx * a.m1 + sz * a.m7) + sy * a.m4) + a.origin.y),
            f(((sx * a.m2 + sz * a.m8) + sy * a.m5) + a.origin.z),
        )
        x = {
            "combine": ((a.qw * b.qx + b.qz * a.qy) + b.qw * a.qx) - b.qy * a.qz,
            "combine_aframe": ((a.qx * b.qw + a.qw * b.qx) + b.qz * a.qy) - b.qy * a.qz,
            "combine_scaled": ((b.qx * a.qw + b.qw * a.qx) + b.qz * a.qy) - b.qy * a.qz,
        }[overload]
        assert [q.text for q in turned] == [
            f(((a.qw * b.qw - a.qx * b.qx) - b.qy * a.qy) - b.qz * a.qz).text,
            f(x).text,
            f(((b.qy * a.qw - a.qx * b.qz) + a.qz * b.qx) + a.qy * b.qw).text,
            f(((a.qx * b.qy + b.qz * a.qw) - a.qy * b.qx) + a.qz * b.qw).text,
        ]

    def test_interpolated_origin(self) -> None:
        """One product of x stays in the register; all others are stored."""
        a, b, out = frame("a"), frame("b"), Frame()
        t: Any = Symbol(0.25, "t")
        u = 1.0 - t
        out.interpolate_origin(a, b, t)
        assert_vector(
            out.origin,
            f(t * b.origin.x + f(u * a.origin.x)),
            f(f(u * a.origin.y) + f(t * b.origin.y)),
            f(f(u * a.origin.z) + f(t * b.origin.z)),
        )


class TestPosition:
    """Document 01, section 5: z terms last, and two roundings across blocks."""

    def test_points(self) -> None:
        """Rounded in its own block, then again with the offset."""
        here: Any = Position(HERE, frame("h"))
        there, v = Position(EAST, frame("t")), vec("v")
        m: Any = there.frame
        g = [
            f(((m.m3 * v.y + m.m0 * v.x) + m.m6 * v.z) + m.origin.x),
            f(((m.m4 * v.y + m.m1 * v.x) + m.m7 * v.z) + m.origin.y),
            f(((m.m5 * v.y + m.m2 * v.x) + m.m8 * v.z) + m.origin.z),
        ]
        q = Vector3(f(BLOCK + g[0]), f(0.0 + g[1]), f(0.0 + g[2]))
        assert_vector(here.localtoglobal(there, v), q.x, q.y, q.z)
        local = here.frame.globaltolocal(q)
        assert_vector(here.localtolocal(there, v), local.x, local.y, local.z)
        o = m.origin
        assert_vector(here.localtoglobal_origin(there), f(BLOCK + o.x), f(0.0 + o.y), f(0.0 + o.z))

    def test_directions(self) -> None:
        """The z term is added last, both ways."""
        p: Any = Position(HERE, frame("h"))
        m, v = p.frame, vec("v")
        assert_vector(
            p.localtoglobalvec(v),
            f((m.m3 * v.y + m.m0 * v.x) + m.m6 * v.z),
            f((m.m4 * v.y + m.m1 * v.x) + m.m7 * v.z),
            f((m.m5 * v.y + m.m2 * v.x) + m.m8 * v.z),
        )
        assert_vector(
            p.globaltolocalvec(v),
            f((m.m1 * v.y + m.m0 * v.x) + m.m2 * v.z),
            f((m.m4 * v.y + m.m3 * v.x) + m.m5 * v.z),
            f((m.m7 * v.y + m.m6 * v.x) + m.m8 * v.z),
        )

    def test_offsets(self) -> None:
        """One overload keeps the x sum in the register, the other the y sum and the rotated x and y."""
        here: Any = Position(HERE, frame("h"))
        there: Any = Position(EAST, frame("t"))
        o, p = here.frame.origin, there.frame.origin
        assert_vector(
            here.get_offset(there),
            f((BLOCK + p.x) - o.x),
            f(f(0.0 + p.y) - o.y),
            f(f(0.0 + p.z) - o.z),
        )
        m, v = there.frame, vec("v")
        gx = ((m.m3 * v.y + m.m0 * v.x) + m.m6 * v.z) + p.x
        gy = ((m.m4 * v.y + m.m1 * v.x) + m.m7 * v.z) + p.y
        gz = f(((m.m5 * v.y + m.m2 * v.x) + m.m8 * v.z) + p.z)
        assert_vector(
            here.get_offset_point(there, v),
            f(f(BLOCK + gx) - o.x),
            f((0.0 + gy) - o.y),
            f(f(0.0 + gz) - o.z),
        )


class TestPlane:
    """Document 01, section 6."""

    def test_from_point_and_height(self) -> None:
        """The x term is added last; the quotient is rounded once."""
        n, p = vec("N", 0.0, 0.0, 1.0), vec("p")
        assert text_of(Plane.from_point(n, p).d) == f(-((p.z * n.z + p.y * n.y) + p.x * n.x)).text
        plane, q = plane_of(), vec("q")
        n, d = plane.N, plane.d
        plane.set_height(q)
        assert text_of(q.z) == f(-(((q.y * n.y + q.x * n.x) + d) / n.z)).text

    def test_snapping(self) -> None:
        """Two products with the reciprocal, one store."""
        plane, v = plane_of(), vec("v")
        n, d = plane.N, plane.d
        plane.snap_to_plane(v)
        s = ((v.y * n.y + v.x * n.x) + n.z * 0.0) + d
        assert text_of(v.z) == f((-s) * (1.0 / n.z) - (1.0 / n.z) * (-d)).text

    def test_localtoglobal(self) -> None:
        """Foot, rotated normal, world foot and constant are each stored."""
        here, there = Position(HERE, frame("h")), Position(EAST, frame("t"))
        local = plane_of()
        m: Any = there.frame
        n = local.N
        nd = -local.d
        normal: Any = Vector3(
            f((m.m6 * n.z + m.m3 * n.y) + m.m0 * n.x),
            f((m.m7 * n.z + m.m4 * n.y) + m.m1 * n.x),
            f((m.m8 * n.z + m.m5 * n.y) + m.m2 * n.x),
        )
        g = here.localtoglobal(there, Vector3(f(nd * n.x), f(nd * n.y), f(nd * n.z)))
        world = Plane.localtoglobal(here, there, local)
        assert_vector(world.N, normal.x, normal.y, normal.z)
        assert text_of(world.d) == f(-((normal.z * g.z + normal.y * g.y) + normal.x * g.x)).text


class TestPolygon:
    """Document 02."""

    def test_make_plane(self) -> None:
        """The mixture of float32 and register accumulators of MP-2."""
        a, b, c = vec("a", -4.0, -4.0, 0.0), vec("b", 4.0, -4.0, 0.0), vec("c", 0.0, 4.0, 0.0)
        plane: Any = Polygon([a, b, c]).plane
        ax, ay, az = f(b.x - a.x), f(b.y - a.y), b.z - a.z
        bx, by, bz = c.x - a.x, c.y - a.y, c.z - a.z
        sx = 0.0 + f(ay * bz - az * by)
        sy = 0.0 + f(az * bx - bz * ax)
        sz = f((by * ax - ay * bx) + 0.0)
        inv = 1.0 / ((sz * sz + sy * sy) + sx * sx).sqrt()
        n = plane.N
        assert_vector(n, f(inv * sx), f(f(inv) * sy), f(f(inv) * sz))
        total: Any = 0.0
        for v in (a, b, c):
            total = ((total + n.z * v.z) + n.y * v.y) + n.x * v.x
        assert plane.d.text == f(-(total / 3.0)).text

    def test_point_in_polygon(self) -> None:
        """Of the edge normal x and y are stored, z is not; the edge and the differences are not."""
        poly, p = floor(), vec("p")
        n = poly.plane.N
        assert poly.point_in_polygon(p) == 1
        for prev, cur in poly.edges:
            ex, ey, ez = cur.x - prev.x, cur.y - prev.y, cur.z - prev.z
            cx, cy, cz = f(ez * n.y - ey * n.z), f(ex * n.z - ez * n.x), ey * n.x - ex * n.y
            s = ((p.z - prev.z) * cz + (p.y - prev.y) * cy) + (p.x - prev.x) * cx
            assert_compared(s, "<", 0.0)

    def test_overlap_projects_the_centre(self) -> None:
        """Only the z product of the projection is stored; the reach is compared unrounded."""
        poly, s = floor(), ball("s")
        n = poly.plane.N
        dist = ((s.center.y * n.y + s.center.z * n.z) + s.center.x * n.x) + poly.plane.d
        contact = foot(s.center, n, dist)
        for test in (poly.polygon_hits_sphere_slow_but_sure, poly.polygon_hits_sphere):
            point: Ref[Any] = Ref(None)
            test(s, point)
            assert_vector(point.value, contact.x, contact.y, contact.z)
        rad = s.radius - 0.00019999999494757503
        assert_compared(rad, "<", abs(dist))

    @pytest.mark.parametrize("fast", [False, True])
    def test_overlap_beyond_an_edge(self, fast: bool) -> None:
        """Past the edge into corner a: every comparison of the edge loop, in retail's kinds."""
        poly, s = floor(), Sphere(vec("s", 0.0, -4.25, 0.125), Symbol(0.5, "s.r"))  # type: ignore[arg-type]
        n = poly.plane.N
        c: Any = s.center
        dist = ((c.y * n.y + c.z * n.z) + c.x * n.x) + poly.plane.d
        rad: Any = s.radius - 0.00019999999494757503
        test = poly.polygon_hits_sphere if fast else poly.polygon_hits_sphere_slow_but_sure
        assert test(s, Ref(None)) == 1
        assert_edge_loop(poly, foot(c, n, dist), f(rad * rad - dist * dist))

    @pytest.mark.parametrize("small", [False, True])
    def test_check_walkable(self, small: bool) -> None:
        """The projection along up keeps the x product; the squared radius is stored once."""
        poly, up = floor(), vec("up", 0.0, 0.0, 1.0)
        s: Any = Sphere(vec("s", 0.0, -4.25, 0.125), Symbol(1.0, "s.r"))  # type: ignore[arg-type]
        n, rsq = poly.plane.N, s.radius * s.radius
        test = poly.check_small_walkable if small else poly.check_walkable
        assert test(s, up) == 1
        v = (n.y * up.y + n.z * up.z) + n.x * up.x
        assert_compared(abs(v), "<", 0.00019999999494757503)
        p = projected(s.center, n, poly.plane.d, up, v)
        assert_edge_loop(poly, p, f(rsq * 0.25) if small else f(rsq))

    def test_find_crossed_edge(self) -> None:
        """The side reads the unrounded z of the edge, the normal the rounded one."""
        poly, up, normal = floor(), vec("up", 0.0, 0.0, 1.0), vec("out")
        s: Any = Sphere(vec("s", 0.0, -4.25, 0.125), Symbol(1.0, "s.r"))  # type: ignore[arg-type]
        n = poly.plane.N
        assert poly.find_crossed_edge(s, up, normal) == 1
        p = projected(s.center, n, poly.plane.d, up, (n.y * up.y + n.z * up.z) + n.x * up.x)
        prev, cur = poly.edges[1]
        ex, ey, ez = f(cur.x - prev.x), f(cur.y - prev.y), cur.z - prev.z
        side = ((p.z - prev.z) * (ey * n.x - ex * n.y) + (p.y - prev.y) * (ex * n.z - f(ez) * n.x)) + (
            p.x - prev.x
        ) * (ez * n.y - ey * n.z)
        assert_compared(side, "<", 0.0)
        x, y, z = f(f(ez) * n.y - ey * n.z), f(ex * n.z - f(ez) * n.x), f(ey * n.x - ex * n.y)
        inv = 1.0 / ((x * x + y * y) + z * z).sqrt()
        assert_vector(normal, f(inv * x), f(inv * y), f(inv * z))

    def test_adjust_sphere_to_plane(self) -> None:
        """The rest of the walk is compared unrounded and stored rounded; x keeps its product."""
        poly, s, mv = floor(), ball("s"), vec("mv", 0.0, 0.0, -0.5)
        n, c, path = poly.plane.N, s.center, SpherePath()
        walk: Any = Symbol(1.0, "walk")
        path.walk_interp = walk
        dist = ((c.y * n.y + c.z * n.z) + c.x * n.x) + poly.plane.d
        v = (mv.y * n.y + mv.z * n.z) + mv.x * n.x
        t = (dist - s.radius) / v
        w = (1.0 - t) * walk
        wanted = (f(c.x - t * mv.x), f(c.y - f(t * mv.y)), f(c.z - f(t * mv.z)))
        assert poly.adjust_sphere_to_plane(path, s, mv) == 1
        assert_compared(w, ">=", walk)
        assert_compared(f(w), "<", -0.5)
        assert_vector(c, *wanted)
        assert text_of(path.walk_interp) == f(w).text

    def test_adjust_sphere_to_poly(self) -> None:
        """The distance is stored, the time is not."""
        poly, curr, mv = floor(), vec("curr", z=2.0), vec("mv", 0.0, 0.0, -0.5)
        n, s = poly.plane.N, ball("s")
        dist = f(((curr.y * n.y + curr.z * n.z) + curr.x * n.x) + poly.plane.d)
        v = (mv.y * n.y + mv.z * n.z) + mv.x * n.x
        assert text_of(poly.adjust_sphere_to_poly(s, curr, mv)) == ((s.radius - dist) / v).text

    def test_adjust_to_placement_poly(self) -> None:
        """The x product is not stored; both spheres get the same sums."""
        poly, s, other = floor(), ball("s"), ball("o")
        n, c = poly.plane.N, s.center.copy()
        radius: Any = Symbol(0.5, "radius")
        k = radius - (((c.y * n.y + c.z * n.z) + c.x * n.x) + poly.plane.d)
        poly.adjust_to_placement_poly(s, other, radius, 0, 0)
        assert_vector(s.center, f(k * n.x + c.x), f(f(k * n.y) + c.y), f(f(k * n.z) + c.z))
        o = vec("o")
        assert_vector(other.center, f(k * n.x + o.x), f(f(k * n.y) + o.y), f(f(k * n.z) + o.z))

    def test_a_ray_s_point(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """Of the point's products only x and y are stored before the sum."""
        asked: list[Any] = []
        monkeypatch.setattr(Polygon, "point_in_polygon", lambda _self, p: asked.append(p) or 1)
        poly, n = floor(), plane_of().N
        pt, direction = vec("pt", z=2.0), vec("dir", 0.0, 0.0, -1.0)
        assert poly.polygon_hits_ray(Ray(pt, direction), Ref(0.0)) == 1
        v = (direction.y * n.y + direction.z * n.z) + direction.x * n.x
        t = (((pt.y * n.y + pt.z * n.z) + pt.x * n.x) + poly.plane.d) * (-1.0 / v)
        d = direction
        assert_vector(asked[0], f(f(t * d.x) + pt.x), f(f(t * d.y) + pt.y), f(t * d.z + pt.z))


def foot(center: Any, n: Any, dist: Any) -> Any:
    """Write PH-3."""
    return Vector3(f(center.x - dist * n.x), f(center.y - dist * n.y), f(center.z - f(dist * n.z)))


def projected(center: Any, n: Any, d: Any, up: Any, v: Any) -> Any:
    """Write CW-2 and CW-3."""
    t = (((n.y * center.y + n.z * center.z) + n.x * center.x) + d) / v
    return Vector3(f(center.x - t * up.x), f(center.y - f(t * up.y)), f(center.z - f(t * up.z)))


def assert_edge_loop(poly: Any, p: Any, rsq: Any) -> None:
    """Demand the comparisons of PH-4 … PH-6 at the edge from a to b, which `p` is outside of."""
    n, (prev, cur) = poly.plane.N, poly.edges[1]
    ex, ey, ez = f(cur.x - prev.x), f(cur.y - prev.y), cur.z - prev.z
    qx, qy, qz = f(p.x - prev.x), f(p.y - prev.y), p.z - prev.z
    cx, cy, cz = ez * n.y - ey * n.z, ex * n.z - f(ez) * n.x, ey * n.x - ex * n.y
    side = (qz * cz + qy * cy) + qx * cx
    assert_compared(side, "<", 0.0)
    assert_compared(((cx * cx + cy * cy) + cz * cz) * rsq, "<", side * side)
    along = (f(qz) * f(ez) + qy * ey) + qx * ex
    assert_compared(along, "<=", (f(ez) * f(ez) + ey * ey) + ex * ex)
    prev, _ = poly.edges[0]
    qx, qy, qz = f(p.x - prev.x), f(p.y - prev.y), f(p.z - prev.z)
    assert_compared((qz * qz + qy * qy) + qx * qx, "<=", rsq)


class Collisions:
    """What the tree writes of a COLLISIONINFO."""

    contact_plane_cell_id = 0

    def __init__(self) -> None:
        self.plane: Any = None
        self.normal: Any = None

    def set_contact_plane(self, plane: Any, _is_water: int) -> None:
        """Keep the plane."""
        self.plane = plane

    def set_collision_normal(self, normal: Any) -> None:
        """Keep the normal, not normalised."""
        self.normal = normal


class Lifting(BSPLeaf):
    """A leaf that answers every search for ground by putting the sphere somewhere else."""

    __slots__ = ("movement",)

    def __init__(self) -> None:
        super().__init__(0, 0, Sphere(Vector3(), 1.0), [floor()])
        self.movement: Any = None

    def sphere_intersects_poly(self, *arguments: Any) -> int:
        """Note the movement and find nothing."""
        self.movement = arguments[1]
        return 0

    def find_walkable(self, *arguments: Any) -> None:
        """Note the movement, move the sphere, report the floor."""
        _, valid, polygon, self.movement, _, changed = arguments
        valid.center.assign(vec("valid"))
        polygon.value, changed.value = self.in_polys[0], 1


class TestTree:
    """Document 03: local results on their way back to the world."""

    def prepared(self, monkeypatch: pytest.MonkeyPatch) -> tuple[Any, list[Any]]:
        """Return a path in a space of symbols, and the list of offsets that it is moved by."""
        path: Any = SpherePath()
        path.localspace_pos = Position(HERE, frame("l"))
        path.check_pos = Position(HERE, frame("k"))
        path.localspace_sphere[0] = ball("s")
        path.localspace_z = vec("lz", 0.0, 0.0, 1.0)
        path.step_down_amt, path.walk_interp = Symbol(0.5, "amount"), Symbol(1.0, "walk")
        moved: list[Any] = []
        monkeypatch.setattr(SpherePath, "add_offset_to_check_pos", lambda _self, off: moved.append(off))
        monkeypatch.setattr(SpherePath, "set_walkable", lambda *_: None)
        return path, moved

    def test_step_sphere_down(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """SD-1 … SD-9: which reciprocal, which products, which differences are stored."""
        path, moved = self.prepared(monkeypatch)
        leaf, collisions = Lifting(), Collisions()
        s, lz, scale = path.localspace_sphere[0], path.localspace_z, Symbol(2.0, "scale")
        amt = -(path.step_down_amt * path.walk_interp)
        BSPTree(leaf).step_sphere_down(path, collisions, s, scale)  # type: ignore[arg-type]
        inv = 1.0 / scale
        assert_vector(
            leaf.movement, f(inv * f(amt * lz.x)), f(f(amt * lz.y) * f(inv)), f((amt * lz.z) * f(inv))
        )
        m, valid = path.localspace_pos.frame, vec("valid")
        dx, dy, dz = valid.x - s.center.x, valid.y - s.center.y, valid.z - s.center.z
        assert_vector(
            moved[0],
            f(f((dz * m.m6 + dy * m.m3) + dx * m.m0) * scale),
            f(f((dz * m.m7 + dy * m.m4) + dx * m.m1) * scale),
            f(f((dz * m.m8 + dy * m.m5) + dx * m.m2) * scale),
        )
        world = Plane.localtoglobal(path.check_pos, path.localspace_pos, leaf.in_polys[0].plane)
        assert text_of(collisions.plane.d) == text_of(f(world.d * scale))

    def test_perfect_clip_offset(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """CP-4: the difference is stored, rotated with z last, stored, scaled and stored."""
        path, moved = self.prepared(monkeypatch)
        collisions, scale = Collisions(), Symbol(2.0, "scale")
        tree = BSPTree(Lifting())

        def adjust(_self: BSPTree, check_pos: Sphere, *_: object) -> int:
            check_pos.center.assign(vec("valid"))
            return 1

        monkeypatch.setattr(BSPTree, "adjust_to_plane", adjust)
        s, mover = path.localspace_sphere[0], type("Mover", (), {"state": 0x48})()
        result: TransitionState = tree.collide_with_pt(
            mover,
            path,
            collisions,
            s,
            vec("curr"),
            floor(),
            Ref(None),
            scale,  # type: ignore[arg-type]
        )
        assert result.name == "ADJUSTED"
        m, valid, n = path.localspace_pos.frame, vec("valid"), floor().plane.N
        dx, dy, dz = f(valid.x - s.center.x), f(valid.y - s.center.y), f(valid.z - s.center.z)
        assert_vector(
            moved[0],
            f(f((dx * m.m0 + dy * m.m3) + dz * m.m6) * scale),
            f(f((dx * m.m1 + dy * m.m4) + dz * m.m7) * scale),
            f(f((dx * m.m2 + dy * m.m5) + dz * m.m8) * scale),
        )
        assert_vector(
            collisions.normal,
            f((m.m0 * n.x + m.m3 * n.y) + m.m6 * n.z),
            f((m.m1 * n.x + m.m4 * n.y) + m.m7 * n.z),
            f((m.m2 * n.x + m.m5 * n.y) + m.m8 * n.z),
        )

    def test_the_movement_is_stored(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """FC-1 and AT-1: the differences of centre and current centre."""
        path, moved = self.prepared(monkeypatch)
        path.localspace_curr_center[0] = vec("cc")
        path.collide = 1
        leaf, collisions, scale = Lifting(), Collisions(), Symbol(2.0, "scale")
        info = type("Mover", (), {"state": 0})()
        parts = {"sphere_path": path, "collision_info": collisions, "object_info": info, "trace": None}
        transition: Any = type("Moving", (), parts)()
        s, cc, valid = path.localspace_sphere[0].center, vec("cc"), vec("valid")
        result = BSPTree(leaf).find_collisions(transition, scale)  # type: ignore[arg-type]
        assert result.name == "ADJUSTED"
        assert_vector(leaf.movement, f(s.x - cc.x), f(s.y - cc.y), f(s.z - cc.z))
        # FC-7: the difference is stored before it is rotated, unlike in SD-6.
        m = path.localspace_pos.frame
        dx, dy, dz = f(valid.x - s.x), f(valid.y - s.y), f(valid.z - s.z)
        assert_vector(
            moved[0],
            f(f((dx * m.m0 + dy * m.m3) + dz * m.m6) * scale),
            f(f((dx * m.m1 + dy * m.m4) + dz * m.m7) * scale),
            f(f((dx * m.m2 + dy * m.m5) + dz * m.m8) * scale),
        )
        world = Plane.localtoglobal(path.check_pos, path.localspace_pos, leaf.in_polys[0].plane)
        assert text_of(collisions.plane.d) == text_of(f(world.d * scale))
        check, poly = ball("s"), floor()
        BSPTree(leaf).adjust_to_plane(check, vec("cc"), poly, Ref(None))
        assert_vector(leaf.movement, f(s.x - cc.x), f(s.y - cc.y), f(s.z - cc.z))

    def test_adjust_to_plane_places(self) -> None:
        """AT-8: the products of x and y are stored, the one of z is not."""
        center, curr, mv = vec("c"), vec("curr"), vec("mv")
        t: Any = Symbol(0.5, "t")
        bsp_tree_steps._place(center, curr, mv, t)
        assert_vector(center, f(f(mv.x * t) + curr.x), f(f(mv.y * t) + curr.y), f(t * mv.z + curr.z))

    @pytest.mark.parametrize("spheres", [1, 2])
    def test_placement_offset(self, spheres: int, monkeypatch: pytest.MonkeyPatch) -> None:
        """PI-8 rotates unrounded differences, PI-9 rounded ones; no scale."""
        path, moved = self.prepared(monkeypatch)
        path.num_sphere = spheres
        answers = [1, 0, 0]

        class Pushing(BSPLeaf):
            """A leaf that is hit once, by the floor."""

            def sphere_intersects_solid_poly(self, *arguments: Any) -> int:
                """Report the floor the first time."""
                answer = answers.pop(0)
                arguments[3].value = self.in_polys[0] if answer else None
                return answer

        transition: Any = type("Moving", (), {"sphere_path": path, "trace": None})()
        tree = BSPTree(Pushing(0, 0, Sphere(Vector3(), 1.0), [floor()]))
        assert tree.placement_insert(transition).name == "ADJUSTED"
        pushed, dummy = ball("s"), ball("dummy")
        floor().adjust_to_placement_poly(pushed, dummy, pushed.radius, 0, 1)
        s, m, c = ball("s").center, path.localspace_pos.frame, pushed.center
        d = [c.x - s.x, c.y - s.y, c.z - s.z]
        dx, dy, dz = d if spheres == 1 else map(f, d)
        assert_vector(
            moved[0],
            f((dx * m.m0 + dy * m.m3) + dz * m.m6),
            f((dx * m.m1 + dy * m.m4) + dz * m.m7),
            f((dx * m.m2 + dy * m.m5) + dz * m.m8),
        )
