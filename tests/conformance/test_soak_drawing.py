"""Queries by their numbers: the same in any order and in any process."""

from __future__ import annotations

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import strategies as st

from conformance.soak import drawing
from conformance.soak.drawing import BYTES, Drawer, NothingDrawnError, _Reader
from conformance.soak.families import STRATEGIES, Mix, mix_of

ROOT = Path(__file__).parents[2]
DIGEST = """
import hashlib
from conformance.soak.drawing import Drawer
from conformance.soak.families import mix_of
drawer, total = Drawer(3, mix_of()), hashlib.sha256()
for number in range(20):
    total.update(repr(drawer.draw(5, number).query.inputs).encode())
print(total.hexdigest())
"""


def test_there_are_families() -> None:
    """Every family of random queries is one, walks included."""
    assert len(STRATEGIES) == 11
    assert mix_of().names == tuple(STRATEGIES)
    assert all(weight > 0.0 for weight in mix_of().weights)


def test_a_mix_does_not_depend_on_the_order_of_its_names() -> None:
    """Families are as their list has them; one that is not there is named."""
    assert mix_of(["worlds", "cells"]) == mix_of(["cells", "worlds"]) == Mix(("cells", "worlds"), (6.0, 20.0))
    with pytest.raises(KeyError, match="houses"):
        mix_of(["houses", "worlds"])


def test_draws_do_not_depend_on_each_other() -> None:
    """Backwards, the same numbers give the same queries."""
    one, other = Drawer(3, mix_of(["cells"])), Drawer(3, mix_of(["cells"]))
    forwards = [repr(one.draw(0, number).query.inputs) for number in range(8)]
    backwards = [repr(other.draw(0, number).query.inputs) for number in reversed(range(8))]
    assert forwards == backwards[::-1]
    assert len(set(forwards)) == 8


def test_seed_and_shard_make_other_queries() -> None:
    """Every number of a query's place counts."""
    mix = mix_of(["cells"])
    drawn = [Drawer(3, mix).draw(0, 0), Drawer(4, mix).draw(0, 0), Drawer(3, mix).draw(1, 0)]
    assert len({one.raw for one in drawn}) == 3


def test_draws_are_the_same_in_another_process() -> None:
    """Also where sets are in another order."""
    drawer, total = Drawer(3, mix_of()), hashlib.sha256()
    for number in range(20):
        total.update(repr(drawer.draw(5, number).query.inputs).encode())
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONHASHSEED": "1"}
    done = subprocess.run(
        [sys.executable, "-c", DIGEST], env=environment, capture_output=True, encoding="utf-8", check=True
    )
    assert done.stdout.strip() == total.hexdigest()


@pytest.mark.parametrize("family", STRATEGIES)
def test_there_are_bytes_enough(family: str) -> None:
    """A query takes a tenth of the bytes that it is read from, so that none is ever cut short."""
    reader, drawn = _Reader(STRATEGIES[family]), Drawer(1, mix_of([family])).draw(0, 0)
    used = reader._feed(drawn.raw)
    assert used is not None
    assert len(used) < BYTES // 10


def test_a_family_that_refuses_everything_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """It does not go on for ever."""
    refusing = {"none": st.nothing() | st.integers().filter(lambda _: False)}
    monkeypatch.setattr(drawing, "STRATEGIES", refusing)
    drawer = Drawer(0, Mix(("none",), (1.0,)))
    with pytest.raises(NothingDrawnError, match=r"^none: 100 times in a row"):
        drawer.draw(0, 0)
