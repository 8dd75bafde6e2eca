"""What an entry of a deviation file says, and which cases and differences it is about."""

from __future__ import annotations

import datetime as dt
import hashlib
import math
import re
from typing import TYPE_CHECKING, Any, Final

from pydantic import Field, field_validator, model_validator

from conformance.fields import fits
from conformance.report.values import format_value
from conformance.schema.mistakes import mistake
from conformance.schema.values import Strictly
from conformance.shapes import FLOAT_KINDS, Kind

if TYPE_CHECKING:
    from conformance.compare import Difference

ANY: Final = "*"
"""In an id any characters; in a field's name a whole number, such as a tick or an index."""
LEAST_WORDS: Final = 2
"""Words of an id that a pattern spells out before its first ``*``."""
_CASE: Final = re.compile(r"[a-z0-9*]+(-[a-z0-9*]+)*")
_LINK: Final = re.compile(r"https?://\S+")
_BOUNDS: Final = ("observed", "within", "within_ulps")
_DIGEST_DIGITS: Final = 8
_SAYS_NOTHING: Final = "(nothing)"
_MESSAGE_NUMBER: Final = re.compile(r"\b(seq\"?:? *\"?)[0-9]+")
"""Which message of a run an error is about; the same case has another number in another run."""


class Deviation(Strictly):
    """One way in which cases are known to fail.

    Attributes
    ----------
    case : str
        Id of the case, or a pattern of ids; each case that it is about must fail so.
    field : str or None
        Name of the field that differs, as reports write it.
    observed : str or None
        The engine's value, as reports write it: with its bits.
    within : float or None
        How far the engine's number may be from retail's, in the field's own unit.
    within_ulps : int or None
        The same in steps of the field's own float format.
    error : str or None
        First line of what the engine fails with, where it gives no answer.
    reason, link : str
        Why it is so, and where that is discussed.
    until : str
        Last day on which it holds, ``YYYY-MM-DD``.
    """

    case: str
    field: str | None = Field(default=None, min_length=1)
    observed: str | None = Field(default=None, min_length=1)
    within: float | None = None
    within_ulps: int | None = None
    error: str | None = Field(default=None, min_length=1)
    reason: str = Field(min_length=1)
    link: str
    until: str

    @field_validator("case")
    @classmethod
    def _case_is_fine(cls, case: str) -> str:
        if not _CASE.fullmatch(case):
            raise mistake(f"the text {case!r}", "the id of a case, or a pattern of ids with '*'")
        if ANY in case and case.partition(ANY)[0].count("-") < LEAST_WORDS:
            expected = f"at least {LEAST_WORDS} words and '-' before the first '*'"
            raise mistake(f"the coarse pattern {case!r}", expected, "such as 'step-up-*'")
        return case

    @field_validator("link")
    @classmethod
    def _link_is_one(cls, link: str) -> str:
        if not _LINK.fullmatch(link):
            raise mistake(f"the text {link!r}", "a link that begins with https:// or http://")
        return link

    @field_validator("until")
    @classmethod
    def _until_is_a_day(cls, until: str) -> str:
        try:
            day = dt.date.fromisoformat(until)
        except ValueError:
            day = None
        if day is None or day.isoformat() != until:
            raise mistake(f"the text {until!r}", "a day, such as '2030-01-31'")
        return until

    @model_validator(mode="after")
    def _says_one_thing(self) -> Deviation:
        bounds = [name for name in _BOUNDS if getattr(self, name) is not None]
        if (self.field is None) == (self.error is None):
            raise mistake("both or neither of 'field' and 'error'", "exactly one of them")
        if self.error is not None and bounds:
            raise mistake(f"'{bounds[0]}' with 'error'", "an error alone", at=(bounds[0],))
        if self.field is not None and len(bounds) != 1:
            raise mistake(f"{len(bounds)} of 'observed', 'within', 'within_ulps'", "exactly one of them")
        for name in ("within", "within_ulps"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise mistake(f"the number {value!r}", "a number above 0", at=(name,))
        return self

    @property
    def is_pattern(self) -> bool:
        """Whether it may be about several cases."""
        return ANY in self.case

    def about(self, case_id: str) -> bool:
        """Tell whether it is about a case."""
        return re.fullmatch(_with_any(self.case, ".*"), case_id) is not None

    def has_expired(self, today: dt.date) -> bool:
        """Tell whether its last day has passed."""
        return today > dt.date.fromisoformat(self.until)

    def covers(self, difference: Difference) -> bool:
        """Tell whether a difference is the recorded one."""
        if self.field is None or re.fullmatch(_with_any(self.field, "[0-9]+"), difference.name) is None:
            return False
        if self.observed is not None:
            return observed_text(difference) == self.observed
        if self.within_ulps is not None:
            return difference.ulps is not None and difference.ulps <= self.within_ulps
        distance = distance_of(difference)
        return self.within is not None and distance is not None and distance <= self.within

    def covers_error(self, error: str) -> bool:
        """Tell whether an error is the recorded one; only its first line counts, and no message's number."""
        return self.error is not None and error_text(self.error) == error_text(error)

    @property
    def words(self) -> str:
        """What it says, in one line."""
        if self.error is not None:
            return f"{self.case}: fails with {self.error!r}"
        if self.observed is not None:
            return f"{self.case}: {self.field} is {self.observed}"
        bound = f"{self.within_ulps} ULPs" if self.within is None else f"{self.within:g}"
        return f"{self.case}: {self.field} within {bound} of retail"


class DeviationFile(Strictly):
    """A deviation file: the engine's name, and its entries."""

    engine: str = Field(min_length=1)
    deviations: list[Deviation]


def observed_text(difference: Difference) -> str:
    """Return a given value as an entry records it: as reports do, and a long one with its digest."""
    shown = printable(format_value(difference.kind, difference.candidate))
    if difference.kind is not Kind.BLOCK:
        return shown
    whole = repr(_plain(difference.candidate)).encode("utf-8")
    return f"{shown} (sha256 {hashlib.sha256(whole).hexdigest()[:_DIGEST_DIGITS]})"


def distance_of(difference: Difference) -> float | None:
    """Return how far two numbers are from each other, in their own unit; None where there is no distance."""
    values = (difference.retail, difference.candidate)
    if difference.kind not in FLOAT_KINDS or not all(fits(difference.kind, value) for value in values):
        return None
    distance = abs(difference.retail - difference.candidate)
    return distance if math.isfinite(distance) else None


def first_line(text: str) -> str:
    """Return the first line of a text: what follows in an error is context, such as a log."""
    return text.partition("\n")[0].strip()


def error_text(error: str) -> str:
    """Return an error as an entry records it: its first line, the same for the same fault of any run.

    An engine may say nothing at all, which is recorded as well.
    """
    return printable(_MESSAGE_NUMBER.sub(r"\1N", first_line(error.lstrip()))) or _SAYS_NOTHING


def printable(text: str) -> str:
    """Return a text without control characters, which YAML has no room for."""
    return "".join(char if char.isprintable() else "?" for char in text)


def _plain(value: Any) -> Any:
    """Return a block as lists, whatever kind of sequence a candidate has given."""
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, dict):
        return {key: _plain(value[key]) for key in sorted(value)}
    return value


def _with_any(text: str, stands_for: str) -> str:
    return stands_for.join(re.escape(part) for part in text.split(ANY))
