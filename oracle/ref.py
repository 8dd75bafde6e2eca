"""A memory cell that a function writes through, for retail's pointer arguments."""

from __future__ import annotations

from typing import Generic, TypeVar

T = TypeVar("T")


class Ref(Generic[T]):
    """One mutable value.

    Used where retail leaves an output parameter as it was unless something happens: the caller sees
    the old value, which some functions rely on (``struck_poly``, 02 PS-2; ``hit_poly``, 03 SQ-4).
    """

    __slots__ = ("value",)

    def __init__(self, value: T) -> None:
        self.value = value

    def __repr__(self) -> str:
        return f"Ref({self.value!r})"
