"""Comparison, field by field and bit by bit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from conformance.fields import MISSING, field_at, fits, kind_of_shape, locate, normalise_shape, outputs_of
from conformance.floats import is_float32, ulps32, ulps64
from conformance.shapes import FLOAT_KINDS, Block, Kind, Listing, Nullable, Place, Scalar, Vector
from conformance.step_outputs import STEP_OF, TICKS, steps

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from conformance.pins import Pin, Ticks
    from conformance.query import Fields
    from conformance.shapes import Shape

ZeroSigns: TypeAlias = Literal["equal", "distinct"]
"""Whether -0 and 0 are the same value (vector files do not keep the sign) or not (two engines do)."""


@dataclass(frozen=True, slots=True)
class Tolerance:
    """The freedom that a pin grants one field.

    Attributes
    ----------
    value : float
        Largest distance from the pinned value, in `unit`.
    unit : str
        ``ulp`` for float32 steps, otherwise the unit of the field itself (``m``).
    inclusive : bool
        Whether a distance of exactly `value` still passes.
    reason : str
        Why the field is not pinned exactly.
    """

    value: float
    unit: str
    inclusive: bool
    reason: str

    def admits(self, expected: float, actual: float) -> bool:
        """Tell whether `actual` is close enough to `expected`; NaN never is."""
        distance = ulps32(expected, actual) if self.unit == "ulp" else abs(expected - actual)
        if distance is None:
            return False
        return distance <= self.value if self.inclusive else distance < self.value

    def __str__(self) -> str:
        return f"{'<=' if self.inclusive else '<'} {self.value:g} {self.unit} ({self.reason})"


@dataclass(frozen=True, slots=True)
class Difference:
    """One output field on which two answers disagree.

    Attributes
    ----------
    path : str
        The field as written in records, ``contact_plane.plane[3]``.
    name : str
        The field as read by people, ``contact_plane.d``.
    kind : Kind
        What the value is.
    retail, candidate : object
        The expected and the given value; `MISSING` where one side has none.
    note : str
        What the values alone do not show (``the sign of zero``), or nothing.
    tolerance : Tolerance or None
        The freedom that was not enough.
    """

    path: str
    name: str
    kind: Kind
    retail: Any
    candidate: Any
    note: str = ""
    tolerance: Tolerance | None = None

    @property
    def ulps(self) -> int | None:
        """Steps of the field's own float format between the values; None where there is no distance."""
        if self.kind not in FLOAT_KINDS or not (
            fits(self.kind, self.retail) and fits(self.kind, self.candidate)
        ):
            return None
        count = ulps32 if self.kind is Kind.FLOAT32 else ulps64
        return count(self.retail, self.candidate)


def differences(expected: Fields, actual: Fields, *, op: str, zero_signs: ZeroSigns) -> list[Difference]:
    """Compare two answers to a query; every field, exactly.

    Parameters
    ----------
    expected, actual : Fields
        Retail's and the candidate's answer. A NaN equals any NaN.
    op : str
        The operation asked.
    zero_signs : {"equal", "distinct"}
        ``equal`` for vector files, which do not keep the sign of zero; ``distinct`` between engines.

    Returns
    -------
    list of Difference
        In the order of FORMAT.md; of a walk only those of its first diverging step. Empty: equal.

    Raises
    ------
    UnknownOperationError
        For an operation that does not exist.
    """
    comparison = _Comparison(distinct_zeros=zero_signs == "distinct")
    comparison.compare(outputs_of(op), expected, actual, Place())
    return comparison.found


def pin_differences(pins: Iterable[Pin], actual: Fields, *, op: str) -> list[Difference]:
    """Compare an answer with a case's pinned outputs; signs of zero are equal, as people write 0.

    Of a walk, the differences are those of the first tick that misses a pin.

    Raises
    ------
    UnknownOperationError, UnknownFieldError, FieldError
        For a pin that does not fit the operation.
    """
    found: list[Difference] = []
    spans: list[tuple[Pin, Ticks]] = []
    for pin in pins:
        if pin.ticks is None:
            found += _missed(pin, actual, op, Place())
        else:
            spans.append((pin, pin.ticks))
    return found + _missed_steps(spans, actual, op) if spans else found


def _missed(pin: Pin, actual: Fields, op: str, below: Place) -> list[Difference]:
    place, shape = locate(op, pin.path)
    if pin.count is not None:
        given = field_at(actual, op, pin.path)
        if isinstance(given, list | tuple) and len(given) == pin.count:
            return []
        note = f"{pin.count} items, candidate {len(given) if isinstance(given, list | tuple) else 'none'}"
        where = below.below(place)
        return [Difference(where.path, where.name, Kind.BLOCK, pin.value, given, note)]
    comparison = _Comparison(distinct_zeros=False, tolerance=pin.tolerance)
    expected = normalise_shape(shape, pin.value, pin.path)
    comparison.compare(shape, expected, field_at(actual, op, pin.path), below.below(place))
    return comparison.found


