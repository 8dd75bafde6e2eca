"""The report: its JSON, its omissions, and its tables."""

from __future__ import annotations

import json

from rich.console import Console

from conformance.bench.figures import Summary
from conformance.bench.machine import machine, versions
from conformance.bench.report import Curve, Point, Ratio, Report
from conformance.bench.tables import duration, show
from conformance.bench.timing import Comparison

COMPARED = Comparison(Summary(2.0, 1.5, 2.5), Summary(100.0, 90.0, 110.0), Summary(200.0, 190.0, 210.0), 5)


def filled() -> Report:
    """Return a report with one of everything."""
    report = Report(7)
    report.ratios.append(Ratio("room", "strike", "native", 10_000, 1, COMPARED, "a note"))
    costs = (Summary(10.0, 9.0, 11.0), Summary(20.0, 19.0, 21.0))
    report.curves.append(Curve("polygons", "strike", (60, 600), costs, 0.3))
    report.points.append(Point("room", "engine", 1000.0, {"position (m)": 1e-6}))
    report.omit("peers", "not asked for")
    return report


def test_json_has_the_promised_keys() -> None:
    """A ratio names scene, op, reference, batch and threads, and is our rate over theirs."""
    record = json.loads(filled().to_json())
    assert record["ratios"] == [
        {
            "scene": "room",
            "op": "strike",
            "reference": "native",
            "batch": 10_000,
            "threads": 1,
            "ratio": 2.0,
            "spread": [1.5, 2.5],
            "rounds": 5,
            "ours_ns": 100.0,
            "theirs_ns": 200.0,
            "agreement": 1.0,
            "note": "a note",
        }
    ]
    assert record["seed"] == 7
    assert record["scaling"][0]["exponent"] == 0.3
    assert record["work_precision"][0]["errors"] == {"position (m)": 1e-6}
    assert record["omissions"] == ["peers: not asked for"]
    assert set(record["machine"]) == {"processor", "architecture", "cores", "system"}
    assert record["versions"]["python"]


def test_an_omission_is_told_once() -> None:
    """What is missing in every scene is one line."""
    report = Report(0)
    report.omit("strike", "no such function")
    report.omit("strike", "no such function")
    assert report.omissions == ["strike: no such function"]
    assert report.empty


def test_everything_is_shown() -> None:
    """The terminal shows the seed, each table, omissions and failures."""
    report = filled()
    report.failures.append("room: strike beside the oracle: query 3")
    console = Console(width=200, record=True, file=None, quiet=False)
    with console.capture() as captured:
        show(console, report)
    text = captured.get()
    for part in ("seed 7", "native", "2.00", "1.50 - 2.50", "a note", "polygons", "0.30", "1e-06"):
        assert part in text
    assert "peers: not asked for" in text
    assert "query 3" in text


def test_durations_have_suitable_units() -> None:
    """Nanoseconds, microseconds and milliseconds."""
    assert [duration(value) for value in (12.3, 4560.0, 7.89e6)] == ["12 ns", "4.56 us", "7.89 ms"]


def test_the_machine_is_named() -> None:
    """Numbers are nothing without the machine and the versions that made them."""
    assert machine()["processor"]
    assert machine()["cores"] >= 1
    assert {"python", "numba", "numpy"} <= set(versions())
