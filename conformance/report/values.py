"""How single values read: floats with their bits, states and ids by name, never bare numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from conformance.fields import MISSING, fits
from conformance.floats import bits32, bits64, decimal32, is_float32
from conformance.shapes import Kind

if TYPE_CHECKING:
    from conformance.compare import Difference

_BLOCK_WIDTH: Final = 72
"""Characters after which a whole block is cut; its parts are listed by their own differences."""
_EXACT_ULPS: Final = 1_000_000
"""Up to here a count of ULPs is written out; above, its size is what matters."""

MOVER_STATE_NAMES: Final = {
    0x1: "contact",
    0x2: "on_walkable",
    0x4: "viewer",
    0x8: "path_clipped",
    0x10: "free_rotate",
    0x40: "perfect_clip",
    0x80: "impenetrable",
    0x100: "player",
    0x200: "edge_slide",
    0x400: "ignore_creatures",
    0x800: "pk",
    0x1000: "pk_lite",
}
"""Bits of OBJECTINFO's state (04)."""


def format_value(kind: Kind, value: Any) -> str:
    """Write one value of a kind; a value of another type is shown as it is, with its type."""
    if value is MISSING or value is None:
        return "none" if value is None else str(value)
    if kind is Kind.BLOCK:
        return format_block(value)
    if not fits(kind, value):
        return f"{value!r} ({type(value).__name__})"
    match kind:
        case Kind.FLOAT32:
            shown = decimal32(value) if is_float32(value) else repr(float(value))
            return f"{shown} (0x{bits32(value):08X})"
        case Kind.FLOAT64:
            return f"{float(value)!r} (0x{bits64(value):016X})"
        case Kind.CELL:
            return format_cell(value)
        case Kind.MOVER_BITS:
            return format_mover_state(value)
        case Kind.BITS:
            return f"0x{value:X}"
        case Kind.TEXT:
            return value or '""'
        case _:
            return str(int(value)) if isinstance(value, int) else str(value)


def format_block(value: Any) -> str:
    """Write a vector, list or mapping on one line, floats as short decimals."""
    text = _short(value)
    return text if len(text) <= _BLOCK_WIDTH else text[: _BLOCK_WIDTH - 3] + "..."


def format_cell(cell: int) -> str:
    """Write a cell id the way the game's tools do."""
    return f"0x{cell:08X}"


def format_mover_state(bits: int) -> str:
    """Write a mover's state bits with their names."""
    names = [name for bit, name in MOVER_STATE_NAMES.items() if bits & bit]
    return f"0x{bits:X} ({', '.join(names)})" if names else f"0x{bits:X}"


def format_point(point: Any) -> str:
    """Write a vector as ``(x, y, z)`` in short decimals."""
    return f"({', '.join(decimal32(v) for v in point)})"


def format_ulps(difference: Difference) -> str:
    """Write the distance of two floats in units of the last place; empty where there is none."""
    ulps = difference.ulps
    if ulps is None:
        return ""
    if ulps >= _EXACT_ULPS:
        mantissa, exponent = f"{ulps:.1e}".split("e")
        return f"{mantissa}e{int(exponent)} ULPs"
    return f"{ulps} ULP" if ulps == 1 else f"{ulps} ULPs"


def _short(value: Any) -> str:
    if isinstance(value, float):
        return decimal32(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(_short(v) for v in value)}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{k}: {_short(v)}' for k, v in value.items())}}}"
    return str(value)
