"""Position: a frame in the coordinates of a landblock."""

from __future__ import annotations

from oracle.arithmetic import f32
from oracle.frame import Frame
from oracle.land_defs import adjust_to_outside, get_block_offset
from oracle.vector import Vector3


class Position:
    """A cell id and a frame.

    The frame's origin is in metres from the south-west corner of the landblock ``objcell_id >> 16``.
    ``Position()`` is cell 0 and the identity.
    """

    __slots__ = ("frame", "objcell_id")

    def __init__(self, objcell_id: int = 0, frame: Frame | None = None) -> None:
        self.objcell_id = objcell_id
        self.frame = Frame() if frame is None else frame

    def __repr__(self) -> str:
        return f"Position({self.objcell_id:#010x}, {self.frame!r})"

    def copy(self) -> Position:
        """Return a bit copy."""
        return Position(self.objcell_id, self.frame.copy())

    def assign(self, other: Position) -> None:
        """Copy the cell id and all 16 floats of the frame."""
        self.objcell_id = other.objcell_id
        self.frame.assign(other.frame)

    def localtoglobal_origin(self, p: Position) -> Vector3:
        """Return the origin of `p` in this position's block coordinates.

        retail: Position::localtoglobal(p) 0x004528C0, 01 5.2.
        """
        off = get_block_offset(self.objcell_id, p.objcell_id)
        o = p.frame.origin
        return Vector3(f32(off.x + o.x), f32(off.y + o.y), f32(off.z + o.z))

    def localtoglobal(self, p: Position, v: Vector3) -> Vector3:
        """Return the point `v`, local to `p`, in this position's *block* coordinates.

        Of this position only the cell id is used. Two roundings per component.

        retail: Position::localtoglobal(p, v) 0x00456180, 01 5.3.
        """
        gx, gy, gz = _to_block(p.frame, v)
        g = Vector3(f32(gx), f32(gy), f32(gz))
        off = get_block_offset(self.objcell_id, p.objcell_id)
        return Vector3(f32(off.x + g.x), f32(off.y + g.y), f32(off.z + g.z))

    def localtoglobalvec(self, v: Vector3) -> Vector3:
        """Rotate a local direction, z term last (unlike Frame's).

        retail: Position::localtoglobalvec 0x00456220, 01 5.4.
        """
        f = self.frame
        return Vector3(
            f32((f.m3 * v.y + f.m0 * v.x) + f.m6 * v.z),
            f32((f.m4 * v.y + f.m1 * v.x) + f.m7 * v.z),
            f32((f.m5 * v.y + f.m2 * v.x) + f.m8 * v.z),
        )

    def globaltolocalvec(self, v: Vector3) -> Vector3:
        """Rotate a global direction back, z term last (unlike Frame's).

        retail: Position::globaltolocalvec 0x0050C420, 01 5.5.
        """
        f = self.frame
        return Vector3(
            f32((f.m1 * v.y + f.m0 * v.x) + f.m2 * v.z),
            f32((f.m4 * v.y + f.m3 * v.x) + f.m5 * v.z),
            f32((f.m7 * v.y + f.m6 * v.x) + f.m8 * v.z),
        )

    def localtolocal(self, p: Position, v: Vector3) -> Vector3:
        """Return the point `v`, local to `p`, in this position's local space.

        retail: Position::localtolocal 0x004527F0, 01 5.6.
        """
        q = self.localtoglobal(p, v)  # the same arithmetic, inlined in retail
        return self.frame.globaltolocal(q)

    def get_offset(self, p: Position) -> Vector3:
        """Return the vector from this position's origin to that of `p`.

        retail: Position::get_offset(p) 0x00509F60, 01 5.8.
        """
        off = get_block_offset(self.objcell_id, p.objcell_id)
        ax = off.x + p.frame.origin.x
        ay = f32(off.y + p.frame.origin.y)
        az = f32(off.z + p.frame.origin.z)
        o = self.frame.origin
        return Vector3(f32(ax - o.x), f32(ay - o.y), f32(az - o.z))

    def get_offset_point(self, p: Position, v: Vector3) -> Vector3:
        """Return the vector from this position's origin to the point `v`, local to `p`.

        retail: Position::get_offset(p, v) 0x0050D920, 01 5.9.
        """
        gx, gy, gz = _to_block(p.frame, v)
        gz = f32(gz)
        off = get_block_offset(self.objcell_id, p.objcell_id)
        bx = f32(off.x + gx)
        bz = f32(off.z + gz)
        o = self.frame.origin
        return Vector3(f32(bx - o.x), f32((off.y + gy) - o.y), f32(bz - o.z))

    def distance(self, p: Position) -> float:
        """Return the distance between the two origins, metres, as a register.

        retail: Position::distance 0x005A94B0, 01 5.10.
        """
        return self.get_offset(p).magnitude()

    def get_outside_cell_id(self) -> int:
        """Return the id of the land cell under or above the origin, 0 without one; changes nothing.

        retail: Position::get_outside_cell_id 0x004527B0, 10 2.10.
        """
        _, cell_id = adjust_to_outside(self.objcell_id, self.frame.origin.copy())
        return cell_id


def _to_block(f: Frame, v: Vector3) -> tuple[float, float, float]:
    """Take a local point to its frame's block coordinates, in registers, z term last (01 5.3)."""
    return (
        ((f.m3 * v.y + f.m0 * v.x) + f.m6 * v.z) + f.origin.x,
        ((f.m4 * v.y + f.m1 * v.x) + f.m7 * v.z) + f.origin.y,
        ((f.m5 * v.y + f.m2 * v.x) + f.m8 * v.z) + f.origin.z,
    )
