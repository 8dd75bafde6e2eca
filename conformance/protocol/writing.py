"""Writing inputs as JSON, in one pass: JSON's own writer would print all seventeen digits of their floats."""

from __future__ import annotations

import functools
from json.encoder import encode_basestring
from typing import TYPE_CHECKING, Any, Final

from conformance.inputs import is_float64_input
from conformance.protocol.messages import json_text
from conformance.protocol.spellings import SINGLES, spell_double, text_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.protocol.dialects import Dialect

_FLOATS: Final = {float}
_WHOLES: Final = {int}
_MOST_KEYS: Final = 1 << 12
"""Keys whose texts are remembered; FORMAT.md has some hundred."""


class _Keys(dict[str, str]):
    """Keys as they stand before their values, written where they are first asked for."""

    def __missing__(self, key: str) -> str:
        if len(self) >= _MOST_KEYS:
            self.clear()
        text = self[key] = f"{encode_basestring(key)}:"
        return text


_KEYS: Final = _Keys()


def inputs_text(value: Any, dialect: Dialect, key: str = "") -> str:
    """Write inputs, or a shared record, as JSON without a blank in it.

    Parameters
    ----------
    value : Any
        Inputs of an operation as `conformance.query` has them: floats are Python floats.
    dialect : {"decimal", "hex"}
        How floats are written; clock times are float64, all others float32.
    key : str
        The key that `value` stands under.

    Raises
    ------
    RecursionError
        If it is nested too deeply for JSON.
    """
    return _writer(dialect)(value, key)


@functools.cache
def _writer(dialect: Dialect) -> Callable[[Any, str], str]:
    single, keys = SINGLES[dialect].__getitem__, _KEYS

    def write(value: Any, key: str) -> str:
        kind = value.__class__
        if kind is dict:
            parts = [keys[inner] + write(item, inner) for inner, item in value.items()]
            return f"{{{','.join(parts)}}}"
        if kind is list or kind is tuple:
            return f"[{','.join(write_items(value, key))}]"
        if kind is int:
            return str(value)
        if kind is float:
            return text_of(spell_double(value, dialect)) if is_float64_input(key) else single(value)
        return json_text(value)

    def write_items(values: list[Any], key: str) -> list[str]:
        # Most are vectors and indices: their items are not worth a call each.
        kinds = set(map(type, values))
        if kinds == _WHOLES:
            return list(map(str, values))
        if kinds == _FLOATS and not is_float64_input(key):
            return list(map(single, values))
        return [write(item, key) for item in values]

    return write
