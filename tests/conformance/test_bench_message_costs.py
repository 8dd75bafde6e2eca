"""What messages have cost, added up."""

from __future__ import annotations

import pytest

from conformance.bench.message_costs import Cost, Seconds, costs_by_operation, message_ratios
from conformance.bench.report import MessageCost
from conformance.bench.tables import message_rows

WALKS = Cost(10, Seconds(4.0, 0.1), Seconds(5.0, 0.2))
MOVES = Cost(30, Seconds(0.5, 0.25), Seconds(0.5, 0.5))
ROUNDS = [{"walk": WALKS, "transition": MOVES}, {"transition": MOVES}]


def test_the_ratio_is_that_of_all_rounds_together() -> None:
    """A round without walks says little of the suite: its ratio is part of the spread alone."""
    processor, wall = message_ratios("nobody", "hex", ROUNDS)
    assert processor.comparison.ratio.middle == 5.0 / 5.6
    assert processor.comparison.ours.middle == 1e9 * 5.6 / 70
    assert processor.comparison.theirs.middle == pytest.approx(1e9 * 5.0 / 70, rel=1e-15)
    assert processor.note == "messages, floats hex: 12.0% more processor time"
    rounds = 0.5 / 0.75, 4.5 / 4.85
    assert rounds[0] < processor.comparison.ratio.low < processor.comparison.ratio.high < rounds[1]
    assert wall.comparison.ratio.middle == pytest.approx(6.0 / 7.2, rel=1e-15)
    assert wall.note == "messages, floats hex: 20.0% more wall time"


def test_operations_are_told_by_what_messages_spend_on_them() -> None:
    """Whatever share of the operation's own time that is."""
    costs = costs_by_operation("decimal", ROUNDS)
    assert costs == [
        MessageCost("transition", "decimal", 60, 1.0, 0.5),
        MessageCost("walk", "decimal", 10, 4.0, 0.1),
    ]
    assert message_rows(costs) == [
        ("transition", "decimal", "60", "16.7 ms", "8.33 ms", "50%", "83%"),
        ("walk", "decimal", "10", "400 ms", "10 ms", "2%", "17%"),
    ]
