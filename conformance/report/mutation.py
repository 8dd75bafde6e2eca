"""The mutation score: by document and file, by kind of mistake, by function, and what was not noticed."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from rich.table import Table

from conformance.mutation.asking import POSES
from conformance.mutation.mutant import Operator
from conformance.mutation.trial import Verdict
from conformance.report.coverage import share

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from conformance.mutation.equivalents import Entry
    from conformance.mutation.mutant import Mutant
    from conformance.mutation.trial import Finding

    Row = tuple[str, ...]

_HEADINGS: Final = ("mutants", "equivalent", "noticed by cases", "by poses only", "not noticed", "score")
_SUM: Final = "all"

_PAGE: Final = """\
# What the suite notices

A suite that runs a line need not notice when the line is wrong. So small mistakes are planted in the oracle,
one at a time, and every built-in case is asked as it is written, then {poses} random poses. A mutant is
*noticed* when any output differs in any bit from what the oracle answers without it, when it fails, or when
it takes more than {patience:g} times as long. The *score* is the share of mutants that are noticed, of those
that could be: a mutant that nothing could notice is equivalent, and is listed with the reason.

`conformance mutants` measures it. The kinds of mistakes are our own, because what goes wrong in a port of
this code is mostly a matter of float32: mutmut and cosmic-ray exchange operators, numbers and keywords,
but know nothing of a store that rounds, of the order in which three products are added, or of the float32
beside a constant. They also write each mutant to disk and start a test run for it, seconds where one answer
takes a tenth of a millisecond. Here the code of one function is exchanged in memory; only questions whose
answers run the changed line are asked, cases before poses and quick ones first, up to the first difference.

Much of what is not noticed is another order of a sum that stays in a register: that changes the last bit of a
double, and the store to float32 after it hides it for nearly all numbers there are.

The command fails below the score that is the goal, or that `--least` says.

Random poses depend on Hypothesis' version a little; what cases notice does not.

Regenerate this page with `conformance mutants --output docs/mutation-score.md`.
"""
_EQUIVALENTS: Final = """
## Equivalent mutants

Each is an entry of `conformance/mutation/equivalents.yaml`. An entry about a mutant that is noticed, or that
is not there, is an error.

"""


@dataclass(slots=True)
class Tally:
    """How many mutants met which fate."""

    mutants: int = 0
    equivalent: int = 0
    cases: int = 0
    poses: int = 0

    @property
    def noticed(self) -> int:
        """Those that cases or poses noticed."""
        return self.cases + self.poses

    @property
    def noticeable(self) -> int:
        """Those that something could notice."""
        return self.mutants - self.equivalent

    def count(self, finding: Finding, *, equivalent: bool) -> None:
        """Count one mutant."""
        self.mutants += 1
        self.equivalent += equivalent
        self.cases += finding.verdict is Verdict.CASE
        self.poses += finding.verdict is Verdict.POSE

    def cells(self) -> Row:
        """Return what a table shows."""
        missed = self.noticeable - self.noticed
        score = share(self.noticed, self.noticeable) if self.noticeable else "-"
        counts = self.mutants, self.equivalent, self.cases, self.poses, missed
        return (*map(str, counts), score)


@dataclass(frozen=True, slots=True)
class Scores:
    """Findings, and which of the mutants are equivalent.

    Attributes
    ----------
    findings : sequence of Finding
        What was judged.
    equivalent : Mapping of Mutant to Entry
        The entry of the list for each mutant that has one.
    """

    findings: Sequence[Finding]
    equivalent: Mapping[Mutant, Entry]

    @property
    def total(self) -> Tally:
        """All mutants together."""
        return self.tallies(lambda _: (_SUM,))[_SUM,]

    @property
    def survivors(self) -> list[Finding]:
        """Mutants that were not noticed, for no known reason."""
        return [f for f in self.findings if not f.killed and f.mutant not in self.equivalent]

    def tallies(self, key: Callable[[Mutant], Row]) -> dict[Row, Tally]:
        """Count by a property of the mutants."""
        sums: defaultdict[Row, Tally] = defaultdict(Tally)
        for finding in self.findings:
            sums[key(finding.mutant)].count(finding, equivalent=finding.mutant in self.equivalent)
        return dict(sums)


def score_table(scores: Scores) -> Table:
    """Make the table that a terminal shows: by file."""
    table = Table()
    for heading in ("document", "file", *_HEADINGS):
        table.add_column(heading, justify="left" if heading in {"document", "file"} else "right")
    for row in _rows(scores, _by_file):
        table.add_row(*row)
    table.add_row(_SUM, "", *scores.total.cells(), style="bold")
    return table


def page(scores: Scores, patience: float) -> str:
    """Write the page of the documents: no line numbers but those of mutants that were not noticed."""
    parts = [_PAGE.format(poses=sum(POSES.values()), patience=patience)]
    parts += _section("By document and file", ("document", "file"), _rows(scores, _by_file), scores)
    parts += _section("By kind of mistake", ("kind", "mistake"), _kinds(scores), scores)
    parts += _section("By function", ("function",), _rows(scores, lambda m: (f"`{m.site}`",)), scores)
    parts.append(f"\n## Not noticed: {len(scores.survivors)}\n\n")
    parts += [f"- {_described(finding.mutant)}; {finding.verdict.value}\n" for finding in scores.survivors]
    parts.append(_EQUIVALENTS)
    parts += _reasons(scores.equivalent)
    return "".join(parts).rstrip("\n") + "\n"


def _by_file(mutant: Mutant) -> Row:
    return mutant.document, mutant.file


def _rows(scores: Scores, key: Callable[[Mutant], Row]) -> Iterator[Row]:
    for name, tally in sorted(scores.tallies(key).items()):
        yield (*name, *tally.cells())


def _kinds(scores: Scores) -> Iterator[Row]:
    tallies = scores.tallies(lambda mutant: (mutant.operator.label,))
    for operator in Operator:
        if (operator.label,) in tallies:
            yield operator.label, operator.value, *tallies[operator.label,].cells()


def _section(title: str, names: Row, rows: Iterable[Row], scores: Scores) -> Iterator[str]:
    total = (_SUM, *[""] * (len(names) - 1), *scores.total.cells())
    rule = (*["---"] * len(names), *["---:"] * len(_HEADINGS))
    yield f"\n## {title}\n\n"
    yield from (f"| {' | '.join(row)} |\n" for row in ((*names, *_HEADINGS), rule, *rows, total))


def _described(mutant: Mutant) -> str:
    repeated = f" (#{mutant.nth})" if mutant.nth > 1 else ""
    place = f"`{mutant.file}:{mutant.line}` `{mutant.function}`"
    return f"{place}, {mutant.operator.label}: `{mutant.before}` → `{mutant.after}`{repeated}"


def _reasons(equivalent: Mapping[Mutant, Entry]) -> Iterator[str]:
    by_reason: defaultdict[tuple[str, str], list[Mutant]] = defaultdict(list)
    for mutant, entry in equivalent.items():
        by_reason[entry.function, entry.reason].append(mutant)
    for (function, reason), mutants in by_reason.items():
        yield f"- `{function}`: {reason.strip()}\n"
        for mutant in mutants:
            repeated = f" (#{mutant.nth})" if mutant.nth > 1 else ""
            yield f"  - {mutant.operator.label}: `{mutant.before}` → `{mutant.after}`{repeated}\n"
