"""The HTML report: rows, pages, and that nothing of a case can become a script."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from conformance import exit_codes
from conformance.candidates.registry import make_candidate
from conformance.cli import main
from conformance.loader import Vary, load_paths
from conformance.query import Query, Skipped
from conformance.report.html.entries import Judge, Status
from conformance.report.html.markup import Html, data_script, joined, own_script, script_policy, tag
from conformance.report.html.page import Report, page
from conformance.report.html.rows import Value, differing_rows, other_rows, shown
from conformance.shapes import Kind

if TYPE_CHECKING:
    from conformance.case import Case
    from conformance.report.html.entries import Entry

ROOT = Path(__file__).parents[2]
CASE = f"{ROOT / 'conformance/cases/contact-plane/origin.yaml'}::origin-step-down-touching"
HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)>"


class Elements(HTMLParser):
    """Gathers what a page is made of."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note an element."""
        self.tags.append((tag, dict(attrs)))


def elements(page: str) -> Elements:
    """Read a page."""
    parser = Elements()
    parser.feed(page)
    return parser


def written(folder: Path, *arguments: str) -> str:
    """Write a report and return it."""
    file = folder / "report.html"
    main(["report", *arguments, "--no-views", "-o", str(file)])
    return file.read_text(encoding="utf-8")


@given(st.text(), st.text())
def test_text_stays_text(content: str, value: str) -> None:
    """Whatever it is, it makes no element and leaves no attribute."""
    found = elements(tag("p", content, title=value)).tags
    assert [name for name, _ in found] == ["p"]
    assert list(found[0][1]) == ["title"]


def test_html_is_not_escaped_twice() -> None:
    """What was made by `tag` is taken as it is."""
    assert joined(tag("b", "<"), "&") == "<b>&lt;</b>&amp;"
    assert isinstance(joined("x"), Html)


def test_attributes_that_stand_alone() -> None:
    """True is written as a name, False is left out, names get their hyphens."""
    assert tag("input", hidden=True, checked=False, data_id="1", class_="a") == (
        '<input hidden data-id="1" class="a">'
    )


@given(st.text())
def test_data_does_not_end_its_element(text: str) -> None:
    """None of the characters that HTML reads is left in it."""
    inner = data_script({"t": HOSTILE + text}).removeprefix('<script type="application/json">')
    assert not set("<>&") & set(inner.removesuffix("</script>"))


def test_data_without_json() -> None:
    """JSON has no NaN, and browsers refuse it."""
    with pytest.raises(ValueError, match="JSON"):
        data_script([float("nan")])


def test_a_script_that_ends_itself() -> None:
    """It would be cut there, and its rest shown as text."""
    with pytest.raises(ValueError, match="cannot be embedded"):
        own_script("let s = '</SCRIPT>';")


def test_the_policy_names_scripts_by_their_hash() -> None:
    """The hash of the empty text is known (FIPS 180-4)."""
    assert "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=" in script_policy([""])


@pytest.mark.parametrize(
    ("kind", "value", "expected"),
    [
        (Kind.FLOAT32, -94.0, Value("-94.0", "0xC2BC0000")),
        (Kind.FLOAT64, 0.1, Value("0.1", "0x3FB999999999999A")),
        (Kind.CELL, 0xA9B40147, Value("2847146311", "0xA9B40147")),
        (Kind.STATE, "SLID", Value("SLID")),
        (Kind.FLOAT32, None, Value("none")),
        (Kind.FLOAT32, "x", Value("'x' (str)")),
    ],
)
def test_values(kind: Kind, value: object, expected: Value) -> None:
    """Numbers have bits; what is none has not."""
    assert shown(kind, value) == expected


def test_every_field_has_one_row() -> None:
    """A vector has one for each component, what is null one for all."""
    rows = other_rows("polygon_hits_sphere_fast", {"r": 1, "contact": [0.0, 1.0, 2.0]}, [])
    assert [row.name for row in rows] == ["r", "contact.x", "contact.y", "contact.z"]
    rows = other_rows("polygon_hits_sphere_fast", {"r": 0, "contact": None}, [])
    assert [row.name for row in rows] == ["r", "contact"]


def test_an_answer_stands_in_its_own_column() -> None:
    """The other one is empty, where nothing is known of it."""
    (row,) = other_rows("polygon_point_in_polygon", {"r": 1}, [], (True, False))
    assert (row.retail, row.candidate, row.differs) == (Value("1"), Value(""), False)


def test_a_candidate_that_answers_nothing() -> None:
    """Its column is empty, and the reason is told."""
    entry = Judge(Silent(), make_candidate("oracle"), ("cp-write",)).entry(first_case())
    assert entry.status is Status.SKIPPED
    assert entry.details is not None
    assert {row.candidate for row in entry.details.rows} == {Value("")}
    assert "skipped 1: silent: &lt;no&gt;" in page(Report("silent", [entry]))


class Silent:
    """A candidate that can do nothing."""

    name = "silent"

    def answer(self, query: Query) -> Skipped:
        """Skip it."""
        return Skipped("<no>")


def first_case() -> Case:
    """Return a case as written."""
    return load_paths([Path(CASE.partition("::")[0])], Vary(0)).cases[0]


