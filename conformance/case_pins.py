"""From the ``expect`` block of a case to pins, checked against the outputs of its op."""

from __future__ import annotations

import struct
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from conformance.compare import Tolerance
from conformance.fields import FieldError, UnknownFieldError, kind_of, locate, normalise_shape
from conformance.outputs import OUTPUTS
from conformance.pins import Pin
from conformance.schema.expect import FreeNumberModel
from conformance.schema.values import MOVER_STATES
from conformance.shapes import FLOAT_KINDS, Kind, Listing, Nullable
from conformance.source import Fault, describe, format_path, nearest, parse_path, quoted
from conformance.step_outputs import STEP_OUTPUTS
from conformance.validation import validate

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.source import DocPath

STATE_NAMES: Final = ("INVALID", "OK", "COLLIDED", "ADJUSTED", "SLID")
"""What a field of states may be (01 §7)."""


def make_pins(
    op: str, expect: dict[str, Any], below: DocPath = ("expect",)
) -> tuple[tuple[Pin, ...], list[Fault]]:
    """Read the pinned outputs of a case, or of a tick of a walk.

    Parameters
    ----------
    op : str
        The operation, or the name of its ticks, which decides what outputs there are.
    expect : dict
        Output fields, nested as in FORMAT.md; `contact_plane: {d: …}` may stand for its plane's part.
    below : DocPath
        The way from the case to them.

    Returns
    -------
    tuple of Pin
        One for each single value or null.
    list of Fault
        Unknown fields and unfitting values; paths start at the case.
    """
    pins: list[Pin] = []
    faults: list[Fault] = []
    if op not in OUTPUTS and op not in STEP_OUTPUTS:
        return (), []  # a raw query may name any op; that it does not exist is told where it is read
    for path, value in _leaves(expect, ()):
        try:
            pins += _pins(op, path, value)
        except _WrongPinError as error:
            faults += [error.fault]
    if not faults:
        pins += _counts(op, expect, ())
    return tuple(pins), [replace(fault, path=(*below, *fault.path)) for fault in faults]


class _WrongPinError(Exception):
    def __init__(self, path: DocPath, found: str, expected: str, hint: str = "") -> None:
        super().__init__(found, expected)
        self.fault = Fault(path, found, expected, hint)


def _leaves(value: Any, path: DocPath) -> Iterator[tuple[DocPath, Any]]:
    """Yield the values that are pinned one by one: everything but blocks and lists of more."""
    if _is_block(value) and (value or not path):
        for key, inner in value.items():
            yield from _leaves(inner, (*path, key))
    elif isinstance(value, list) and not all(isinstance(item, str) for item in value):
        for index, inner in enumerate(value):
            yield from _leaves(inner, (*path, index))
    else:
        yield path, value


def _is_block(value: Any) -> bool:
    """Tell a block of fields from a number with its freedom."""
    return isinstance(value, dict) and not set(FreeNumberModel.model_fields) & set(value)


def _counts(op: str, value: Any, path: DocPath) -> Iterator[Pin]:
    """Yield how many items each pinned list has; a vector always has as many."""
    if _is_block(value):
        for key, inner in value.items():
            yield from _counts(op, inner, (*path, key))
    elif isinstance(value, list) and value and not any(isinstance(item, str) for item in value):
        name = format_path(path)
        shape = locate(op, name)[1]
        if isinstance(shape.inner if isinstance(shape, Nullable) else shape, Listing):
            yield Pin(name, value, count=len(value))
        for index, inner in enumerate(value):
            yield from _counts(op, inner, (*path, index))


def _pins(op: str, path: DocPath, value: Any) -> Iterator[Pin]:
    name = format_path(path)
    try:
        shape = locate(op, name)[1]
    except UnknownFieldError as error:
        hint = f"did you mean {error.nearest!r}?" if error.nearest else ""
        raise _WrongPinError(path, f"the field '{name}'", f"an output of {op}", hint) from None
    if value == {}:
        raise _WrongPinError(path, "an empty mapping", "at least one value, or leave it out")
    kind = kind_of(op, name)
    if isinstance(value, dict):
        yield from _free_pins(path, kind, value)
        return
    plain = _plain(path, kind, value)
    try:
        normalise_shape(shape, plain, name)
    except FieldError as error:
        raise _WrongPinError(
            (*path, *parse_path(error.path)[len(path) :]), error.found, error.expected
        ) from None
    yield Pin(name, plain)


def _plain(path: DocPath, kind: Kind, value: Any) -> Any:
    if kind is Kind.STATE and value not in STATE_NAMES:
        raise _WrongPinError(
            path, describe(value), f"one of {quoted(STATE_NAMES)}", nearest(str(value), STATE_NAMES)
        )
    if kind is Kind.MOVER_BITS and isinstance(value, list):
        return _bits(path, value)
    return int(value) if kind is Kind.FLAG and isinstance(value, bool) else value


def _bits(path: DocPath, names: list[str]) -> int:
    for index, name in enumerate(names):
        if name not in MOVER_STATES:
            expected = f"one of {quoted(MOVER_STATES)}"
            raise _WrongPinError((*path, index), describe(name), expected, nearest(name, MOVER_STATES))
    return sum(MOVER_STATES[name] for name in set(names))


def _free_pins(path: DocPath, kind: Kind, value: dict[str, Any]) -> Iterator[Pin]:
    model, faults = validate(FreeNumberModel, value)
    if model is None:
        fault = faults[0]
        raise _WrongPinError((*path, *fault.path), fault.found, fault.expected, fault.hint)
    if kind not in FLOAT_KINDS:
        raise _WrongPinError(path, "a tolerance or bits", f"a {kind.value}")
    name = format_path(path)
    if model.bits is not None:
        yield Pin(name, _float_of(model.bits))
    if model.value is not None:
        freedom = model.tolerance or 0.0, model.unit or "", bool(model.inclusive), model.reason or ""
        yield Pin(name, model.value, Tolerance(*freedom))


def _float_of(bits: int) -> float:
    value: float = struct.unpack("<f", struct.pack("<I", bits))[0]
    return value
