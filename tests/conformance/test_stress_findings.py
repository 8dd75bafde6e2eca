"""What a stress run has found: added up, looked up, written down."""

from __future__ import annotations

import json
import math
from itertools import permutations
from typing import TYPE_CHECKING

import pytest

from conformance.exact.errors import ErrorSample
from conformance.stress.findings import Findings, Picture, Reading, Worst
from conformance.stress.limits import limits
from conformance.stress.quantities import Tally
from conformance.stress.tables import family_table, limit_table
from conformance.stress.worst import write_worst

if TYPE_CHECKING:
    from pathlib import Path


def reading(severity: float, model: str = "retail", **quantities: float) -> Reading:
    """Return a reading of one sweep."""
    return Reading("translation", "pose", severity, model, quantities)


def rising() -> Findings:
    """Return findings whose error passes both limits, told in no order."""
    found = Findings()
    for severity, error in ((100.0, 0.005), (0.0, 0.0), (1000.0, 0.05), (10.0, 0.0005)):
        found.readings.append(reading(severity, contact_metres=error))
        found.readings.append(reading(severity, "double", contact_metres=0.0))
    return found


def test_parts_add_up() -> None:
    """Everything of both, in order; a note is said once."""
    whole = Findings(notes=["short"], costs={"drift": 1.0})
    whole.add(Findings([reading(1.0)], notes=["short", "long"], costs={"drift": 2.0, "scale": 3.0}))
    assert [r.severity for r in whole.readings] == [1.0]
    assert whole.notes == ["short", "long"]
    assert whole.costs == {"drift": 3.0, "scale": 3.0}


def test_a_curve_rises_with_severity() -> None:
    """Whatever the order in which its parts were done."""
    assert rising().curve("translation", "pose", "retail", "contact_metres") == [
        (0.0, 0.0),
        (10.0, 0.0005),
        (100.0, 0.005),
        (1000.0, 0.05),
    ]


def test_limits_say_how_far_an_error_stays_small() -> None:
    """The last severity within, and the first beyond."""
    told = {(limit.model, limit.limit): limit for limit in limits(rising(), ("retail", "double"))}
    assert (told["retail", 0.001].holds_to, told["retail", 0.001].fails_at) == (10.0, 100.0)
    assert told["retail", 0.01].words == "100"
    assert told["double", 0.001].words == "all"


def test_an_error_that_is_too_large_at_once_holds_nowhere() -> None:
    """NaN is too large, too."""
    found = Findings([reading(1.0, contact_metres=float("nan"))])
    assert [limit.words for limit in limits(found, ("retail",))] == ["none", "none"]


def test_the_worst_of_a_sweep_is_the_largest_over_its_severities() -> None:
    """One for each quantity."""
    found = Findings(
        worst=[
            Worst("drift", "circles", 1.0, "flips", 1.0, "one"),
            Worst("drift", "circles", 2.0, "flips", 3.0, "three"),
            Worst("drift", "circles", 3.0, "flips", 2.0, "two"),
            Worst("drift", "circles", 3.0, "contact_metres", 0.5, "half"),
        ]
    )
    assert [worst.document for worst in found.worst_of_sweeps()] == ["three", "half"]


def test_worst_cases_are_files_named_after_sweep_and_quantity(tmp_path: Path) -> None:
    """In a folder that is made."""
    worst = Worst("scale", "scale 0.5", 2.0, "contact_metres", 3.0, "id: x\n")
    (path,) = write_worst(tmp_path / "new", [worst])
    assert path.name == "scale-scale-0-5-contact-metres.yaml"
    assert path.read_text(encoding="utf-8") == "id: x\n"


def test_json_has_everything() -> None:
    """Pictures as rows of digits."""
    found = rising()
    found.readings.append(reading(9.0, contact_metres=math.nan, height_metres=math.inf))
    found.pictures.append(Picture("edge", ("x", "y"), ((0, 1), (2, 3))))
    told = json.loads(found.to_json({"seed": 7}))
    assert told["seed"] == 7
    assert len(told["readings"]) == 9
    assert told["readings"][8]["quantities"] == {"contact_metres": "nan", "height_metres": "inf"}
    assert told["readings"][0]["quantities"] == {"contact_metres": 0.005}
    assert told["pictures"] == [{"name": "edge", "axes": ["x", "y"], "rows": ["01", "23"]}]


def test_a_tally_tells_largest_median_and_counts() -> None:
    """Of samples with and without flips."""
    tally = Tally()
    tally.count("refused", 0)
    for metres in (0.1, 0.3, 0.2):
        tally.add(ErrorSample(contact_metres=metres))
    tally.add(ErrorSample(flips=("result",)))
    tally.note({"effect_flips": 1.0, "effect_metres": 2.0})
    assert tally.quantities() == {
        "contact_metres": 0.3,
        "contact_metres_median": 0.2,
        "effect_metres": 2.0,
        "effect_metres_median": 2.0,
        "answers": 4.0,
        "flips": 1.0,
        "other_paths": 0.0,
        "refused": 0.0,
        "effect_flips": 1.0,
    }


def test_the_median_of_an_even_number_is_between_two() -> None:
    """As of the errors that `conformance errors` tells."""
    tally = Tally()
    for metres in (4.0, 1.0, 2.0, 8.0):
        tally.add(ErrorSample(contact_metres=metres))
    assert tally.quantities()["contact_metres_median"] == 3.0


@pytest.mark.parametrize("order", list(permutations([5.0, math.nan, 1.0])))
def test_nan_is_the_largest_of_a_tally(order: tuple[float, ...]) -> None:
    """Whenever it comes, it is not lost, and no budget allows it."""
    tally = Tally()
    for metres in order:
        tally.add(ErrorSample(contact_metres=metres))
    told = tally.quantities()
    assert math.isnan(told["contact_metres"])
    assert told["contact_metres_median"] == 5.0


def test_tables_have_a_line_for_each_severity_and_each_broken_limit() -> None:
    """Columns that say nothing are left out."""
    found = rising()
    table = family_table(found, "translation", "engine")
    assert table.row_count == 4
    assert [column.header for column in table.columns] == [
        "sweep",
        "at",
        "D error (m)",
        "engine: not retail's",
    ]
    assert limit_table(list(limits(found, ("retail", "double")))).row_count == 1
    still = Findings([reading(1.0, contact_metres=0.0)])
    assert limit_table(list(limits(still, ("retail",)))).row_count == 0
