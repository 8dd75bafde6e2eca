"""Readers of parsed JSON or YAML: values at a path, checked for their type.

Each raises `SceneError` with the path when the value is of another type.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

from conformance.floats import to_float32
from conformance.scenes.errors import SceneError, join_path

if TYPE_CHECKING:
    from collections.abc import Callable

Reader: TypeAlias = "Callable[[Any, str], Any]"
"""Turns a value at a path into checked data."""


def each(record: Any, key: str, path: str, read: Reader) -> list[Any]:
    """Read every item of a list in a record."""
    values, here = member(record, key, path), join_path(path, key)
    return [read(value, f"{here}[{i}]") for i, value in enumerate(sequence(values, here))]


def member(record: Any, key: str, path: str) -> Any:
    """Return what a record has under a key."""
    if key not in mapping(record, path):
        raise SceneError(path, f"no {key!r}", f"the key {key!r}")
    return record[key]


def mapping(value: Any, path: str) -> Mapping[str, Any]:
    """Return a value that must be a mapping."""
    if not isinstance(value, Mapping):
        raise SceneError(path, _kind(value), "a mapping")
    return value


def sequence(value: Any, path: str) -> Sequence[Any]:
    """Return a value that must be a list."""
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise SceneError(path, _kind(value), "a list")
    return value


def whole(value: Any, path: str) -> int:
    """Return a value that must be a whole number (or true or false)."""
    if not isinstance(value, int):
        raise SceneError(path, _kind(value), "a whole number")
    return int(value)


def text(value: Any, path: str) -> str:
    """Return a value that must be a text."""
    if not isinstance(value, str):
        raise SceneError(path, _kind(value), "a text")
    return value


def floats_of(count: int) -> Reader:
    """Return a reader of `count` numbers, which rounds them to float32."""

    def read(value: Any, path: str) -> tuple[float, ...]:
        numbers = sequence(value, path)
        if len(numbers) != count:
            raise SceneError(path, f"{len(numbers)} numbers", f"{count} numbers")
        for i, number in enumerate(numbers):
            if isinstance(number, bool) or not isinstance(number, int | float):
                raise SceneError(f"{path}[{i}]", _kind(number), "a number")
        return tuple(to_float32(number) for number in numbers)

    return read


def _kind(value: Any) -> str:
    """Name what was found: its type, and the value if it is short."""
    shown = repr(value)
    return f"{type(value).__name__} {shown}" if len(shown) <= 40 else type(value).__name__
