"""The page: a summary, a list to filter, and of each case what differs, its source and its scene."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from conformance.report.html.entries import Status
from conformance.report.html.markup import Html, data_script, joined, own_script, script_policy, tag
from conformance.report.html.rows import MOST_EQUAL
from conformance.report.ticks import step_id, tick_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from conformance.report.html.entries import Details, Entry
    from conformance.report.html.rows import Row, Value
    from conformance.source import Problem
    from conformance.verdict import Failure

_ASSETS: Final = Path(__file__).parent / "assets"
_NO_SCENE: Final = "This operation computes with numbers only; there is nothing to look at."
_HEADINGS: Final = ("field", "{against}", "bits", "{who}", "bits", "distance", "")


@dataclass(frozen=True, slots=True)
class Report:
    """Everything that a report shows.

    Attributes
    ----------
    candidate : str
        Who was tested.
    entries : sequence of Entry
        Every case that was asked.
    problems : sequence of Problem
        What keeps other cases from being asked.
    complaints : sequence of str
        What was wrong besides, such as how the candidate stopped.
    views : mapping of str to dict
        By case id, what the 3-D view shows.
    library : str
        The source of the 3-D library; nothing where there are no views.
    whole : bool
        False: the run was broken off, and not all cases were asked.
    """

    candidate: str
    entries: Sequence[Entry]
    problems: Sequence[Problem] = ()
    complaints: Sequence[str] = ()
    views: Mapping[str, dict[str, Any]] | None = None
    library: str = ""
    whole: bool = True

    @property
    def counts(self) -> Counter[Status]:
        """How many cases have come to what."""
        return Counter(entry.status for entry in self.entries)

    @property
    def failed(self) -> bool:
        """Whether anything was wrong."""
        return bool(self.counts[Status.FAILED] or self.problems or self.complaints)


def page(report: Report) -> str:
    """Write the whole file."""
    scripts = [_asset("report.js")]
    if report.library:
        scripts = [report.library, _asset("view.js"), *scripts]
    ordered = sorted(report.entries, key=lambda entry: list(Status).index(entry.status))
    title = f"{report.candidate} against retail"
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        script_policy(scripts),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("title", title),
        tag("style", Html(_asset("report.css"))),
    )
    body = tag(
        "body",
        tag("header", tag("h1", title), tag("p", *_summary(report), class_="summary")),
        tag("nav", *_navigation(ordered), aria_label="cases"),
        tag(
            "main",
            *_problems(report),
            *(_section(entry, report) for entry in ordered if entry.details),
        ),
        *map(own_script, scripts),
    )
    return f"<!doctype html>\n{tag('html', head, body, lang='en')}\n"


def _asset(name: str) -> str:
    return (_ASSETS / name).read_text(encoding="utf-8")


def _summary(report: Report) -> Iterator[Html]:
    for status in Status:
        count = report.counts[status]
        yield tag("span", f"{count} {status.value}", class_=f"count {status.value}")
    queries = sum(entry.verdict.compared for entry in report.entries)
    yield tag("span", f"{queries} queries compared", class_="count")
    if not report.whole:
        yield tag("span", "broken off: not all cases were asked", class_="count failed")
    if report.problems:
        yield tag("span", f"{len(report.problems)} mistakes in case files", class_="count failed")


def _navigation(ordered: Sequence[Entry]) -> Iterator[Html]:
    yield tag(
        "div",
        tag("input", type="search", id="filter", placeholder="filter: words of id, title, tag, operation"),
        tag("select", *_options(), id="status", aria_label="status"),
        tag("p", id="matching", role="status"),
        class_="tools",
    )
    yield tag("ol", *map(_listed, ordered), id="cases")


def _options() -> Iterator[Html]:
    yield tag("option", "all", value="")
    yield from (tag("option", status.value, value=status.value) for status in Status)


def _listed(entry: Entry) -> Html:
    case = entry.case
    words = " ".join((case.id, case.title, case.op, *case.tags, *case.retail))
    name = tag("a", case.id, href=f"#case-{case.id}") if entry.details else tag("span", case.id)
    return tag(
        "li",
        name,
        tag("span", case.title, class_="title"),
        class_=entry.status.value,
        data_status=entry.status.value,
        data_words=words.lower(),
    )


def _problems(report: Report) -> Iterator[Html]:
    texts = [*map(str, report.problems), *report.complaints]
    if texts:
        heading = tag("h2", "Wrong besides")
        yield tag("section", heading, *(tag("pre", text) for text in texts), class_="problems")


def _section(entry: Entry, report: Report) -> Html:
    case, details = entry.case, entry.details
    if details is None:
        return Html("")
    return tag(
        "article",
        tag("h2", case.title),
        tag(
            "p",
            tag("span", entry.status.value, class_=f"count {entry.status.value}"),
            tag("code", _shown_id(entry, details)),
            tag("code", case.op),
            tag("span", str(case.location)),
            class_="meta",
        ),
        tag("p", case.why.strip()),
        tag("p", "retail: ", tag("code", "; ".join(case.retail))),
        *_outcome(entry),
        *_view(case.id, report.views),
        *_fields(details),
        *_excerpts(entry, details),
        tag("h3", "Source"),
        tag("pre", *_numbered(case.source, case.first_line), class_="source"),
        id=f"case-{case.id}",
        data_status=entry.status.value,
    )


def _shown_id(entry: Entry, details: Details) -> str:
    failures = entry.verdict.failures
    tick = tick_of(failures[0].found) if failures else None
    return details.query.label if tick is None else step_id(details.query.label, tick)


def _outcome(entry: Entry) -> Iterator[Html]:
    for failure in entry.verdict.failures[:1]:
        yield tag("p", failure.summary, class_="failure")
        if failure.error:
            yield tag("pre", failure.error)
    others: Sequence[Failure] = entry.verdict.failures[1:]
    if others:
        yield tag("p", "also fails: ", tag("code", ", ".join(other.query.label for other in others)))
    for reason, count in entry.verdict.skipped.items():
        yield tag("p", f"skipped {count}: {reason}", class_="reason")


def _view(case_id: str, views: Mapping[str, dict[str, Any]] | None) -> Iterator[Html]:
    if views is None:
        return
    yield tag("h3", "Scene")
    if case_id in views:
        yield tag("div", data_script(views[case_id]), class_="view")
    else:
        yield tag("p", _NO_SCENE, class_="none")


def _fields(details: Details) -> Iterator[Html]:
    yield tag("h3", "Fields")
    if not details.rows:
        yield tag("p", "There is no answer to show.", class_="none")
        return
    names = {"who": details.who, "against": details.against}
    head = tag("tr", *(tag("th", heading.format(**names)) for heading in _HEADINGS))
    shown, left_out = _first_equal(details.rows)
    yield tag("table", tag("thead", head), tag("tbody", *map(_row, shown)), class_="fields")
    if left_out:
        yield tag("p", f"and {left_out} more fields", class_="none")


def _first_equal(rows: Sequence[Row]) -> tuple[list[Row], int]:
    differing = [row for row in rows if row.differs]
    equal = [row for row in rows if not row.differs]
    return differing + equal[:MOST_EQUAL], max(0, len(equal) - MOST_EQUAL)


def _row(row: Row) -> Html:
    values = [cell for value in (row.retail, row.candidate) for cell in _value(value)]
    return tag(
        "tr",
        tag("th", row.name, scope="row"),
        *values,
        tag("td", row.distance),
        tag("td", row.note),
        class_="differs" if row.differs else "equal",
    )


def _value(value: Value) -> tuple[Html, Html]:
    return tag("td", value.text), tag("td", value.bits, class_="bits")


def _excerpts(entry: Entry, details: Details) -> Iterator[Html]:
    for failure in entry.verdict.failures[:1]:
        if failure.around:
            yield tag("h3", "Ticks")
            yield tag("pre", "\n".join(failure.around))
    if details.writes:
        yield tag("h3", "Who wrote what")
        yield tag("pre", "\n".join(details.writes), class_="writes")


def _numbered(source: str, first: int) -> Iterator[str]:
    for number, line in enumerate(source.splitlines(), start=first):
        yield joined(tag("span", f"{number:>5} ", class_="number"), line, "\n")
