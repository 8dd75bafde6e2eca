"""The counts at the end of a run."""

from __future__ import annotations

from collections import Counter

from conformance.summary import MOST_REASONS, MOST_SKIPS, PROPERTY, Counts, skipped_text


def test_counts_of_reports_add_up() -> None:
    """Cases, queries, random queries and skips, each by reason."""
    counts = Counts()
    assert not counts
    counts.add([("other", 3), (PROPERTY, {"cases": 1, "queries": 9, "skipped": {"engine: b": 2}})])
    counts.add([(PROPERTY, {"cases": 1, "queries": 1, "skipped": {"engine: b": 1, "engine: a": 1}})])
    counts.add([(PROPERTY, {"random": 250, "skipped": {}})])
    assert counts
    (line,) = counts.lines("engine")
    assert line.startswith(
        "conformance: 2 cases, 10 queries compared, 4 skipped (engine: a: 1, engine: b: 3)"
    )
    assert line.endswith(", 250 random queries, candidate engine")


def test_reasons_come_first_and_are_limited() -> None:
    """One line for each failed case, up to a limit that is said."""
    counts = Counts()
    for n in range(MOST_REASONS + 2):
        counts.add([(PROPERTY, {"cases": 1, "failure": f"case-{n}: d differs"})])
    lines = counts.lines("x")
    assert lines[0] == "case-0: d differs"
    assert lines[MOST_REASONS] == "... and 2 more failed cases"
    assert len(lines) == MOST_REASONS + 2


def test_skips_are_named_up_to_a_limit() -> None:
    """The most frequent reasons, in order of their names, and how many others there are."""
    assert skipped_text(Counter()) == "0 skipped"
    all_named = Counter({f"op {n:02}": n + 2 for n in range(MOST_SKIPS)})
    text = skipped_text(all_named)
    assert text.startswith(f"{all_named.total()} skipped (op 00: 2, op 01: 3, ")
    assert text.endswith(f"op {MOST_SKIPS - 1:02}: {MOST_SKIPS + 1})")
    more = all_named + Counter({"aim": 1})
    assert (
        skipped_text(more)
        == text.replace(f"{all_named.total()} ", f"{more.total()} ").removesuffix(")")
        + ", and 1 other reason: 1)"
    )
    assert skipped_text(more + Counter({"bow": 1})).endswith(", and 2 other reasons: 2)")
