"""The table of errors against the exact model, for a terminal and for a machine."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rich.table import Table

from conformance.exact.errors import MEASURES

if TYPE_CHECKING:
    from conformance.exact.summary import ErrorSummary, Spread
    from conformance.exact.survey import Survey

HEADINGS: Final = {
    "contact_metres": "contact D (m)",
    "contact_ulps": "contact D (ULP)",
    "normal_radians": "normal (rad)",
    "position_metres": "position (m)",
    "largest": "any number",
}
"""What each measure is called."""


def error_table(survey: Survey) -> Table:
    """Make the table: a line for each model, median / 99th percentile / largest of each measure."""
    table = Table(caption="median / 99th percentile / largest, of queries whose decisions are exact's")
    for heading in ("model", "flips", "other path", *HEADINGS.values(), "ms"):
        table.add_column(heading, overflow="fold")
    for name, summary in survey.summaries.items():
        spreads = [_spread(summary.spread(measure)) for measure in HEADINGS]
        table.add_row(name, *_counts(summary), *spreads, _milliseconds(survey, name))
    table.add_row(survey.exact.name, *[""] * (2 + len(HEADINGS)), _milliseconds(survey, survey.exact.name))
    return table


def survey_lines(survey: Survey) -> list[str]:
    """Say what the exact model decided, what it did not, and which decisions the others took otherwise."""
    bits = ", ".join(f"{count} at {bits} bits" for bits, count in sorted(survey.precisions.items()))
    lines = [
        f"{survey.asked} queries ({bits}); {survey.tied} with ties; {len(survey.undecided)} undecided",
        *(f"not answered by exact: {reason} ({count})" for reason, count in survey.unanswered.items()),
    ]
    for name, summary in survey.summaries.items():
        if summary.flips:
            what = ", ".join(f"{decision} {count}" for decision, count in summary.flips.most_common())
            lines.append(f"{name} decides otherwise: {what}")
    return lines


def as_json(survey: Survey) -> dict[str, Any]:
    """Return the survey for a machine to read."""
    return {
        "asked": survey.asked,
        "tied": survey.tied,
        "undecided": [query.label for query in survey.undecided],
        "unanswered": dict(survey.unanswered),
        "precisions": {str(bits): count for bits, count in sorted(survey.precisions.items())},
        "seconds": survey.seconds,
        "models": {name: _model_json(summary) for name, summary in survey.summaries.items()},
    }


def _model_json(summary: ErrorSummary) -> dict[str, Any]:
    spreads = {measure: summary.spread(measure) for measure in MEASURES}
    return {
        "samples": summary.samples,
        "flipped": summary.flipped,
        "flips": dict(summary.flips),
        "other_paths": summary.other_paths,
        "measures": {measure: _spread_json(spread) for measure, spread in spreads.items() if spread},
    }


def _spread_json(spread: Spread) -> dict[str, Any]:
    return {
        "count": spread.count,
        "median": spread.median,
        "p99": spread.p99,
        "largest": spread.largest,
        "worst": spread.worst.label,
    }


def _counts(summary: ErrorSummary) -> tuple[str, str]:
    share = f" ({summary.flip_rate:.2%})" if summary.samples else ""
    return f"{summary.flipped}/{summary.samples}{share}", str(summary.other_paths)


def _spread(spread: Spread | None) -> str:
    return "-" if spread is None else f"{spread.median:.2g} / {spread.p99:.2g} / {spread.largest:.2g}"


def _milliseconds(survey: Survey, name: str) -> str:
    return f"{1000.0 * survey.seconds[name] / survey.asked:.3g}" if survey.asked else "-"