def test_of_a_walk_one_tick_is_shown() -> None:
    """The last, as none differs."""
    ticks = [{"r": 0}, {"r": 1, "pos": [1.0, 2.0, 3.0]}]
    rows = other_rows("walk", {"ticks": ticks}, [])
    assert [row.name for row in rows] == [f"tick 1: {name}" for name in ("outcome", *POSITION)]
    assert differing_rows([]) == []


POSITION = ("position.x", "position.y", "position.z")


def test_the_failing_field_comes_first(tmp_path: Path) -> None:
    """With decimals, bits and distance of both; the others follow, each once."""
    page = written(tmp_path, CASE, "--candidate", "bug:cell-origin", "--poses", "0")
    rows = re.findall(r'<tr class="(\w+)"><th scope="row">(.*?)</th>(.*?)</tr>', page)
    names = [name for _, name, _ in rows]
    assert rows[0][:2] == ("differs", "contact_plane.d")
    for text in ("-94.0", "0xC2BC0000", "1.1e9 ULPs"):
        assert text in rows[0][2]
    kinds = [kind for kind, _, _ in rows]
    assert kinds == sorted(kinds)
    assert len(names) == len(set(names)) > 20


def test_source_and_writes_are_shown(tmp_path: Path) -> None:
    """The lines of the case with their numbers; retail's write and the candidate's."""
    page = written(tmp_path, CASE, "--candidate", "bug:cell-origin", "--poses", "0")
    assert "id: origin-step-down-touching" in page
    assert "&gt; retail: [cp-write]" in page
    assert "&gt; bug:cell-origin: [cp-write]" in page


def test_only_failing_cases_have_pages(tmp_path: Path) -> None:
    """The others are counted and listed."""
    cases = str(ROOT / "conformance/cases/contact-plane")
    page = written(tmp_path, cases, "--all-failed", "--candidate", "bug:cell-origin", "--poses", "0")
    found = elements(page).tags
    states = [given["data-status"] for name, given in found if name == "li"]
    pages = [given["data-status"] for name, given in found if name == "article"]
    assert states == sorted(states)
    assert set(pages) == {"failed"}
    assert len(pages) == states.count("failed") < len(states)


def test_a_case_runs_no_script(tmp_path: Path) -> None:
    """Title, reason, tags and source of a stranger's case are text, wherever they stand."""
    text = (ROOT / "docs" / "writing-cases.md").read_text(encoding="utf-8")
    case = re.findall(r"^```yaml\n(.*?)^```", text, re.DOTALL | re.MULTILINE)[0]
    hostile, count = re.subn(r"(?m)^title: .*$", f"title: '{HOSTILE}' # {HOSTILE}", case)
    assert count == 1
    file = tmp_path / "case.yaml"
    file.write_text(hostile, encoding="utf-8")
    page = written(tmp_path, str(file), "--candidate", "oracle", "--poses", "0")
    names = [name for name, _ in elements(page).tags]
    assert names.count("article") == 1
    assert "img" not in names
    assert names.count("script") == len(re.findall(r"<script>", page))
    assert "alert(1)&lt;/script&gt;" in page


def test_mistakes_in_files_are_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """They fail the run, as they keep cases from being asked."""
    file = tmp_path / "case.yaml"
    file.write_text("id: x<y\n", encoding="utf-8")
    output = tmp_path / "report.html"
    assert (
        main(["report", str(file), "--candidate", "oracle", "--no-views", "-o", str(output)])
        == exit_codes.FAILURES
    )
    assert "0 failed, 0 skipped, 0 passed" in capsys.readouterr().out
    assert "x&lt;y" in output.read_text(encoding="utf-8")


def test_a_run_that_is_broken_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What was asked until then is written, and the page and the exit code say that it is not all."""
    ask = Judge.entry

    def entry(judge: Judge, case: Case) -> Entry:
        if case.id != "origin-step-down-touching":
            raise KeyboardInterrupt
        return ask(judge, case)

    monkeypatch.setattr(Judge, "entry", entry)
    output = tmp_path / "report.html"
    arguments = [CASE.partition("::")[0], "--candidate", "oracle", "--no-views", "-o", str(output)]
    assert main(["report", *arguments]) == exit_codes.BROKEN_OFF
    assert "broken off" in capsys.readouterr().err
    page = output.read_text(encoding="utf-8")
    assert "broken off: not all cases were asked" in page
    assert [name for name, _ in elements(page).tags].count("li") == 1


def test_exit_codes(tmp_path: Path) -> None:
    """0 where all agree, 1 where one differs, 2 for a case that is not there."""
    output = ["-o", str(tmp_path / "report.html"), "--poses", "0", "--no-views"]
    assert main(["report", CASE, "--candidate", "oracle", *output]) == exit_codes.OK
    assert main(["report", CASE, "--candidate", "bug:cell-origin", *output]) == exit_codes.FAILURES
    assert main(["report", f"{CASE}-there-is-none", *output]) == exit_codes.USAGE
    assert main(["report", CASE, "--trace-writes", "x", *output]) == exit_codes.USAGE
