"""How far an answer is from the exact one: lengths and angles where decisions agree, and which do not."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from conformance.query import Result

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from conformance.query import Fields, Outcome

POSES: Final = ("check", "curr")
"""Where an answer tells where the mover is; walks say `pos`."""
STATE_DECISIONS: Final = ("result", "walkable", "walkable_geometry", "check_cell", "curr_cell")
"""Decisions that an answer with a state block tells, besides the contact plane being there."""
TICK_DECISIONS: Final = ("r", "cell", "cp_cell", "onw")
"""The same in a tick of a walk."""
PATHS: Final = frozenset({"trace", "t"})
"""What tells how an answer was come by; another way to the same answer is no flip."""
LEAST_CONSTANT: Final = 1.0
"""Metres; the steps of a smaller plane constant are counted as those of this one, because it is a
difference of coordinates: near zero its own steps say nothing."""
MEASURES: Final = ("contact_metres", "contact_ulps", "normal_radians", "position_metres", "largest")
"""The errors of a sample that are numbers."""


@dataclass(frozen=True, slots=True)
class ErrorSample:
    """The errors of one answer.

    A length or an angle is None where the answer has none, or where decisions differ: then it would tell how
    far apart two situations are, not how far a number is off.

    Attributes
    ----------
    contact_metres : float or None
        Distance of the contact plane's constant D from the exact one, metres.
    contact_ulps : float or None
        The same in float32 steps at the exact value, at `LEAST_CONSTANT` if that is less; fractions count.
    normal_radians : float or None
        Angle between the contact plane's normals.
    position_metres : float or None
        Distance between the positions, current and check; the larger.
    largest : float or None
        Largest difference of any number that is told, in its own unit.
    flips : tuple of str
        Decisions that differ: ``result``, ``walkable``, ``check_cell``, ``contact_plane`` …; of a walk
        those of the first tick that has any, as ``tick 17: r``.
    other_path : bool
        Whether the decisions agree but the trace does not: another way, so perhaps another place.
    """

    contact_metres: float | None = None
    contact_ulps: float | None = None
    normal_radians: float | None = None
    position_metres: float | None = None
    largest: float | None = None
    flips: tuple[str, ...] = ()
    other_path: bool = False


def errors(outcome: Outcome, exact: Outcome) -> ErrorSample | None:
    """Measure an answer against the exact one.

    Parameters
    ----------
    outcome : Outcome
        What is measured, rounded or not.
    exact : Outcome
        What `ExactCandidate.unrounded` says to the same query.

    Returns
    -------
    ErrorSample or None
        None if one of the two is no answer.
    """
    if not (isinstance(outcome, Result) and isinstance(exact, Result)):
        return None
    return field_errors(outcome.fields, exact.fields)


def field_errors(fields: Fields, exact: Fields) -> ErrorSample:
    """Measure the outputs of a query against the exact ones; see `errors`."""
    if "ticks" in exact:
        return _walk_errors(fields["ticks"], exact["ticks"])
    flips = tuple(_flips(fields, exact))
    return ErrorSample(flips=flips) if flips else _agreeing(fields, exact)


def _walk_errors(ticks: Sequence[Fields], exact: Sequence[Fields]) -> ErrorSample:
    """Measure a walk: the largest of its ticks, as long as all decisions agree."""
    samples: list[ErrorSample] = []
    for index, (told, true) in enumerate(zip(ticks, exact, strict=True)):
        flips = tuple(f"tick {index}: {name}" for name in _flips(told, true))
        if flips:
            return ErrorSample(flips=flips)
        samples.append(_agreeing(told, true))
    return ErrorSample(
        contact_metres=_worst(sample.contact_metres for sample in samples),
        contact_ulps=_worst(sample.contact_ulps for sample in samples),
        normal_radians=_worst(sample.normal_radians for sample in samples),
        position_metres=_worst(sample.position_metres for sample in samples),
        largest=_worst(sample.largest for sample in samples),
        other_path=any(sample.other_path for sample in samples),
    )


def _flips(fields: Fields, exact: Fields) -> list[str]:
    decided, true = _decisions(fields), _decisions(exact)
    return [name for name in {**true, **decided} if decided.get(name) != true.get(name)]


def _decisions(fields: Fields) -> dict[str, object]:
    """Return what an answer decides, by name."""
    if "contact_plane" in fields:
        decided: dict[str, object] = {name: fields.get(name) for name in STATE_DECISIONS}
        return decided | {"contact_plane": _plane(fields) is not None}
    if "r" in fields and ("pos" in fields or "t" in fields or fields["r"] == "skip"):
        return {name: fields.get(name) for name in TICK_DECISIONS}
    return {name: _decision(value) for name, value in fields.items() if name not in PATHS}


def _decision(value: Any) -> object:
    """Return a value as far as it is a decision: of numbers only how many there are."""
    if isinstance(value, float):
        return float
    if isinstance(value, dict):
        return tuple((name, _decision(each)) for name, each in value.items())
    if isinstance(value, list | tuple):
        return tuple(_decision(each) for each in value)
    return value


def _agreeing(fields: Fields, exact: Fields) -> ErrorSample:
    """Measure an answer with the exact one's decisions."""
    told, true = _plane(fields), _plane(exact)
    metres = ulps = angle = None
    if told is not None and true is not None:
        metres = abs(told[3] - true[3])
        ulps = metres / float32_step(max(abs(true[3]), LEAST_CONSTANT))
        angle = angle_between(told[:3], true[:3])
    places = zip(_positions(fields), _positions(exact), strict=True)
    return ErrorSample(
        contact_metres=metres,
        contact_ulps=ulps,
        normal_radians=angle,
        position_metres=_worst(math.dist(a, b) for a, b in places),
        largest=_worst(_differences(fields, exact)),
        other_path=any(fields.get(name) != exact.get(name) for name in PATHS),
    )


