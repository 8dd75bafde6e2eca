"""The numbers of a run in a page: words stay, numbers are replaced."""

from __future__ import annotations

from pathlib import Path

import pytest

from conformance.bench.figures import Summary
from conformance.bench.page import BEGIN, END, PageError, numbers, write_page
from conformance.bench.report import Curve, Point, Ratio, Report
from conformance.bench.timing import Comparison

COMPARED = Comparison(Summary(2.0, 1.5, 2.5), Summary(100.0, 90.0, 110.0), Summary(200.0, 190.0, 210.0), 5)
PAGE = f"before\n{BEGIN}\nold\n{END}\nafter\n"


def filled() -> Report:
    """Return a report with one of everything."""
    report = Report(7, ratios=[Ratio("room", "strike", "native", 10_000, 1, COMPARED)])
    costs = (Summary(10.0, 9.0, 11.0), Summary(20.0, 19.0, 21.0))
    report.curves.append(Curve("polygons", "strike", (60, 600), costs, 0.3))
    report.points.append(Point("room", "engine", 1000.0, {"position (m)": 1e-6}))
    report.omit("peers", "not asked for")
    return report


def test_only_the_numbers_are_replaced(tmp_path: Path) -> None:
    """What is before and after the marks stays; a second run replaces the first."""
    page = tmp_path / "page.md"
    page.write_text(PAGE, encoding="utf-8")
    for _ in range(2):
        write_page(page, filled(), "conformance bench --quick")
    text = page.read_text(encoding="utf-8")
    assert text.startswith(f"before\n{BEGIN}\n- `conformance bench --quick --seed 7`\n")
    assert text.endswith(f"\n{END}\nafter\n")
    assert text.count("| room | strike | native | 10000 | 1 | 2.00 | 1.50 - 2.50 | 100 ns | 200 ns |") == 1


def test_every_table_is_written() -> None:
    """Ratios, points, curves and omissions; no failures, so no heading for them."""
    text = numbers(filled(), "conformance bench")
    assert "| polygons | strike | 60, 600 | 10 ns, 20 ns | 0.30 |" in text
    assert "| room | engine | 1 us | 1e-06 |" in text
    assert "- peers: not asked for" in text
    assert "### Failures" not in text


def test_samples_are_told() -> None:
    """A reader sees of how many queries a mean is."""
    report = filled()
    report.facts["samples"] = {"strike": 1600, "tick": 80}
    told = "- queries of a round that are asked one by one in Python: strike 1600, tick 80"
    assert told in numbers(report, "conformance bench").splitlines()


def test_scenes_stand_side_by_side() -> None:
    """One line for each comparison, sorted by the reference; what was not measured is left blank."""
    report = filled()
    report.facts["polygons"] = {"room": [64], "building": [576]}
    for scene, reference in (("building", "native"), ("building", "fcl")):
        report.ratios.append(Ratio(scene, "strike", reference, 10_000, 1, COMPARED))
    lines = numbers(report, "conformance bench").splitlines()
    begin = lines.index("| reference | op | batch | threads | room | building |")
    assert lines[begin + 2 : begin + 5] == [
        "| fcl | strike | 10000 | 1 |  | 2.00 |",
        "| native | strike | 10000 | 1 | 2.00 | 2.00 |",
        "",
    ]


@pytest.mark.parametrize("text", ["nothing", BEGIN, f"{END}\n{BEGIN}\n"])
def test_a_page_without_marks_is_refused(tmp_path: Path, text: str) -> None:
    """It is left as it is."""
    page = tmp_path / "page.md"
    page.write_text(text, encoding="utf-8")
    with pytest.raises(PageError, match="has no lines"):
        write_page(page, filled(), "conformance bench")
    assert page.read_text(encoding="utf-8") == text


def test_the_page_of_the_documents_has_the_marks() -> None:
    """Its numbers can be replaced."""
    page = Path(__file__).parents[2] / "docs" / "benchmarks.md"
    text = page.read_text(encoding="utf-8")
    assert text.index(f"{BEGIN}\n") < text.index(f"\n{END}\n")
