"""The report in a real browser, opened from a file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import Browser, browser, missing

from conformance.cli import main

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parents[2]
CASES = (ROOT / "conformance/cases/contact-plane/origin.yaml", ROOT / "conformance/cases/walks/cellar.yaml")
SHOWN = "document.querySelector('article:not([hidden])')"
MIDDLE = """
const plot = arguments[0];
const sphere = document.querySelector(`${plot} .plot`).data.find((trace) => trace.name === "retail: spheres");
return ["x", "y", "z"].map((axis) => (Math.min(...sphere[axis]) + Math.max(...sphere[axis])) / 2);
"""
SLIDE = """
const slider = document.querySelector(`${arguments[0]} input[type=range]`);
slider.value = arguments[1];
slider.dispatchEvent(new Event("input"));
"""
WALK = "#case-walk-cellar-descent"


@pytest.fixture(scope="module")
def window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    """Open a report of failing and passing cases; at the end, nothing must have gone wrong in it."""
    pytest.importorskip("plotly", reason="skipped: plotly is not installed")
    if missing():
        pytest.skip(missing())
    folder = tmp_path_factory.mktemp("report")
    page = folder / "report.html"
    options = ["--candidate", "bug:cell-origin", "--poses", "0", "-o", str(page)]
    main(["report", *map(str, CASES), *options])
    with browser(folder / "profile") as opened:
        opened.open(page.as_uri())
        opened.wait(f"{SHOWN}?.querySelector('.view')?.dataset.drawn")
        yield opened
        assert opened.console() == []


def test_the_first_failing_case_is_shown(window: Browser) -> None:
    """Its failing row is the first of its table, and is marked."""
    row = window.run(f"return {SHOWN}.querySelector('tbody tr').className")
    assert row == "differs"
    assert window.run(f"return {SHOWN}.dataset.status") == "failed"
    assert window.run("return document.querySelectorAll('article:not([hidden])').length") == 1


def test_the_list_is_filtered(window: Browser) -> None:
    """By words and by status; the number of those that are left is said."""
    fill = "const f = document.getElementById(arguments[0]); f.value = arguments[1];"
    window.run(f"{fill} f.dispatchEvent(new Event('input'))", "filter", "cellar DOWN")
    shown = window.run("return [...document.querySelectorAll('#cases > li')].filter(i => !i.hidden).length")
    total = window.run("return document.querySelectorAll('#cases > li').length")
    assert 0 < shown < total
    said = window.run("return document.getElementById('matching').textContent")
    assert said == f"{shown} of {total}"
    window.run(f"{fill} f.dispatchEvent(new Event('change'))", "status", "skipped")
    assert window.run("return document.getElementById('matching').textContent") == f"0 of {total}"
    window.run(f"{fill} f.dispatchEvent(new Event('change'))", "status", "")
    window.run(f"{fill} f.dispatchEvent(new Event('input'))", "filter", "")


def test_the_slider_moves_the_sphere(window: Browser) -> None:
    """From the top of the stairs to the ramp's foot; the text says the tick."""
    window.run("location.hash = arguments[0]", WALK)
    window.wait(f"document.querySelector('{WALK} .view').dataset.drawn")
    first = window.run(MIDDLE, WALK)
    window.run(SLIDE, WALK, 163)
    window.wait(f"document.querySelector('{WALK} output').textContent === 'tick 162'")
    last = window.run(MIDDLE, WALK)
    assert first[2] == pytest.approx(94.005 + 0.9125, abs=0.01)
    assert last[2] == pytest.approx(90.005 + 0.9125, abs=0.01)
    assert "contact plane n=(0.0, 0.0, 1.0) d=-90.0" in window.run(
        f"return document.querySelector('{WALK} .step').textContent"
    )


def test_the_view_follows_the_mover(window: Browser) -> None:
    """The range of z is then that about the mover."""
    window.run("location.hash = arguments[0]", WALK)
    window.wait(f"document.querySelector('{WALK} .view').dataset.drawn")
    look = f"const look = document.querySelector('{WALK} select');"
    window.run(f"{look} look.value = 'mover'; look.dispatchEvent(new Event('change'))")
    window.run(SLIDE, WALK, 1)
    plot = f"document.querySelector('{WALK} .plot').layout.scene.zaxis.range"
    window.wait(f"{plot}[0] > 92 && {plot}[1] < 99")


def test_a_script_that_is_not_ours_does_not_run(window: Browser) -> None:
    """The policy of the page refuses it, even if it came past the escaping."""
    make = "const made = document.createElement('script'); made.textContent = 'window.harm = 1';"
    window.run(f"{make} document.body.append(made)")
    assert window.run("return window.harm === undefined")
    refused = window.console()
    assert len(refused) == 1
    assert "Content Security Policy" in refused[0]


def test_it_can_be_looked_at(window: Browser, tmp_path: Path) -> None:
    """A screenshot of the view is not all of one colour."""
    file = tmp_path / "report.png"
    window.screenshot(file)
    assert len(file.read_bytes()) > 20_000
