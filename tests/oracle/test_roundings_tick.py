"""Where the tick rounds and in which order it adds: checked on expressions, not on numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from oracle_bodies import walker
from oracle_worlds import CELL
from symbols import Symbol, assert_compared, assert_vector, f, frame, vec

from oracle.collision_info import CollisionInfo
from oracle.frame import Frame
from oracle.physics_object import PhysicsObj
from oracle.physics_part import PartArray
from oracle.physics_state import ALIGNPATH_PS, SLEDDING_PS
from oracle.plane import Plane
from oracle.position import Position
from oracle.transient_state import ACTIVE_TS
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.world import World

if TYPE_CHECKING:
    import pytest

Q: Any = Symbol(0.125, "q")


def body(**fields: Any) -> Any:
    """Return an object of symbols."""
    made: Any = walker(**fields)
    made.m_velocity, made.m_acceleration, made.m_omega = vec("v", 4.0, 4.0, -1.0), vec("a"), vec("w")
    made.contact_plane = Plane(vec("N", 0.0, 0.0, 1.0), Symbol(0.0, "d"))  # type: ignore[arg-type]
    made.friction, made.elasticity = Symbol(0.9375, "k"), Symbol(0.0625, "e")
    return made


def test_integration(monkeypatch: pytest.MonkeyPatch) -> None:
    """PH-1, PH-6…8: each axis has its own order of stores."""
    turned: list[Any] = []
    monkeypatch.setattr(Frame, "grotate", lambda _self, w: turned.append(w))
    made, out = body(transient=ACTIVE_TS), frame("p")
    v, a, w, o = made.m_velocity.copy(), made.m_acceleration, made.m_omega, out.origin.copy()
    Symbol.compared.clear()
    made.update_physics_internal(Q, out)
    v2 = f((v.x * v.x + v.y * v.y) + v.z * v.z)
    assert_compared(v2, "<=", 0.0)
    assert_compared(v2, ">", 2500.0)
    px, py = f(f((a.x * 0.5) * Q) * Q), f(((a.y * 0.5) * Q) * Q)
    sz = f(f(Q * v.z) + (f(a.z * 0.5) * Q) * Q)
    assert_vector(out.origin, f(f(Q * v.x + px) + o.x), f((Q * v.y + py) + o.y), f(sz + o.z))
    assert_vector(made.m_velocity, f(Q * a.x + v.x), f(Q * a.y + v.y), f(f(Q * a.z) + v.z))
    assert_vector(turned[0], f(Q * w.x), f(Q * w.y), f(Q * w.z))


def test_the_speed_limit() -> None:
    """PH-3, SV-1: fifty times the rounded direction."""
    made, v, n = body(), vec("v", 60.0, 0.0, 80.0), vec("v", 60.0, 0.0, 80.0)
    n.normalize()
    made.set_velocity(v, 0)
    assert_vector(made.m_velocity, f(50.0 * n.x), f(50.0 * n.y), f(50.0 * n.z))


def test_friction() -> None:
    """CF-2, CF-3, CF-5: only z's product is stored before it is subtracted."""
    made = body()
    v, n = made.m_velocity.copy(), made.contact_plane.N
    Symbol.compared.clear()
    made.calc_friction(Q, Symbol(33.0, "v2"))
    d = (v.z * n.z + v.y * n.y) + v.x * n.x
    assert_compared(d, ">=", 0.25)
    s = (1.0 - made.friction).power(Q)
    assert_vector(
        made.m_velocity, f(s * f(v.x - d * n.x)), f(s * f(v.y - d * n.y)), f(s * f(v.z - f(d * n.z)))
    )


def test_the_friction_of_a_sled() -> None:
    """CF-4: the comparisons."""
    made, v2 = body(state=SLEDDING_PS), Symbol(6.25, "v2")
    Symbol.compared.clear()
    made.calc_friction(Q, v2)
    assert_compared(v2, "<", 1.5625)
    assert_compared(v2, "<", 6.25)
    assert_compared(made.contact_plane.N.z, ">=", 0.984807753012208)


def test_local_velocity() -> None:
    """06 5: the z terms last."""
    made = body()
    made.m_position.frame = frame("m")
    m, l = made.m_position.frame, vec("l", 9.0, 8.0, 7.0)
    made.set_local_velocity(l, 0)
    assert_vector(
        made.m_velocity,
        f((m.m0 * l.x + m.m3 * l.y) + m.m6 * l.z),
        f((m.m1 * l.x + m.m4 * l.y) + m.m7 * l.z),
        f((m.m2 * l.x + m.m5 * l.y) + m.m8 * l.z),
    )


