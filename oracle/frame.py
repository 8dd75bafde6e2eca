"""Frame: a rotation (quaternion and its cached float32 matrix) and an origin."""

from __future__ import annotations

from oracle.arithmetic import acos, asin, atan2, cos, divide, f32, fmod, is_nan, sin, sqrt
from oracle.constants import DEGREES_PER_RADIAN, EPS, EPS2, EPS5, FULL_TURN, HEADING_TURN, RADIANS_PER_DEGREE
from oracle.vector import Vector3


class Frame:
    """A rigid pose: local axes and origin in the enclosing space, metres.

    ``m0 … m8`` are the images of the three local axes, one after the other. Rotating always uses this
    float32 matrix, never the quaternion (01 4.1). ``Frame()`` is the identity.
    """

    __slots__ = ("m0", "m1", "m2", "m3", "m4", "m5", "m6", "m7", "m8", "origin", "qw", "qx", "qy", "qz")

    m0: float
    m1: float
    m2: float
    m3: float
    m4: float
    m5: float
    m6: float
    m7: float
    m8: float

    def __init__(self) -> None:
        self.qw = 1.0
        self.qx = 0.0
        self.qy = 0.0
        self.qz = 0.0
        self.origin = Vector3()
        self.cache()

    def __repr__(self) -> str:
        return f"Frame({self.origin!r}, {self.qw!r}, {self.qx!r}, {self.qy!r}, {self.qz!r})"

    @classmethod
    def unpack(cls, origin: Vector3, qw: float, qx: float, qy: float, qz: float) -> Frame:
        """Make a frame as the data files' reader does: the quaternion is *not* normalised (01 4.4)."""
        frame = cls()
        frame.origin.assign(origin)
        frame.qw = qw
        frame.qx = qx
        frame.qy = qy
        frame.qz = qz
        frame.cache()
        return frame

    def copy(self) -> Frame:
        """Return a bit copy."""
        frame = Frame.__new__(Frame)
        frame.origin = Vector3()
        frame.assign(self)
        return frame

    def assign(self, other: Frame) -> None:
        """Copy all 16 floats; the matrix is copied, never recomputed (01 4.1)."""
        self.qw = other.qw
        self.qx = other.qx
        self.qy = other.qy
        self.qz = other.qz
        self.m0 = other.m0
        self.m1 = other.m1
        self.m2 = other.m2
        self.m3 = other.m3
        self.m4 = other.m4
        self.m5 = other.m5
        self.m6 = other.m6
        self.m7 = other.m7
        self.m8 = other.m8
        self.origin.assign(other.origin)

    def cache(self) -> None:
        """Compute the matrix from the quaternion.

        retail: Frame::cache 0x00534DF0, 01 4.2.
        """
        x2 = self.qx + self.qx
        y2 = self.qy + self.qy
        z2 = self.qz + self.qz
        wx = self.qw * x2
        wy = self.qw * y2
        wz = self.qw * z2
        xx = self.qx * x2
        xy = self.qx * y2
        xz = self.qx * z2
        yy = self.qy * y2
        yz = self.qy * z2
        zz = self.qz * z2
        self.m0 = f32((1.0 - yy) - zz)
        self.m1 = f32(xy + wz)
        self.m2 = f32(xz - wy)
        self.m3 = f32(xy - wz)
        self.m4 = f32((1.0 - xx) - zz)
        self.m5 = f32(yz + wx)
        self.m6 = f32(xz + wy)
        self.m7 = f32(yz - wx)
        self.m8 = f32((1.0 - xx) - yy)

    def is_valid(self) -> bool:
        """Tell whether nothing is NaN and the quaternion is of unit length, within 5 EPS.

        retail: Frame::IsValid 0x00534ED0, 01 4.3.
        """
        o = self.origin
        ok = not any(is_nan(c) for c in (o.x, o.y, o.z, self.qw, self.qx, self.qy, self.qz))
        n = f32(((self.qz * self.qz + self.qy * self.qy) + self.qx * self.qx) + self.qw * self.qw)
        if is_nan(n) or abs(n - 1.0) > EPS5:
            return False
        return ok

    def set_rotate(self, w: float, x: float, y: float, z: float) -> None:
        """Take the normalised quaternion; one that cannot be normalised changes nothing.

        retail: Frame::set_rotate 0x00535080, 01 4.4.
        """
        old = (self.qw, self.qx, self.qy, self.qz)
        inv = divide(1.0, sqrt(((w * w + x * x) + y * y) + z * z))
        self.qw = f32(w * inv)
        self.qx = f32(x * inv)
        self.qy = f32(y * inv)
        self.qz = f32(z * inv)
        if self.is_valid():
            self.cache()
        else:
            self.qw, self.qx, self.qy, self.qz = old

    def localtoglobalvec(self, v: Vector3) -> Vector3:
        """Rotate a local direction, y term last.

        retail: Frame::localtoglobalvec 0x004524F0, 01 4.5.
        """
        return Vector3(
            f32((self.m6 * v.z + self.m0 * v.x) + self.m3 * v.y),
            f32((self.m7 * v.z + self.m1 * v.x) + self.m4 * v.y),
            f32((self.m8 * v.z + self.m2 * v.x) + self.m5 * v.y),
        )

    def localtoglobal(self, v: Vector3) -> Vector3:
        """Rotate and move a local point, y term last before the origin, one store.

        retail: Frame::localtoglobal 0x00452620, 01 4.5.
        """
        o = self.origin
        return Vector3(
            f32(((self.m6 * v.z + self.m0 * v.x) + self.m3 * v.y) + o.x),
            f32(((self.m7 * v.z + self.m1 * v.x) + self.m4 * v.y) + o.y),
            f32(((self.m8 * v.z + self.m2 * v.x) + self.m5 * v.y) + o.z),
        )

    def globaltolocalvec(self, v: Vector3) -> Vector3:
        """Rotate a global direction back, by the transposed matrix, y term last.

        retail: Frame::globaltolocalvec 0x00452550, 01 4.5.
        """
        return Vector3(
            f32((self.m2 * v.z + self.m0 * v.x) + self.m1 * v.y),
            f32((self.m5 * v.z + self.m3 * v.x) + self.m4 * v.y),
            f32((self.m8 * v.z + self.m6 * v.x) + self.m7 * v.y),
        )

    def globaltolocal(self, v: Vector3) -> Vector3:
        """Take a global point to local space; z reads the unrounded difference, x and y do not.

        retail: Frame::globaltolocal 0x00452680, 01 4.6.
        """
        dx = f32(v.x - self.origin.x)
        dy = f32(v.y - self.origin.y)
        dz = v.z - self.origin.z
        dz32 = f32(dz)
        return Vector3(
            f32((dz32 * self.m2 + dx * self.m0) + dy * self.m1),
            f32((dz32 * self.m5 + dx * self.m3) + dy * self.m4),
            f32((dz * self.m8 + dx * self.m6) + dy * self.m7),
        )

    def combine(self, f1: Frame, f2: Frame) -> None:
        """Become `f2`, expressed in `f1`.

        retail: Frame::combine(Frame, Frame) 0x005122E0, 01 4.7.
        """
        origin = f1.localtoglobal(f2.origin)
        w = f32(((f1.qw * f2.qw - f1.qx * f2.qx) - f2.qy * f1.qy) - f2.qz * f1.qz)
        x = f32(((f1.qw * f2.qx + f2.qz * f1.qy) + f2.qw * f1.qx) - f2.qy * f1.qz)
        y = f32(((f2.qy * f1.qw - f1.qx * f2.qz) + f1.qz * f2.qx) + f1.qy * f2.qw)
        z = f32(((f1.qx * f2.qy + f2.qz * f1.qw) - f1.qy * f2.qx) + f1.qz * f2.qw)
        self.origin.assign(origin)
        self.set_rotate(w, x, y, z)

    def combine_aframe(self, f1: Frame, f2: Frame) -> None:
        """Become the animation frame `f2`, expressed in `f1`; `combine` but for the order of x.

        retail: Frame::combine(Frame, AFrame) 0x00525180, 01 4.7.
        """
        origin = f1.localtoglobal(f2.origin)
        w = f32(((f1.qw * f2.qw - f1.qx * f2.qx) - f2.qy * f1.qy) - f2.qz * f1.qz)
        x = f32(((f1.qx * f2.qw + f1.qw * f2.qx) + f2.qz * f1.qy) - f2.qy * f1.qz)
        y = f32(((f2.qy * f1.qw - f1.qx * f2.qz) + f1.qz * f2.qx) + f1.qy * f2.qw)
        z = f32(((f1.qx * f2.qy + f2.qz * f1.qw) - f1.qy * f2.qx) + f1.qz * f2.qw)
        self.origin.assign(origin)
        self.set_rotate(w, x, y, z)

    def combine_scaled(self, f1: Frame, f2: Frame, scale: Vector3) -> None:
        """Become the animation frame `f2`, its origin scaled per axis, expressed in `f1`.

        retail: Frame::combine(Frame, AFrame, scale) 0x00518FD0, 01 4.7.
        """
        sx = f2.origin.x * scale.x
        sy = f2.origin.y * scale.y
        sz = f2.origin.z * scale.z
        origin = Vector3(
            f32(((sx * f1.m0 + sz * f1.m6) + sy * f1.m3) + f1.origin.x),
            f32(((sx * f1.m1 + sz * f1.m7) + sy * f1.m4) + f1.origin.y),
            f32(((sx * f1.m2 + sz * f1.m8) + sy * f1.m5) + f1.origin.z),
        )
        w = f32(((f1.qw * f2.qw - f1.qx * f2.qx) - f2.qy * f1.qy) - f2.qz * f1.qz)
        x = f32(((f2.qx * f1.qw + f2.qw * f1.qx) + f2.qz * f1.qy) - f2.qy * f1.qz)
        y = f32(((f1.qw * f2.qy - f1.qx * f2.qz) + f2.qx * f1.qz) + f2.qw * f1.qy)
        z = f32(((f1.qw * f2.qz + f1.qx * f2.qy) - f2.qx * f1.qy) + f2.qw * f1.qz)
        self.origin.assign(origin)
        self.set_rotate(w, x, y, z)

    def interpolate_origin(self, from_: Frame, to: Frame, t: float) -> None:
        """Take the origin at the fraction `t` of the way.

        retail: Frame::interpolate_origin 0x005352F0, 01 4.8.
        """
        u = 1.0 - t
        ax = f32(u * from_.origin.x)
        ay = f32(u * from_.origin.y)
        az = f32(u * from_.origin.z)
        by = f32(t * to.origin.y)
        bz = f32(t * to.origin.z)
        self.origin.x = f32(t * to.origin.x + ax)
        self.origin.y = f32(ay + by)
        self.origin.z = f32(az + bz)

    def interpolate_rotation(self, from_: Frame, to: Frame, t: float) -> None:
        """Take the rotation at the fraction `t` of the way, the short way round.

        retail: Frame::interpolate_rotation 0x00535390, 01 4.8.
        """
        w, x, y, z = to.qw, to.qx, to.qy, to.qz
        c = ((from_.qy * y + from_.qw * w) + from_.qx * x) + from_.qz * z
        if c < 0.0:
            c = -c
            w, x, y, z = -w, -x, -y, -z
        k0 = 1.0 - t
        k1 = t
        if not 1.0 - c <= EPS:
            om = acos(c)
            s = 1.0 / sin(om)
            k0 = s * sin(om * (1.0 - t))
            k1 = sin(t * om) * s
            if k0 < 0.0 or k0 > 1.0 or k1 < 0.0 or k1 > 1.0:
                k0 = 1.0 - t
                k1 = t
        self.set_rotate(
            f32(k0 * from_.qw + w * k1),
            f32(from_.qx * k0 + x * k1),
            f32(from_.qy * k0 + y * k1),
            f32(z * k1 + from_.qz * k0),
        )

    def get_vector_heading(self) -> Vector3:
        """Return the local y axis.

        retail: Frame::get_vector_heading 0x00535720, 01 4.8.
        """
        return Vector3(
            f32((self.m6 + self.m0) * 0.0 + self.m3),
            f32((self.m7 + self.m1) * 0.0 + self.m4),
            f32((self.m8 + self.m2) * 0.0 + self.m5),
        )

    def euler_set_rotate(self, x: float, y: float, z: float) -> None:
        """Take the rotation of three angles in radians, in retail's order 0.

        retail: Frame::euler_set_rotate 0x00535BF0, 01 4.8.
        """
        hx = x * 0.5
        hy = y * 0.5
        hz = f32(z * 0.5)
        cx = f32(cos(hx))
        cy = f32(cos(hy))
        cz = f32(cos(hz))
        sx = f32(sin(hx))
        sy = sin(hy)
        sz = sin(hz)
        cc = f32(cz * cx)
        cs = f32(cx * sz)
        sc = f32(sx * cz)
        ss = f32(sz * sx)
        self.set_rotate(
            f32(ss * sy + cc * cy),
            f32(sc * cy - cs * sy),
            f32(cc * sy + ss * cy),
            f32(cs * cy - sc * sy),
        )

    def set_vector_heading(self, v: Vector3) -> None:
        """Turn local y to the direction `v`; a vector shorter than EPS changes nothing.

        retail: Frame::set_vector_heading 0x00535DB0, 01 4.8.
        """
        n = v.copy()
        if n.normalize_check_small():
            return
        heading = fmod(HEADING_TURN - atan2(n.y, n.x) * DEGREES_PER_RADIAN, FULL_TURN)
        z = f32((-heading) * RADIANS_PER_DEGREE)
        x = f32((asin(n.z) * DEGREES_PER_RADIAN) * RADIANS_PER_DEGREE)
        self.euler_set_rotate(x, 0.0, z)

    def set_heading(self, degrees: float) -> None:
        """Turn to a heading: 0 is north (+y), 90 is east (+x); the slope of local y stays.

        retail: Frame::set_heading 0x00535E40, 01 4.8.
        """
        r = degrees * RADIANS_PER_DEGREE
        v = Vector3(f32(sin(r)), f32(cos(r)), f32((self.m8 + self.m2) * 0.0 + self.m5))
        self.set_vector_heading(v)

    def get_heading(self) -> float:
        """Return the heading of local y, degrees, as a register.

        retail: Frame::get_heading 0x00535760, 01 4.8.
        """
        x = (self.m6 + self.m0) * 0.0 + self.m3
        y = (self.m7 + self.m1) * 0.0 + self.m4
        return fmod(HEADING_TURN - atan2(y, x) * DEGREES_PER_RADIAN, FULL_TURN)

    def grotate(self, w: Vector3) -> None:
        """Turn about a global axis through the origin, by the length of `w` in radians.

        retail: Frame::grotate 0x005357A0, 06 5.
        """
        m = (w.x * w.x + w.y * w.y) + w.z * w.z
        if m < EPS2:
            return
        th = sqrt(m)
        inv = f32(1.0 / th)
        h = th * 0.5
        s = sin(h)
        c = f32(cos(h))
        f = f32((s * w.x) * inv)
        g = f32((inv * s) * w.y)
        e = (s * inv) * w.z
        self.set_rotate(
            f32(((c * self.qw - f * self.qx) - g * self.qy) - e * self.qz),
            f32(((c * self.qx + g * self.qz) + f * self.qw) - e * self.qy),
            f32(((c * self.qy - f * self.qz) + e * self.qx) + g * self.qw),
            f32(((f * self.qy + c * self.qz) - g * self.qx) + e * self.qw),
        )

    def is_equal(self, other: Frame) -> bool:
        """Tell whether origins differ by at most EPS and quaternions by less, per component.

        retail: Frame::is_equal 0x00424C30, 04 3.
        """
        return (
            self.origin.equals(other.origin)
            and abs(self.qw - other.qw) < EPS
            and abs(self.qx - other.qx) < EPS
            and abs(self.qy - other.qy) < EPS
            and abs(self.qz - other.qz) < EPS
        )
