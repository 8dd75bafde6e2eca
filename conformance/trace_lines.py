"""One line of a trace of writes, as any engine may log it.

``[cp-write] ContactPlane: n=(0,0,1) D=-94.020 -> n=(0,0,1) D=-0.000 caller=step_sphere_down``, and at
the end, if the engine tells it, the mover's lowest point: ``foot=(100.0,50.0,94.0)``.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Final, TypeAlias

from oracle.writes import TOPICS

Triple: TypeAlias = tuple[float, float, float]

LONGEST_LINE: Final = 4096
"""Characters; a longer line is no trace line."""

_NUMBER: Final = r"[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[iI]nf(?:inity)?|[nN]a[nN])"
_TRIPLE: Final = rf"\({_NUMBER}, ?{_NUMBER}, ?{_NUMBER}\)"
_NORMAL: Final = rf"n={_TRIPLE}"
_PLANE: Final = rf"(?:{_NORMAL} D={_NUMBER}|none)"
_COUNT: Final = r"\d+"
_HEX: Final = r"0x[0-9A-Fa-f]+"
_CELL: Final = rf"(?:{_HEX}|none)"

_VALUES: Final = {
    "ContactPlane": _PLANE,
    "ContactPlaneValid": _COUNT,
    "ContactPlaneCellId": _HEX,
    "ContactPlaneIsWater": _COUNT,
    "LastKnownContactPlane": _PLANE,
    "LastKnownContactPlaneValid": _COUNT,
    "LastKnownContactPlaneCellId": _HEX,
    "LastKnownContactPlaneIsWater": _COUNT,
    "Walkable": r"(?:polygon \d+|none)",
    "SlidingNormal": rf"(?:{_NORMAL}|none)",
    "SlidingNormalValid": _COUNT,
    "State": _HEX,
    "CurrCell": _CELL,
    "Call": r"\w+",
}
"""How the values of each field are written."""
_PLANE_LABELS: Final = frozenset({"ContactPlane", "LastKnownContactPlane"})

_TAG: Final = re.compile(rf"\[({'|'.join(TOPICS)})\]")
_LABEL: Final = re.compile(r" (\w+): ")
_ARROW: Final = re.compile(" -> ")
_CALLER: Final = re.compile(r" caller=(\S+)")
_FOOT: Final = re.compile(rf" foot=({_TRIPLE})")
_END: Final = re.compile(r"\s*$")
_FLOAT: Final = re.compile(_NUMBER)
_VALUE_PATTERNS: Final = {label: re.compile(pattern) for label, pattern in _VALUES.items()}


class TraceLineError(ValueError):
    """A line that begins as a trace line and is none.

    Attributes
    ----------
    column : int
        Where it stops being one, from 1.
    expected : str
        What should be there.
    """

    def __init__(self, column: int, expected: str) -> None:
        self.column = column
        self.expected = expected
        super().__init__(f"column {column}: expected {expected}")


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane as logged: unit normal, and constant in metres."""

    normal: Triple
    d: float

    @property
    def is_finite(self) -> bool:
        """Tell whether all four numbers are numbers."""
        return all(map(math.isfinite, (*self.normal, self.d)))


@dataclass(frozen=True, slots=True)
class LoggedWrite:
    """One write of a log.

    Attributes
    ----------
    topic, label, caller : str
        The tag, the field and the function that wrote it.
    before, after : str
        The values as logged.
    foot : tuple of float or None
        The mover's lowest point in the plane's coordinates, metres, if the log tells it.
    """

    topic: str
    label: str
    before: str
    after: str
    caller: str
    foot: Triple | None

    @property
    def is_plane(self) -> bool:
        """Tell whether the field is a plane."""
        return self.label in _PLANE_LABELS


def parse_line(line: str) -> LoggedWrite | None:
    """Read a line; None if it does not begin with the tag of a topic.

    Raises
    ------
    TraceLineError
        It does, but does not go on as a trace line.
    """
    tag = _TAG.match(line)
    if tag is None:
        return None
    if len(line) > LONGEST_LINE:
        raise TraceLineError(LONGEST_LINE + 1, f"a line of at most {LONGEST_LINE} characters")
    name = _next(_LABEL, line, tag.end(), "' FIELD: '")
    label = name[1]
    if label not in _VALUE_PATTERNS:
        nearest = get_close_matches(label, _VALUE_PATTERNS, n=1)
        hint = f" (did you mean {nearest[0]!r}?)" if nearest else ""
        raise TraceLineError(name.start(1) + 1, f"the name of a field{hint}")
    before = _next(_VALUE_PATTERNS[label], line, name.end(), f"a value of {label}")
    arrow = _next(_ARROW, line, before.end(), "' -> '")
    after = _next(_VALUE_PATTERNS[label], line, arrow.end(), f"a value of {label}")
    caller = _next(_CALLER, line, after.end(), "' caller=FUNCTION'")
    foot = _FOOT.match(line, caller.end())
    _next(_END, line, (foot or caller).end(), "the end of the line, or ' foot=(x,y,z)'")
    where = None if foot is None else _triple(foot[1])
    return LoggedWrite(tag[1], label, before[0], after[0], caller[1], where)


def parse_plane(text: str) -> Plane | None:
    """Return the plane that a value of a plane field is; None for ``none`` and a normal of zero."""
    numbers = [float(number) for number in _FLOAT.findall(text)]
    if not any(numbers[:3]):
        return None
    x, y, z, d = numbers
    return Plane((x, y, z), d)


def _next(pattern: re.Pattern[str], line: str, start: int, expected: str) -> re.Match[str]:
    match = pattern.match(line, start)
    if match is None:
        raise TraceLineError(start + 1, expected)
    return match


def _triple(text: str) -> Triple:
    x, y, z = (float(number) for number in _FLOAT.findall(text))
    return x, y, z
