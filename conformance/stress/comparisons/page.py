"""The list of comparisons as a page of the documentation: `docs/numerics-comparisons.md`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.stress.comparisons import COMPARISONS
from conformance.stress.comparisons.ledger import Kind, Reason, entries
from conformance.stress.comparisons.sites import DOCUMENTS, compared

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.stress.comparisons.ledger import Entry
    from conformance.stress.comparisons.sites import Site

_HEAD: Final = """\
# Every comparison of documents 02 to 05

Every place where the functions of these documents compare two numbers, as the oracle's source has it, with
the square of `conformance stress --family thresholds` that asks on both of its sides, float32 by float32
([numerics.md](numerics.md#thresholds)). A test reads the source and fails if a comparison is missing here;
another asks each square at 0, 1, 2 and 8 steps from its turn, and fails unless the comparison that it is
listed for turns there.

Where no square is drawn, there is a reason:

"""
_TAIL: Final = """
Written by `conformance stress --comparisons docs/numerics-comparisons.md`.
"""


def page() -> str:
    """Return the page."""
    listed = list(entries())
    squares = sum(isinstance(entry, str) for _, entry in listed)
    counts = f"{len(listed)} comparisons: {squares} with a square, {len(listed) - squares} with a reason."
    return "\n".join([_HEAD + "\n".join(_kinds()), "", counts, *_tables(listed), *_others(), _TAIL])


def _kinds() -> Iterator[str]:
    told = {
        Kind.WHOLE: "ids, indices and counters: between two values there is nothing to step through",
        Kind.BITS: "a number is asked whether it is a certain one, and nothing is rounded on the way",
        Kind.ALIKE: "what follows is continuous where the comparison turns: no answer tells its sides apart",
        Kind.BEFORE: "an earlier comparison leaves one side alone, or nothing near the turn",
        Kind.ELSEWHERE: "ticks or picking ask, and not the operations that exact arithmetic answers",
    }
    for kind in Kind:
        yield f"- **{kind.value}**: {told[kind]};"


def _tables(listed: list[tuple[Site, Entry]]) -> Iterator[str]:
    for document in DOCUMENTS:
        yield from (
            "",
            f"## Document {document}",
            "",
            "| where | comparison | square, or reason |",
            "|---|---|---|",
        )
        for site, entry in listed:
            if compared()[site].document == document:
                yield f"| `{site.module}.{site.function}` | `{site.text}` | {_told(entry)} |"


def _told(entry: Entry) -> str:
    return f"**{entry.kind.value}**: {entry.text}" if isinstance(entry, Reason) else entry


def _others() -> Iterator[str]:
    """Yield the squares that ask about what is listed once more, or about functions of other documents."""
    listed = {entry for _, entry in entries()}
    yield from ("", "## Other squares", "")
    yield "The same comparisons through other functions, and some of documents 01 and 07:"
    yield ""
    yield from (f"- {one.name} ({one.retail})" for one in COMPARISONS if one.name not in listed)
