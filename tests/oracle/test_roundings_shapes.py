"""Where spheres and cylinders round and in which order they add: checked on expressions (07).

A formula of the specification, written with symbols, is compared with what the port computed. The values
of the symbols only choose the branch.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from symbols import Symbol, assert_compared, assert_vector, f, frame, text_of, vec

from oracle import sphere_obstacle
from oracle.collision_info import CollisionInfo
from oracle.constants import EPS
from oracle.cyl_sphere import CylSphere
from oracle.enums import PERFECT_CLIP_OI, InsertType
from oracle.object_info import ObjectInfo
from oracle.position import Position
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.vector import Vector3, minus, plus, scaled

if TYPE_CHECKING:
    from collections.abc import Iterator

    from oracle.plane import Plane

HERE = 0xA9B40101
TWO = 2.0 - EPS


@pytest.fixture(autouse=True)
def _no_comparisons_yet() -> Iterator[None]:
    """Forget the comparisons of other tests."""
    Symbol.compared.clear()
    yield
    Symbol.compared.clear()


class Collisions(CollisionInfo):
    """Collision info that keeps what it is told: plane and normal as given."""

    __slots__ = ("normal", "plane")

    def set_contact_plane(self, plane: Plane, is_water: int) -> None:
        """Keep the plane."""
        self.plane: Any = plane

    def set_collision_normal(self, n: Vector3) -> None:
        """Keep the normal, not normalised."""
        self.normal: Any = n.copy()


class Path(SpherePath):
    """A path of one sphere of symbols, at `S`, that was at `C`; it notes by what it is moved."""

    __slots__ = ("moved",)

    def __init__(self, s: tuple[float, float, float], c: tuple[float, float, float]) -> None:
        super().__init__()
        me: Any = self
        me.num_sphere = 1
        me.global_sphere[0] = Sphere(vec("S", *s), Symbol(0.5, "r"))  # type: ignore[arg-type]
        me.global_curr_center[0] = vec("C", *c)
        me.walk_interp, me.step_down_amt = Symbol(1.0, "walk"), Symbol(1.0, "amount")
        me.walkable_allowance = -9.0
        self.moved: Any = None

    def get_curr_pos_check_pos_block_offset(self) -> Vector3:
        """Return a border of symbols that is none by value."""
        border: Vector3 = vec("B", 0.0, 0.0, 0.0)
        return border

    def add_offset_to_check_pos(self, offset: Vector3) -> None:
        """Note the offset."""
        self.moved = offset


class Clipped:
    """A transition of symbols: a path, and collision info that keeps what it is told."""

    trace = None

    def __init__(self, path: Any) -> None:
        self.sphere_path = path
        self.collision_info: Any = Collisions()
        self.object_info = ObjectInfo()
        self.object_info.state = PERFECT_CLIP_OI


def sphere() -> Any:
    """Return an obstacle about `T`, the origin, of radius `R`."""
    return Sphere(vec("T", 0.0, 0.0, 0.0), Symbol(1.5, "R"))  # type: ignore[arg-type]


def cylinder() -> Any:
    """Return a cylinder on `T`, the origin, of radius `R` and height `h`."""
    return CylSphere(vec("T", 0.0, 0.0, 0.0), Symbol(2.0, "h"), Symbol(1.5, "R"))  # type: ignore[arg-type]


def radsum() -> Any:
    """Return a radius sum that is 2 with EPS."""
    return Symbol(TWO, "sum")


def movement(path: Any) -> Any:
    """Write the movement from C to S over the border (07 6.A.7, 7.2.4, 10.4.3)."""
    s, c, b = path.global_sphere[0].center, path.global_curr_center[0], vec("B")
    return Vector3(f(b.x + (s.x - c.x)), f(b.y + (s.y - c.y)), f(b.z + f(s.z - c.z)))


def back(path: Any) -> Any:
    """Write the way back to C (07 8.8.3, 10.8.6.1)."""
    return minus(minus(path.global_curr_center[0], path.global_sphere[0].center), vec("B"))


def plane_text(n: Any, p: Any) -> list[str]:
    """Write a plane by normal and point (07 0.5)."""
    d = f(-((p.z * n.z + p.y * n.y) + p.x * n.x))
    return [text_of(v) for v in (n.x, n.y, n.z, d)]


def given_plane(collisions: Any) -> list[str]:
    """Return the contact plane that was given."""
    pl = collisions.plane
    return [text_of(v) for v in (pl.N.x, pl.N.y, pl.N.z, pl.d)]


class TestHelpers:
    """Document 07, section 0.5."""

    def test_sums_and_multiples(self) -> None:
        """Each component is stored once; a division is one reciprocal in the register."""
        a, b, k = vec("a"), vec("b"), Symbol(2.0, "k")
        assert_vector(minus(a, b), f(a.x - b.x), f(a.y - b.y), f(a.z - b.z))
        assert_vector(plus(a, b), f(a.x + b.x), f(a.y + b.y), f(a.z + b.z))
        assert_vector(scaled(k, a), f(k * a.x), f(k * a.y), f(k * a.z))  # type: ignore[arg-type]
        inv = 1.0 / k
        a.divide_by(k)
        a0 = vec("a")
        assert_vector(a, f(inv * a0.x), f(inv * a0.y), f(inv * a0.z))


class TestSphere:
    """Document 07, sections 2 to 9."""

    def test_overlap(self) -> None:
        """07 2.1: y, x, z."""
        d, r = vec("d"), radsum()
        sphere_obstacle.collides_with_sphere(d, r)
        assert_compared(r * r, ">=", (d.y * d.y + d.x * d.x) + d.z * d.z)

    def test_time_of_collision(self) -> None:
        """07 3: three orders in three sums."""
        m, d, r = vec("m", 4.0, 0.0, 0.0), vec("d", -3.0, 0.0, 0.0), Symbol(1.0, "sum")
        got = sphere_obstacle.find_time_of_collision(m, d, r)  # type: ignore[arg-type]
        a = (m.x * m.x + m.y * m.y) + m.z * m.z
        dot = (d.z * m.z + d.y * m.y) + m.x * d.x
        c = ((d.x * d.x + d.y * d.y) + d.z * d.z) - r * r
        b = -dot
        q = (b * b - c * a).sqrt()
        assert text_of(got) == text_of((b - q) / a)
        assert_compared(c, "<", EPS)
        assert_compared(a, "<", EPS)
        away = sphere_obstacle.find_time_of_collision(vec("m", -4.0, 0.0, 0.0), d, r)  # type: ignore[arg-type]
        assert text_of(away) == text_of((q - dot) / a)

    def test_step_sphere_down(self) -> None:
        """07 4: squares of x and y are stored, the amount divides stored, the normal's z is not."""
        path: Any = Path((0.75, 0.25, 1.5), (0.0, 0.0, 0.0))
        coll, this, r = Collisions(), sphere(), radsum()
        disp: Any = vec("d", 0.75, 0.25, 1.5)
        d = disp.copy()
        this.step_sphere_down(path, coll, path.global_sphere[0], disp, r)
        xx, yy = f(d.x * d.x), f(d.y * d.y)
        assert_compared(r * r, "<", (d.z * d.z + xx) + yy)
        sd = Symbol(1.0, "amount") * Symbol(1.0, "walk")
        assert_compared(abs(sd), "<", EPS)
        rs = r + EPS
        t = ((rs * f(rs) - (xx + yy)).sqrt() - d.z) / f(sd)
        w = (1.0 - t) * Symbol(1.0, "walk")
        assert_compared(w, "<", -0.1)
        dz = f(f(sd) * t)
        nz, inv = dz + d.z, 1.0 / f(rs)
        assert_compared(nz * inv, "<=", -9.0)
        n: Any = Vector3(f(inv * d.x), f(inv * d.y), f(nz * inv))
        assert_vector(disp, n.x, n.y, n.z)
        assert given_plane(coll) == plane_text(n, plus(this.center, scaled(this.radius, n)))
        assert text_of(path.walk_interp) == text_of(f(w))
        assert_vector(path.moved, 0.0, 0.0, dz)

    def test_too_high_a_step(self) -> None:
        """07 5.1, 5.2: compared in the register."""
        path: Any = Path((0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
        made: Any = Clipped(path)
        made.object_info.step_up_height, d, r = Symbol(0.5, "up"), vec("d"), radsum()
        sphere().step_sphere_up(made, path.global_sphere[0], d, r)
        assert_compared(made.object_info.step_up_height, "<", (r + EPS) - d.z)

    def test_slide_along(self) -> None:
        """07 6.A: the skew is stored before it is divided, by an unrounded reciprocal."""
        path: Any = Path((-1.5, 0.5, 0.25), (-2.0, 0.0, 0.0))
        coll: Any = Collisions()
        n = coll.last_known_contact_plane.N = vec("N", 0.0, 0.0, 1.0)
        sphere().slide_sphere_along(path, coll, vec("d"), 0)
        c = coll.normal
        dx, dy, dz = (
            f(n.z * c.y - n.y * c.z),
            f(c.z * n.x - n.z * c.x),
            f(n.y * c.x - c.y * n.x),
        )
        length = (dz * dz + dy * dy) + dx * dx
        assert_compared(length, ">=", EPS)
        g = movement(path)
        d = (g.z * dz + g.y * dy) + g.x * dx
        inv = 1.0 / length
        ox, oy, oz = (f(f(v * d) * inv) for v in (dx, dy, dz))
        assert_compared((oz * oz + oy * oy) + ox * ox, "<", EPS)
        assert_vector(path.moved, f(ox - g.x), f(oy - g.y), f(oz - g.z))

    def test_slide_along_a_parallel_plane(self) -> None:
        """07 6.A.10, 6.A.11: z, y, x in both sums; the second is stored."""
        path: Any = Path((0.5, 0.25, 1.5), (0.0, 0.0, 2.0))
        coll: Any = Collisions()
        n = coll.last_known_contact_plane.N = vec("N", 0.0, 0.0, 1.0)
        disp = vec("d")
        sphere().slide_sphere_along(path, coll, disp, 0)
        assert_compared((n.z * disp.z + n.y * disp.y) + n.x * disp.x, "<", 0.0)
        c, g = coll.normal, movement(path)
        d = f((g.z * c.z + g.y * c.y) + g.x * c.x)
        assert_vector(path.moved, f(-c.x * d), f(-c.y * d), f(-c.z * d))

    def test_collide_with_point(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """07 7.2: x is multiplied in the register, y and z are stored first; so are the normal's."""
        t = Symbol(0.75, "t")
        asked: list[Any] = []
        monkeypatch.setattr(
            "oracle.sphere_responses.find_time_of_collision", lambda *given: asked.append(given) or t
        )
        path: Any = Path((-1.0, 0.0, 0.0), (-5.0, 0.0, 0.0))
        made, this, r = Clipped(path), sphere(), radsum()
        coll, s0 = made.collision_info, path.global_sphere[0]
        this.collide_with_point(made.object_info, path, coll, s0, r, 0)
        rs, m, p = f(r + EPS), movement(path), s0.center
        assert_vector(asked[0][0], m.x, m.y, m.z)
        assert_vector(asked[0][1], *(f(c - o) for c, o in zip(xyz(path), txyz(this.center), strict=True)))
        assert text_of(asked[0][2]) == text_of(rs)
        ux, uy, uz = m.x * t - m.x, f(m.y * t) - m.y, f(f(m.z * t) - m.z)
        assert_vector(path.moved, f(ux), f(uy), uz)
        inv = 1.0 / rs
        ex = f(f(ux + p.x) - this.center.x)
        ey = f((uy + p.y) - this.center.y)
        ez = (uz + p.z) - this.center.z
        assert_vector(coll.normal, f(ex * inv), f(ey * inv), f(ez * inv))

    def test_the_sum_of_the_radii(self) -> None:
        """07 8.2: both radii first, EPS last."""
        path: Any = Path((9.0, 0.0, 0.0), (9.0, 0.0, 0.0))
        path.insert_type = InsertType.PLACEMENT
        this = sphere()
        this.intersects_sphere(Clipped(path), is_creature=False)
        r, d = f((this.radius + path.global_sphere[0].radius) - EPS), minus(vec("S"), this.center)
        assert_compared(r * r, ">=", (d.y * d.y + d.x * d.x) + d.z * d.z)

    def test_rest_upon(self) -> None:
        """07 8.8: the sums of products, the root less the dot, and what is stored on the way."""
        path: Any = Path((0.25, 0.0, 1.5), (0.25, 0.0, 2.0))
        path.collide = 1
        made, this = Clipped(path), sphere()
        this.intersects_sphere(made, is_creature=False)
        s = path.global_sphere[0]
        r = f(f((this.radius + s.radius) - EPS) + EPS)
        mv, d = back(path), minus(s.center, this.center)
        a = (mv.z * mv.z + mv.y * mv.y) + mv.x * mv.x
        dot = (mv.y * d.y + mv.x * d.x) + mv.z * d.z
        b = -dot
        assert_compared(abs(a), "<", EPS)
        gap = ((d.y * d.y + d.x * d.x) + d.z * d.z) - r * r
        t = (b * b - gap * a).sqrt() - dot
        assert_compared(t, ">", 1.0)
        u = t / a
        w = (1.0 - u) * Symbol(1.0, "walk")
        assert_compared(w, ">=", -0.1)
        off: Any = scaled(u, mv)
        n: Any = plus(off, d)
        n.divide_by(r)
        assert given_plane(made.collision_info) == plane_text(n, minus(s.center, scaled(s.radius, n)))
        assert text_of(path.walk_interp) == text_of(f(w))
        assert_vector(path.moved, off.x, off.y, off.z)

    def test_the_other_root(self) -> None:
        """07 8.8.8: b + b less the undivided root."""
        path: Any = Path((0.0, 0.0, 1.0), (0.0, 0.0, 4.0))
        path.collide = 1
        this = sphere()
        this.intersects_sphere(Clipped(path), is_creature=False)
        r = f(f((this.radius + path.global_sphere[0].radius) - EPS) + EPS)
        mv, d = back(path), minus(vec("S"), this.center)
        a = (mv.z * mv.z + mv.y * mv.y) + mv.x * mv.x
        dot = (mv.y * d.y + mv.x * d.x) + mv.z * d.z
        b = -dot
        gap = ((d.y * d.y + d.x * d.x) + d.z * d.z) - r * r
        t = (b * b - gap * a).sqrt() - dot
        assert_compared((1.0 - ((b + b) - t) / a) * Symbol(1.0, "walk"), "<", Symbol(1.0, "walk"))

    def test_the_local_form(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """07 9.1, 9.2: scaled and stored, then to the block."""
        found: list[Any] = []
        monkeypatch.setattr(Sphere, "intersects_sphere", lambda self, *_, **__: found.append(self))
        path: Any = Path((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        path.check_pos, k, p = Position(HERE), Symbol(2.0, "k"), Position(HERE, frame("p"))
        this = sphere()
        this.intersects_sphere_at(p, k, Clipped(path), is_creature=False)
        assert text_of(found[0].radius) == text_of(f(k * this.radius))
        c = path.check_pos.localtoglobal(p, scaled(k, this.center))  # type: ignore[arg-type]
        assert_vector(found[0].center, c.x, c.y, c.z)


def xyz(path: Any) -> tuple[Any, Any, Any]:
    """Return where sphere 0 was."""
    return txyz(path.global_curr_center[0])


def txyz(v: Any) -> tuple[Any, Any, Any]:
    """Return a vector's components."""
    return v.x, v.y, v.z


class TestCylinder:
    """Document 07, section 10."""

    def test_overlap(self) -> None:
        """07 10.1: radius less EPS first; half the height twice."""
        this, ball, d, r = cylinder(), Sphere(vec("s"), Symbol(0.5, "q")), vec("d"), radsum()  # type: ignore[arg-type]
        this.collides_with_sphere(ball, d, r)
        assert_compared(r * r, ">=", d.x * d.x + d.y * d.y)
        half = this.height * 0.5
        assert_compared((ball.radius - EPS) + half, ">=", abs(half - d.z))

    def test_step_sphere_down(self) -> None:
        """07 10.2: the amount divides unrounded; the rise is stored for the point."""
        path: Any = Path((0.25, 0.125, 2.25), (0.0, 0.0, 0.0))
        coll, this, d = Collisions(), cylinder(), vec("d", 0.25, 0.125, 2.25)
        s = path.global_sphere[0]
        this.step_sphere_down(path, coll, s, d, radsum())
        dz = (this.height + s.radius) - d.z
        sd = Symbol(1.0, "amount") * Symbol(1.0, "walk")
        w = (1.0 - dz / sd) * Symbol(1.0, "walk")
        assert_compared(abs(sd), "<", EPS)
        assert_compared(w, ">=", Symbol(1.0, "walk"))
        assert_compared(w, "<", -0.1)
        p: Any = Vector3(s.center.x, s.center.y, f((f(dz) - s.radius) + s.center.z))
        assert given_plane(coll) == plane_text(Vector3(0.0, 0.0, 1.0), p)
        assert text_of(path.walk_interp) == text_of(f(w))
        assert_vector(path.moved, 0.0, 0.0, f(dz))

    def test_normal_of_collision(self) -> None:
        """07 10.3: the side is found in registers, the height is compared stored."""
        path: Any = Path((0.0, 0.0, 0.0), (3.0, 0.0, 9.0))
        this, d, r, normal = cylinder(), vec("d"), radsum(), Vector3()
        ball = path.global_sphere[0]
        this.normal_of_collision(path, ball, d, r, 0, normal)
        c, low = path.global_curr_center[0], this.low_pt
        ox, oy, oz = c.x - low.x, c.y - low.y, c.z - low.z
        assert_compared(r * r, "<", oy * oy + ox * ox)
        half = this.height * 0.5
        assert_compared((ball.radius - EPS) + half, ">=", abs(half - f(oz)))
        assert_compared(abs(f(oz) - d.z), "<=", EPS)
        assert_vector(normal, f(ox), f(oy), 0.0)
        path.global_curr_center[0] = vec("C", 0.0, 0.0, 9.0)
        this.normal_of_collision(path, ball, d, r, 0, normal)
        assert_compared(d.z - f(oz), "<=", 0.0)

    def clipped(self, s: tuple[float, float, float], c: tuple[float, float, float]) -> tuple[Any, Any, Any]:
        """Stop a perfect mover; return path, collision info and cylinder."""
        path: Any = Path(s, c)
        made, this = Clipped(path), cylinder()
        ball = path.global_sphere[0]
        d = minus(ball.center, this.low_pt)
        this.collide_with_point(made.object_info, path, made.collision_info, ball, d, radsum(), 0)
        return path, made.collision_info, this

    def touched(self, path: Any, off: Any) -> Any:
        """Write 07 10.4.8."""
        return minus(plus(path.global_curr_center[0], off), path.global_sphere[0].center)

    def side_normal(self, path: Any, this: Any, off: Any) -> Any:
        """Write the normal of 07 10.4.4.4.4."""
        h = minus(plus(path.global_curr_center[0], off), this.low_pt)
        n: Any = Vector3(h.x, h.y, 0.0)
        n.divide_by(f(radsum() + EPS))
        return n

    def test_clip_at_a_cap(self) -> None:
        """07 10.4.5: the time is stored before it multiplies."""
        path, _, this = self.clipped((0.0, 0.0, 2.0), (0.0, 0.0, 4.0))
        m, r = movement(path), Symbol(0.5, "r")
        od = minus(path.global_curr_center[0], this.low_pt)
        off: Any = scaled(f(((r + this.height) - od.z) / m.z), m)
        assert_vector(path.moved, *txyz(self.touched(path, off)))
        path, _, this = self.clipped((0.0, 0.0, 0.0), (0.0, 0.0, -2.0))
        off = scaled(f(-((od.z + r) / m.z)), m)
        assert_vector(path.moved, *txyz(self.touched(path, off)))

    def test_clip_at_a_corner(self) -> None:
        """07 10.4.4.3: the time multiplies unrounded, and the squared radius sum is stored."""
        path, coll, this = self.clipped((-1.0, 0.0, 2.0), (-3.0, 0.0, 4.0))
        m = movement(path)
        od = minus(path.global_curr_center[0], this.low_pt)
        t = ((Symbol(0.5, "r") + this.height) - od.z) / m.z
        off: Any = Vector3(f(m.x * t), f(m.y * t), f(t * m.z))
        assert_vector(path.moved, *txyz(self.touched(path, off)))
        assert_vector(coll.normal, 0.0, 0.0, 1.0)
        x, y = off.x + od.x, off.y + od.y
        rs = f(radsum() + EPS)
        assert_compared(y * y + x * x, ">=", f(rs * rs))

    @pytest.mark.parametrize("corner", [True, False])
    def test_clip_at_the_side(self, corner: bool) -> None:
        """07 10.4.4.4, 10.4.6: the same root, of a squared radius sum that only the corner stores."""
        s, c = ((0.0, 0.0, 1.0), (-8.0, 0.0, 4.0)) if corner else ((-1.0, 0.0, 1.0), (-5.0, 0.0, 1.0))
        path, coll, this = self.clipped(s, c)
        m = movement(path)
        od = minus(path.global_curr_center[0], this.low_pt)
        rs = f(radsum() + EPS)
        squared = f(rs * rs) if corner else rs * rs
        a = m.y * m.y + m.x * m.x
        dot = m.y * od.y + m.x * od.x
        b = -dot
        disc = b * b - ((od.y * od.y + od.x * od.x) - squared) * a
        assert_compared(disc, ">=", 0.0)
        off: Any = scaled(f((b - disc.sqrt()) / a), m)
        assert_vector(path.moved, *txyz(self.touched(path, off)))
        assert_vector(coll.normal, *txyz(self.side_normal(path, this, off)))

    def test_too_high_a_step(self) -> None:
        """07 10.6.1: compared in the register."""
        path: Any = Path((0.0, 0.0, 1.0), (0.0, 0.0, 9.0))
        made: Any = Clipped(path)
        made.object_info.step_up_height, d, this = Symbol(0.5, "up"), vec("d"), cylinder()
        this.step_sphere_up(made, path.global_sphere[0], d, radsum())
        assert_compared(made.object_info.step_up_height, "<", (Symbol(0.5, "r") + this.height) - d.z)

    def test_the_sum_of_the_radii(self) -> None:
        """07 10.8.1: EPS is taken from the cylinder's radius first."""
        path: Any = Path((9.0, 0.0, 0.0), (9.0, 0.0, 0.0))
        path.insert_type = InsertType.PLACEMENT
        this = cylinder()
        this.intersects_sphere(Clipped(path))
        r, d = f((this.radius - EPS) + path.global_sphere[0].radius), minus(vec("S"), this.low_pt)
        assert_compared(r * r, ">=", d.x * d.x + d.y * d.y)

    def test_rest_upon(self) -> None:
        """07 10.8.6: the time is stored for the offset, not for the interpolation."""
        path: Any = Path((0.25, 0.125, 2.0), (0.5, 0.25, 3.0))
        path.collide = 1
        made, this = Clipped(path), cylinder()
        this.intersects_sphere(made)
        s = path.global_sphere[0]
        mv, d = back(path), minus(s.center, this.low_pt)
        t = ((this.height + s.radius) - d.z) / mv.z
        off: Any = scaled(f(t), mv)
        r = f((this.radius - EPS) + s.radius)
        x, y = off.x + d.x, off.y + d.y
        assert_compared(abs(mv.z), "<", EPS)
        assert_compared(r * r, "<", y * y + x * x)
        w = (1.0 - t) * Symbol(1.0, "walk")
        assert_compared(w, "<", Symbol(1.0, "walk"))
        p: Any = plus(s.center, off)
        p.z = f(p.z - s.radius)
        assert given_plane(made.collision_info) == plane_text(Vector3(0.0, 0.0, 1.0), p)
        assert text_of(path.walk_interp) == text_of(f(w))
        assert_vector(path.moved, off.x, off.y, off.z)

    def test_the_local_form(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """07 10.9.2: radius, height and low point are scaled and stored."""
        found: list[Any] = []
        monkeypatch.setattr(CylSphere, "intersects_sphere", lambda self, *_: found.append(self))
        monkeypatch.setattr(Path, "cache_localspace_sphere", lambda *_: None)
        path: Any = Path((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        path.check_pos, k, p = Position(HERE), Symbol(2.0, "k"), Position(HERE, frame("p"))
        this = cylinder()
        this.intersects_sphere_at(p, k, Clipped(path))
        assert text_of(found[0].radius) == text_of(f(k * this.radius))
        assert text_of(found[0].height) == text_of(f(k * this.height))
        low = path.check_pos.localtoglobal(p, scaled(k, this.low_pt))  # type: ignore[arg-type]
        assert_vector(found[0].low_pt, low.x, low.y, low.z)
