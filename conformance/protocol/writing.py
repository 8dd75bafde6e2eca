"""Writing inputs as JSON, in one pass: JSON's own writer would print all seventeen digits of their floats.

Writing is most of what asking an engine costs: how a value is written is found by one look-up of its type,
and keys and numbers that have been written before are remembered.
"""

from __future__ import annotations

import functools
from collections import OrderedDict
from json.encoder import encode_basestring
from types import NoneType
from typing import TYPE_CHECKING, Any, Final

from conformance.inputs import is_float64_input
from conformance.protocol.messages import json_text
from conformance.protocol.spellings import SINGLES, ZEROS, spell_double, text_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import TypeAlias

    from conformance.protocol.dialects import Dialect

    Write: TypeAlias = Callable[[Any], str]

_MOST_KEYS: Final = 1 << 12
"""Keys whose texts are remembered; FORMAT.md has some hundred."""
_SHARED: Final = frozenset({"heights", "mover", "path", "polygon", "ticks"})
"""Keys of large blocks and lists that the poses of a case have in common: a third of what is written."""
_MOST_SHARED: Final = 1 << 6
"""Texts of those that are remembered: those of a case, not those of all cases."""


def inputs_text(value: Any, dialect: Dialect) -> str:
    """Write inputs, or a shared record, as JSON without a blank in it.

    Parameters
    ----------
    value : Any
        Inputs of an operation as `conformance.query` has them: floats are Python floats.
    dialect : {"decimal", "hex"}
        How floats are written; clock times are float64, all others float32.

    Raises
    ------
    RecursionError
        If it is nested too deeply for JSON.
    """
    return _writers(dialect)[value.__class__](value)


class _Writers(dict[type, "Write"]):
    """How values of each type are written: by JSON's own writer, if nothing else is said."""

    def __missing__(self, kind: type) -> Write:
        return json_text


class _Heads(dict[str, "tuple[str, _Writers]"]):
    """What stands before the value of a key, and how the value is written."""

    def __init__(self, singles: _Writers, doubles: _Writers, shared: _Writers) -> None:
        super().__init__()
        self._writers = singles, doubles
        self._shared = shared

    def __missing__(self, key: str) -> tuple[str, _Writers]:
        if len(self) >= _MOST_KEYS:
            self.clear()
        writers = self._shared if key in _SHARED else self._writers[is_float64_input(key)]
        head = self[key] = f"{encode_basestring(key)}:", writers
        return head


@functools.cache
def _writers(dialect: Dialect) -> _Writers:
    """Return the writers of values whose floats are float32."""
    plain: dict[type, Write] = {
        int: int.__repr__,
        str: encode_basestring,
        bool: lambda value: "true" if value else "false",
        NoneType: lambda _value: "null",
    }
    singles, doubles, shared = _Writers(plain), _Writers(plain), _Writers(plain)
    blocks = _block_writer(_Heads(singles, doubles, shared))
    singles |= {dict: blocks, float: _single_writer(dialect)}
    doubles |= {dict: blocks, float: lambda value: text_of(spell_double(value, dialect))}
    singles[list] = singles[tuple] = _list_writer(singles, _singles_writer(dialect))
    doubles[list] = doubles[tuple] = _list_writer(doubles, functools.partial(map, doubles[float]))
    shared |= singles
    shared |= {kind: _remembered(singles[kind]) for kind in (dict, list, tuple)}
    return singles


def _remembered(write: Write) -> Write:
    """Return a writer that knows a value again by its identity: inputs do not change.

    What is remembered is held with its text, so that nothing else can have its identity.
    """
    known: OrderedDict[int, tuple[Any, str]] = OrderedDict()

    def write_once(value: Any) -> str:
        if id(value) not in known:
            known[id(value)] = value, write(value)
            if len(known) > _MOST_SHARED:
                known.popitem(last=False)
        return known[id(value)][1]

    return write_once


def _block_writer(heads: _Heads) -> Write:
    def write(block: dict[str, Any]) -> str:
        parts = []
        for key, item in block.items():
            head, writers = heads[key]
            parts.append(head + writers[item.__class__](item))
        return f"{{{','.join(parts)}}}"

    return write


def _list_writer(writers: _Writers, write_floats: Callable[[list[float]], Iterable[str]]) -> Write:
    def write(items: list[Any]) -> str:
        kinds = set(map(type, items))
        # Most are vectors, indices or records: one look-up does for all of their items.
        if len(kinds) > 1:
            return f"[{','.join([writers[item.__class__](item) for item in items])}]"
        if float in kinds:
            return f"[{','.join(write_floats(items))}]"
        return f"[{','.join(map(writers[kinds.pop()], items))}]" if kinds else "[]"

    return write


def _single_writer(dialect: Dialect) -> Write:
    texts, zeros = SINGLES[dialect], ZEROS[dialect]
    return lambda value: texts[value] if value else zeros[repr(value)]


def _singles_writer(dialect: Dialect) -> Callable[[list[float]], Iterable[str]]:
    text, zeros = SINGLES[dialect].__getitem__, ZEROS[dialect]

    def write(values: list[float]) -> Iterable[str]:
        # Zeros are equal and yet two: they have to be looked at.
        if 0.0 in values:
            return [text(value) if value else zeros[repr(value)] for value in values]
        return map(text, values)

    return write
