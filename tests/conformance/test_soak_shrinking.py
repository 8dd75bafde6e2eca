"""A failure becomes the smallest case that fails in the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from hypothesis import settings
from soak_engines import WRONG, Faulty, Forgetful, Right
from soak_runs import engine

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.registry import make_candidate
from conformance.lint import lint
from conformance.loader import load_file
from conformance.soak.asking import Ending, judge
from conformance.soak.drawing import Drawer
from conformance.soak.families import mix_of
from conformance.soak.shrinking import found_case, shrink

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.soak.drawing import Drawn
    from conformance.soak.kinds import FailureKind

ORACLE = OracleCandidate()
DRAWER = Drawer(7, mix_of(["single calls"]))


class Named(Faulty):
    """An engine that is a candidate by itself."""

    name = "mine"

    def answer(self, query: Any) -> Any:
        """Answer a query."""
        return super().answer(query)


class NamedForgetful(Forgetful):
    """The same, wrong only after other queries."""

    name = "mine"

    def answer(self, query: Any) -> Any:
        """Answer a query."""
        return super().answer(query)


def wrong_one() -> Drawn:
    """Return a query that `Faulty` answers wrongly."""
    drawn = (DRAWER.draw(0, number) for number in range(200))
    return next(one for one in drawn if one.query.op.startswith(WRONG))


def test_a_failure_is_shrunk() -> None:
    """To inputs that cannot be smaller, of the same operation and with the same cause."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    smallest = shrink(drawn, kind, ORACLE, Named())
    assert smallest is not None
    query, verdict = smallest
    assert verdict.kind == kind
    assert set(numbers_in(query.inputs)) < set(numbers_in(drawn.query.inputs)) | {0.0, 1.0}
    assert len(repr(query.inputs)) <= len(repr(drawn.query.inputs))


def numbers_in(value: Any) -> list[float]:
    """Return the floats of a query's inputs."""
    if isinstance(value, float):
        return [value]
    items = value.values() if isinstance(value, dict) else value if isinstance(value, list | tuple) else ()
    return [number for item in items for number in numbers_in(item)]


def test_a_failure_is_shrunk_on_a_ci_machine_too() -> None:
    """Where Hypothesis keeps no examples unless it is told to."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    found = [shrunk_under(profile, drawn, kind) for profile in ("ci", "default")]
    assert found[0] == found[1] != repr(drawn.query.inputs)


def shrunk_under(profile: str, drawn: Drawn, kind: FailureKind) -> str:
    """Return the inputs of the smallest failure that is found under a profile of Hypothesis."""
    before = settings.get_current_profile_name()
    settings.load_profile(profile)
    try:
        smallest = shrink(drawn, kind, ORACLE, Named())
    finally:
        settings.load_profile(before)
    assert smallest is not None
    return repr(smallest[0].inputs)


class Tired(Named):
    """Is wrong three times only."""

    def __init__(self) -> None:
        super().__init__()
        self._left = 3

    def answer(self, query: Any) -> Any:
        """Answer a query."""
        if query.op.startswith(WRONG):
            self._left -= 1
        return super().answer(query) if self._left >= 0 else ORACLE.answer(query)


def test_a_failure_that_ends_by_itself_is_kept_as_far_as_it_went() -> None:
    """Who answers the same question in another way each time cannot be shrunk to the end."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    smallest = shrink(drawn, kind, ORACLE, Tired())
    assert smallest is not None
    assert smallest[1].kind == kind


def test_time_is_limited() -> None:
    """Without time the first failure is the smallest that is known."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    smallest = shrink(drawn, kind, ORACLE, Named(), seconds=0.0)
    assert smallest is not None
    assert repr(smallest[0].inputs) == repr(drawn.query.inputs)


def test_a_case_of_a_failure_can_be_used(tmp_path: Path) -> None:
    """`lint` has no complaints; the candidate fails it as it did, and retail does not."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    case = found_case(drawn, kind, ORACLE, Named, provenance="soak, seed 7, shard 0, query 3")
    assert case.alone
    path = tmp_path / case.name
    path.write_text(case.text, encoding="utf-8")
    assert lint([path]) == []
    (loaded,) = load_file(path).cases
    assert "Found by soak, seed 7, shard 0, query 3, candidate mine. First difference: v.x: " in loaded.why
    query = loaded.queries[0]
    assert judge(query, ORACLE, make_candidate(engine("Faulty"))).kind == kind
    assert judge(query, ORACLE, make_candidate(engine("Right"))).ending is Ending.AGREED


def test_what_shows_only_after_other_queries_is_said_to() -> None:
    """It is kept as it was drawn."""
    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    case = found_case(drawn, kind, ORACLE, NamedForgetful, provenance="a test")
    assert not case.alone
    assert f"First difference: {kind}, but not when asked by itself." in " ".join(case.text.split())


def test_who_is_right_has_nothing_to_shrink() -> None:
    """A failure that does not fail again has no smallest form."""

    class NamedRight(Right):
        name = "mine"

        def answer(self, query: Any) -> Any:
            return super().answer(query)

    drawn = wrong_one()
    kind = judge(drawn.query, ORACLE, Named()).kind
    assert kind is not None
    assert shrink(drawn, kind, ORACLE, NamedRight()) is None