def test_leaving_the_plane() -> None:
    """06 6: compared unrounded, x last."""
    made = body()
    v, n = made.m_velocity, made.contact_plane.N
    Symbol.compared.clear()
    made.check_contact(1)
    assert_compared((v.z * n.z + v.y * n.y) + v.x * n.x, ">", 0.00019999999494757503)


def test_a_bounce() -> None:
    """HC-5: x has one store, y and z two."""
    made, ci = body(transient=ACTIVE_TS), CollisionInfo()
    ci.collision_normal, ci.collision_normal_valid = vec("n", -0.5, 0.25, 0.125), 1
    v, n = made.m_velocity.copy(), ci.collision_normal
    made.handle_all_collisions(ci, 0, 0)
    e = -(((v.z * n.z + v.y * n.y) + n.x * v.x) * (made.elasticity + 1.0))
    assert_vector(made.m_velocity, f(e * n.x + v.x), f(f(e * n.y) + v.y), f(f(e * n.z) + v.z))


def test_turning(monkeypatch: pytest.MonkeyPatch) -> None:
    """06 5: grotate keeps sine and the z term in registers, stores cosine, reciprocal and two terms."""
    turned: list[Any] = []
    monkeypatch.setattr(Frame, "set_rotate", lambda _self, *q: turned.extend(q))
    m, w = frame("m"), vec("w")
    m.grotate(w)
    th = ((w.x * w.x + w.y * w.y) + w.z * w.z).sqrt()
    inv, s, c = f(1.0 / th), (th * 0.5).sin(), f((th * 0.5).cos())
    x, y, z = f((s * w.x) * inv), f((inv * s) * w.y), (s * inv) * w.z
    assert [q.text for q in turned] == [
        f(((c * m.qw - x * m.qx) - y * m.qy) - z * m.qz).text,
        f(((c * m.qx + y * m.qz) + x * m.qw) - z * m.qy).text,
        f(((c * m.qy - x * m.qz) + z * m.qx) + y * m.qw).text,
        f(((x * m.qy + c * m.qz) - y * m.qx) + z * m.qw).text,
    ]


def test_measured_velocity(monkeypatch: pytest.MonkeyPatch) -> None:
    """UO-10: x with the reciprocal in the register, y and z with the stored one."""
    finished = Transition(World())
    finished.sphere_path.curr_pos = Position(CELL, frame("t"))
    monkeypatch.setattr(PhysicsObj, "transition", lambda *_: finished)
    monkeypatch.setattr(PhysicsObj, "set_position_internal", lambda *_: 1)
    made = body(transient=ACTIVE_TS)
    diff = made.m_position.get_offset(finished.sphere_path.curr_pos)
    made.update_object_internal(Q)
    r = 1.0 / Q
    assert_vector(made.cached_velocity, f(r * diff.x), f(f(r) * diff.y), f(f(r) * diff.z))


def test_the_direction_of_a_path(monkeypatch: pytest.MonkeyPatch) -> None:
    """UO-6: the three differences are stored before they are normalised."""
    given: list[Any] = []
    monkeypatch.setattr(Vector3, "normalize", lambda self: given.append(self.copy()))
    monkeypatch.setattr(Frame, "set_vector_heading", lambda *_: None)
    monkeypatch.setattr(PhysicsObj, "transition", lambda *_: None)
    made = body(state=ALIGNPATH_PS, transient=ACTIVE_TS)
    made.m_position.frame.origin = vec("o")
    wanted = vec("p", 8.0, 8.0, 8.0)
    monkeypatch.setattr(
        PhysicsObj, "update_position_internal", lambda _self, _q, out: out.origin.assign(wanted)
    )
    made.update_object_internal(0.125)
    o = vec("o")
    assert_vector(given[0], f(wanted.x - o.x), f(wanted.y - o.y), f(wanted.z - o.z))


def test_root_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """UPI-2: scaled, then stored."""
    given: list[Any] = []
    monkeypatch.setattr(Frame, "combine", lambda _self, _old, offset: given.append(offset.origin))
    monkeypatch.setattr(PartArray, "update", lambda _self, _q, out: out.origin.assign(vec("r")))
    made = walker(state=0)
    made.m_scale = Symbol(2.0, "s")  # type: ignore[assignment]
    made.update_position_internal(0.125, Frame())
    r, s = vec("r"), made.m_scale
    assert_vector(given[0], f(r.x * s), f(r.y * s), f(r.z * s))
