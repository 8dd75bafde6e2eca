"""What a mutant is: one small change of one function of the oracle."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

Key: TypeAlias = tuple[str, str, str, str, int]
"""Function, operator, what is written, what is written instead, and which of several such places."""


class Operator(Enum):
    """What kind of mistake a mutant is; the value says it in a few words."""

    COMPARISON = "a limit counts, or does not: < and <=, > and >=, == and !="
    CONDITION = "a condition is negated"
    CONNECTIVE = "and becomes or, or becomes and"
    ROUNDING = "f32() is left out: a store does not round"
    ASSOCIATION = "a sum is added in another order"
    SIGN = "a sign is left out, or a sum becomes a difference"
    OPERANDS = "the operands of a difference or quotient change places"
    CONSTANT = "a float constant is one ULP off (zero becomes one), a whole one is one off"
    STATE = "another state, type or flag bit of the same kind"
    CHILDREN = "the positive and the negative child change places"
    ARGUMENTS = "neighbouring arguments of the same type change places"
    WRITE = "a write, a call for its effect, or a jump out of a loop is left out"

    @property
    def label(self) -> str:
        """What tables and the list of equivalents call it."""
        return self.name.lower()


@dataclass(frozen=True, slots=True)
class Mutant:
    """One change.

    Attributes
    ----------
    file : str
        Module of the oracle, ``polygon.py``.
    function : str
        Qualified name within the module, ``Polygon.make_plane``.
    document : str
        Two digits of the document that the function is ported from.
    operator : Operator
        The kind of mistake.
    before, after : str
        The expression or statement as it is written, and what stands there instead.
    nth : int
        Which of the function's places with the same change it is, from 1.
    line : int
        Where it is written.
    statement : str
        The statement that it is part of; of a compound one the head.
    reach : range
        Lines of that: who runs none of them cannot notice.
    """

    file: str
    function: str
    document: str
    operator: Operator
    before: str
    after: str
    nth: int
    line: int
    statement: str
    reach: range

    @property
    def site(self) -> str:
        """Module and function, as the tables of the oracle's coverage call it."""
        return f"{self.file.removesuffix('.py')}.{self.function}"

    @property
    def key(self) -> Key:
        """What tells it from all others, whatever line it is in."""
        return self.site, self.operator.label, self.before, self.after, self.nth

    def __str__(self) -> str:
        repeated = f" (#{self.nth})" if self.nth > 1 else ""
        what = f"{self.before!r} becomes {self.after!r}{repeated}"
        return f"{self.file}:{self.line} {self.function}, {self.operator.label}: {what}"