def _plane(fields: Fields) -> Sequence[float] | None:
    """Return the contact plane of a state block or a tick: normal and constant."""
    block = fields.get("contact_plane")
    plane: Sequence[float] | None = fields.get("cp") if block is None else block.get("plane")
    return plane


def _positions(fields: Fields) -> list[Sequence[float]]:
    found = [fields[name]["origin"] for name in POSES if name in fields]
    return [*found, fields["pos"]] if "pos" in fields else found


def _differences(a: Any, b: Any) -> list[float]:
    """List the differences of the numbers that both answers have at the same place; NaN is as NaN is."""
    if isinstance(a, float) and isinstance(b, float):
        same = a == b or (math.isnan(a) and math.isnan(b))
        return [0.0 if same else abs(a - b)]
    if isinstance(a, dict) and isinstance(b, dict):
        return [d for name in a.keys() & b.keys() for d in _differences(a[name], b[name])]
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return [d for one, other in zip(a, b, strict=False) for d in _differences(one, other)]
    return []


def float32_step(x: float) -> float:
    """Return the distance from a number's float32 to the next one away from zero."""
    return abs(float(np.spacing(np.float32(x))))


def angle_between(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the angle between two vectors, radians; accurate for small ones too.

    A vector without length has none, NaN, except to itself.
    """
    if not (any(a) and any(b)):
        return math.nan if any(a) or any(b) else 0.0
    cross = float(np.linalg.norm(np.cross(a, b)))
    return math.atan2(cross, float(np.dot(a, b)))


def _worst(values: Iterable[float | None]) -> float | None:
    """Return the largest of what is known; NaN is larger than all."""
    return max((value for value in values if value is not None), key=rank, default=None)


def rank(value: float) -> tuple[bool, float]:
    """Return by what errors are put in order, NaN last: it is as wrong as can be."""
    return (True, 0.0) if math.isnan(value) else (False, value)
