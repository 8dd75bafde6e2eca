"""What the cases reach of the oracle, for a terminal and as a page of the documents."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Final

from rich.table import Table

from conformance.branches.reasons import NEVER_CALLED, Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from conformance.branches.measure import Measurement, Reach, Site
    from conformance.branches.reasons import Gap

_SHARED: Final = "none: shared"
"""Stands for the document of what no document specifies by itself."""
_WHOLE: Final = "all"
_ALL_FILES: Final = "all files"
_HEADINGS: Final = ("document", "file", "branches", "reached", "of all", "out of reach", "of those in reach")
_RIGHT: Final = frozenset(_HEADINGS[2:])
_FULL: Final = "100 %"
_NO_REASON: Final = "**no reason recorded**"

_PAGE: Final = """\
# What the cases reach of the oracle

The oracle is the port of retail that every engine is compared with. A branch of it that no case takes is a
rule of retail that no case shows, so this page counts them. `conformance coverage` measures it with
coverage.py: every built-in case is asked as it is written and in its random poses. The queries that
Hypothesis draws are left out, because what they reach depends on its version; `conformance coverage
--draws 500` adds them and prints what is reached then.

A branch is one way that an `if`, `while` or `for` of the oracle can go. The parts of a condition (`a or b`)
and conditional expressions are not counted apart. Left out are the modules without anything of retail,
{instruments},
which have tests of their own, and methods that show a value to people who debug.

Out of reach are three kinds of branches, all listed below with the reason: functions of retail that no
operation calls, branches that no valid input leads to, and guards of the port that raise an error where
retail would read what is not there. The oracle's own tests (`tests/oracle`) call those that can be called.

Regenerate this page with `conformance coverage --output docs/oracle-coverage.md`.

## Branches by document and file

"""
_GAPS_HEADING: Final = """
## What is not reached, and why

Each entry is kept in `conformance/branches/known_gaps.py`, under its function and the text of its condition.
An entry about a branch that is reached, or that is not there, is an error, and so is a branch without one.

"""


def share(taken: int, total: int) -> str:
    """Write a part of a whole in percent, rounded down: only the whole is 100 %."""
    return _FULL if taken == total else f"{taken * 1000 // total / 10:.1f} %"


def rows(reached: Mapping[Site, Reach], gaps: Iterable[Gap]) -> Iterator[tuple[str, ...]]:
    """Yield the table's rows: of each document its sum and its files, last the sum of all.

    Out of reach are the branches with a reason, whatever kind of reason it is.
    """
    sums: defaultdict[tuple[str, str], list[int]] = defaultdict(lambda: [0, 0, 0])
    for site, reach in reached.items():
        for key in _keys(site, reach):
            sums[key][0] += len(reach.taken)
            sums[key][1] += reach.total
    for gap in gaps:
        for key in _keys(gap.site, reached[gap.site]):
            sums[key][2] += gap.branches if gap.reason else 0
    for (document, file), (taken, total, beyond) in sorted(sums.items(), key=_all_last):
        if total:
            shares = share(taken, total), str(beyond), share(taken, total - beyond)
            yield document, file or _ALL_FILES, str(total), str(taken), *shares


def _keys(site: Site, reach: Reach) -> tuple[tuple[str, str], ...]:
    document = reach.function.document or _SHARED
    return (document, site.file), (document, ""), (_WHOLE, "")


def coverage_table(reached: Mapping[Site, Reach], gaps: Iterable[Gap]) -> Table:
    """Make the table that a terminal shows."""
    table = Table()
    for heading in _HEADINGS:
        table.add_column(heading, justify="right" if heading in _RIGHT else "left")
    for row in rows(reached, gaps):
        style = "bold" if row[1] == _ALL_FILES else None if row[-1] == _FULL else "yellow"
        table.add_row(*row, style=style)
    return table


def gap_lines(gaps: Iterable[Gap], sources: Mapping[str, str]) -> Iterator[str]:
    """Yield lines that show each gap with its place, its source line and its reason."""
    for gap in gaps:
        branch = gap.branch
        if branch is None:
            yield f"{gap.site.file}: {gap.site.name} is never called"
        else:
            source = sources[gap.site.file].splitlines()[branch.line - 1].strip()
            yield f"{gap.site.file}:{branch.line} {gap.site.name}: {branch.key}"
            yield f"    {source}"
        yield f"    {gap.reason.text if gap.reason else 'no reason is recorded'}"


def page(measurement: Measurement, gaps: Sequence[Gap], instruments: Iterable[str]) -> str:
    """Write the page of the documents: no line numbers, so that it changes with the branches only."""
    names = ", ".join(f"`{name}`" for name in sorted(instruments))
    lines = [_PAGE.format(instruments=names)]
    table = [_HEADINGS, ("---", "---", *("---:" for _ in _RIGHT)), *rows(measurement.reached, gaps)]
    lines += [f"| {' | '.join(row)} |\n" for row in table]
    lines.append(_GAPS_HEADING)
    for title, of_kind in _by_kind(gaps):
        branches = sum(gap.branches for gap in of_kind)
        lines.append(f"### {title[0].upper()}{title[1:]}: {branches} branches\n\n")
        lines += [_bullet(gap) for gap in of_kind]
        lines.append("\n")
    return "".join(lines).rstrip("\n") + "\n"


def _by_kind(gaps: Sequence[Gap]) -> Iterator[tuple[str, list[Gap]]]:
    for kind in (None, *Kind):
        of_kind = [gap for gap in gaps if (gap.reason.kind if gap.reason else None) is kind]
        if of_kind:
            yield kind.value if kind else "no reason recorded", of_kind


def _bullet(gap: Gap) -> str:
    what = NEVER_CALLED if gap.branch is None else f"`{gap.branch.condition}` → {gap.branch.way}"
    return f"- `{gap.site.file}` `{gap.site.name}`, {what}: {gap.reason.text if gap.reason else _NO_REASON}\n"


def _all_last(item: tuple[tuple[str, str], list[int]]) -> tuple[bool, tuple[str, str]]:
    (document, file), _ = item
    return document == _WHOLE, (document, file)
