"""Drafts of deviations from what was seen: everything but the reasons, which only people know."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any, Final

from conformance.deviations.entries import distance_of, error_text, observed_text, printable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from conformance.compare import Difference
    from conformance.verdict import Failure

MOST_ULPS: Final = 64
"""Up to here a bound is drafted in steps of the float format, beyond in the field's own unit."""
MOST_VALUES: Final = 4
"""Most different values of one field that are drafted, each as an entry of its own."""
_HEAD: Final = """\
# A draft: mend the engine, or fill in of each entry the reason, a link to where it is discussed, and the last
# day on which it holds. `conformance lint --deviations FILE` says what is missing.
"""
_DIGITS: Final = 2
"""Significant digits of a drafted bound, rounded up."""


def draft(failures: Mapping[str, Sequence[Failure]], *, engine: str) -> str:
    """Write a deviation file for failures.

    Reason, link and day are left out, so that the file is refused until a person has filled them in.

    Parameters
    ----------
    failures : mapping of str to sequence of Failure
        The candidate's failures by the case's id.
    engine : str
        Whose they are.

    Returns
    -------
    str
        YAML.
    """
    lines = [f"engine: {json.dumps(engine)}"]
    if not failures:
        return "\n".join([*lines, "deviations: []"]) + "\n"
    lines = [_HEAD + lines[0], "deviations:"]
    for case_id, found in failures.items():
        lines += [f"  # {printable(found[0].summary)}"]
        for entry in entries_for(case_id, found):
            lines += ["  - " + "\n    ".join(_yaml_lines(entry))]
    return "\n".join(lines) + "\n"


def entries_for(case_id: str, failures: Sequence[Failure]) -> Iterator[dict[str, Any]]:
    """Yield the entries of one case: one for each field that differs, and each error."""
    for error in dict.fromkeys(error_text(failure.error) for failure in failures if not failure.found):
        yield {"case": case_id, "error": error}
    by_name: dict[str, list[Difference]] = {}
    for failure in failures:
        for difference in failure.found:
            by_name.setdefault(difference.name, []).append(difference)
    for name, found in by_name.items():
        for bound in _bounds(found):
            yield {"case": case_id, "field": name, **bound}


def _bounds(found: Sequence[Difference]) -> Iterable[dict[str, Any]]:
    """Return what holds of a field in every query: its one value, or a bound on its distance."""
    values = list(dict.fromkeys(map(observed_text, found)))
    distances = [distance for d in found if (distance := distance_of(d)) is not None]
    if len(values) == 1 or len(distances) < len(found) or max(distances) == 0:
        return [{"observed": value} for value in values[:MOST_VALUES]]
    ulps = [count for d in found if (count := d.ulps) is not None]
    if max(ulps) <= MOST_ULPS:
        return [{"within_ulps": max(ulps)}]
    return [{"within": _rounded_up(max(distances))}]


def _rounded_up(value: float) -> float:
    """Return the next number of two significant digits that is not below a positive one."""
    scale = 10.0 ** (math.floor(math.log10(value)) - _DIGITS + 1)
    rounded = float(f"{math.ceil(value / scale) * scale:.{_DIGITS - 1}e}")
    return rounded if rounded >= value else float(f"{rounded + scale:.{_DIGITS - 1}e}")


def _yaml_lines(entry: Mapping[str, Any]) -> list[str]:
    """Write one entry; JSON's text and numbers are YAML's."""
    said = [f"{key}: {json.dumps(value, ensure_ascii=False)}" for key, value in entry.items()]
    return [*said, "reason:", "link:", "until:"]