def _missed_steps(spans: Sequence[tuple[Pin, Ticks]], actual: Fields, op: str) -> list[Difference]:
    """Return what the first tick that misses a pin misses; a pinned tick that is not there misses all."""
    states = list(steps(op, spans[0][1].start, actual.get("ticks", ())))
    for index in range(1 + max(span.last for _, span in spans)):
        place = Place("ticks", "ticks").item(index, TICKS)
        state = states[index] if index < len(states) else {}
        pins = [pin for pin, span in spans if index in span]
        found = [difference for pin in pins for difference in _missed(pin, state, STEP_OF[op], place)]
        if found:
            return found
    return []


@dataclass(slots=True)
class _Comparison:
    distinct_zeros: bool
    tolerance: Tolerance | None = None
    found: list[Difference] = field(default_factory=list)

    def compare(self, shape: Shape, retail: Any, candidate: Any, place: Place) -> None:
        match shape:
            case Scalar(kind):
                self._scalar(kind, retail, candidate, place)
            case Nullable(inner) if retail is not None and candidate is not None:
                self.compare(inner, retail, candidate, place)
            case Vector() if _lists(retail, candidate) and len(retail) == len(candidate):
                self._vector(shape, retail, candidate, place)
            case Listing() if _lists(retail, candidate):
                self._listing(shape, retail, candidate, place)
            case Block() if isinstance(retail, dict) and isinstance(candidate, dict):
                self._block(shape, retail, candidate, place)
            case _ if retail is not candidate:
                self._report(place, kind_of_shape(shape), retail, candidate)
            case _:
                pass

    def _scalar(self, kind: Kind, retail: Any, candidate: Any, place: Place) -> None:
        if not (fits(kind, retail) and fits(kind, candidate)):
            self._report(place, kind, retail, candidate)
        elif kind in FLOAT_KINDS:
            self._float(kind, retail, candidate, place)
        elif retail != candidate:
            self._report(place, kind, retail, candidate)

    def _float(self, kind: Kind, retail: float, candidate: float, place: Place) -> None:
        if retail == candidate:
            signs_differ = retail == 0.0 and math.copysign(1.0, retail) != math.copysign(1.0, candidate)
            if self.distinct_zeros and signs_differ:
                self._report(place, kind, retail, candidate, "the sign of zero")
        elif not _both_nan(retail, candidate) and not self._tolerated(retail, candidate):
            note = "not a float32" if kind is Kind.FLOAT32 and not is_float32(candidate) else ""
            self._report(place, kind, retail, candidate, note)

    def _tolerated(self, retail: float, candidate: float) -> bool:
        return self.tolerance is not None and self.tolerance.admits(retail, candidate)

    def _vector(self, vector: Vector, retail: list[Any], candidate: list[Any], place: Place) -> None:
        for i, (a, b) in enumerate(zip(retail, candidate, strict=True)):
            if a != b or a == 0.0:  # formatting the place of each equal number would cost most of the time
                self._scalar(Kind.FLOAT32, a, b, place.component(i, vector))

    def _listing(self, listing: Listing, retail: list[Any], candidate: list[Any], place: Place) -> None:
        for i, (a, b) in enumerate(zip(retail, candidate, strict=False)):
            self.compare(listing.item, a, b, place.item(i, listing))
            if listing.step and self.found:
                return
        if len(retail) != len(candidate):
            note = f"{len(retail)} items, candidate {len(candidate)}"
            self._report(place, Kind.BLOCK, retail, candidate, note)

    def _block(self, block: Block, retail: Fields, candidate: Fields, place: Place) -> None:
        for key, shape in block.fields.items():
            a, b = retail.get(key, MISSING), candidate.get(key, MISSING)
            if a is not b:
                self.compare(shape, a, b, place.key(key, block))
        for key in sorted(candidate.keys() - block.fields.keys()):
            where = place.key(key, block)
            self._report(where, Kind.BLOCK, MISSING, candidate[key], "no such output field")

    def _report(self, place: Place, kind: Kind, retail: Any, candidate: Any, note: str = "") -> None:
        self.found.append(Difference(place.path, place.name, kind, retail, candidate, note, self.tolerance))


def _lists(retail: Any, candidate: Any) -> bool:
    return isinstance(retail, list | tuple) and isinstance(candidate, list | tuple)


def _both_nan(a: float, b: float) -> bool:
    return math.isnan(a) and math.isnan(b)
