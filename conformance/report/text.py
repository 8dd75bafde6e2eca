"""Failures as text: the differing fields side by side, the scene, the command that reruns it."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from conformance.report.scene import scene_line
from conformance.report.values import format_ulps, format_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from conformance.compare import Difference
    from conformance.query import Query
    from conformance.shapes import Kind

__all__ = ["quoted_spec", "render_differences", "render_failure", "scene_line", "summary_line"]


def summary_line(difference: Difference, candidate: str, *, retail: str = "retail") -> str:
    """Say one difference in one line.

    For example ``contact_plane.d: retail -94.0 (0xC2BC0000), bug:cell-origin 0.0 (0x00000000), 1.1e9 ULPs``.
    """
    expected = format_value(difference.kind, difference.retail)
    given = format_value(difference.kind, difference.candidate)
    values = f"{difference.name}: {retail} {expected}, {candidate} {given}"
    return ", ".join([values, *_remarks(difference)])


def quoted_spec(spec: str) -> str:
    """Return a candidate's name as one argument of a command, in the shells of every platform."""
    if not any(character in spec for character in " '\"\\;&|<>$*?()"):
        return spec
    return '"{}"'.format(spec.replace('"', '\\"'))


def render_failure(
    *,
    case: str,
    title: str,
    differences: Sequence[Difference],
    candidate: str,
    query: Query,
    rerun: str,
    retail: str = "retail",
    limit: int = 20,
    around: Sequence[str] = (),
) -> str:
    """Explain why a candidate failed a query, in several lines without colour.

    Parameters
    ----------
    case, title : str
        What failed: the id (with its variant) and a sentence.
    differences : sequence of Difference
        The fields that differ; the others are not shown.
    candidate, retail : str
        What the two columns of values are called.
    query : Query
        What was asked.
    rerun : str
        The command that repeats only this.
    limit : int
        How many differences of one kind are shown; of the others only the number.
    around : sequence of str
        Lines that show what led to the difference, such as the ticks before it.
    """
    lines = [f"{case}: {title}" if title else case, ""]
    lines += render_differences(differences, candidate, retail=retail, limit=limit)
    lines += ["", *around] if around else []
    lines += ["", f"  scene: {scene_line(query)}", f"  rerun: {rerun}"]
    return "\n".join(lines)


def render_differences(
    differences: Sequence[Difference], candidate: str, *, retail: str = "retail", limit: int = 20
) -> list[str]:
    """Write the differing fields as an aligned table, at most `limit` of one kind."""
    shown, left_out = _first_of_each_kind(differences, limit)
    rows = [("field", retail, candidate, "distance")]
    rows += [
        (d.name, format_value(d.kind, d.retail), format_value(d.kind, d.candidate), ", ".join(_remarks(d)))
        for d in shown
    ]
    lines = _aligned(rows)
    lines += [f"  ... and {count} more of kind {kind.value}" for kind, count in left_out.items()]
    return lines


def _first_of_each_kind(
    differences: Sequence[Difference], limit: int
) -> tuple[list[Difference], Counter[Kind]]:
    seen: Counter[Kind] = Counter()
    left_out: Counter[Kind] = Counter()
    shown = []
    for difference in differences:
        seen[difference.kind] += 1
        if seen[difference.kind] <= limit:
            shown.append(difference)
        else:
            left_out[difference.kind] += 1
    return shown, left_out


def _remarks(difference: Difference) -> Iterable[str]:
    allowed = f"allowed {difference.tolerance}" if difference.tolerance else ""
    return [text for text in (format_ulps(difference), difference.note, allowed) if text]


def _aligned(rows: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return [
        ("  " + "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True))).rstrip()
        for row in rows
    ]
