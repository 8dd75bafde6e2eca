"""Candidates that are the oracle on another number type: no mistake, only other rounding."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from conformance.candidates.number_models import Double, Single, plain
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.candidates.output_rounding import rounded_outputs
from conformance.candidates.own_caches import always, own_caches
from conformance.candidates.replacements import Everywhere, Method, replaced
from conformance.query import Result

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from conformance.query import Fields, Outcome, Query

OPS_PACKAGE: Final = "conformance.candidates.oracle_ops"
"""Where the numbers of a query become the oracle's."""


class NumberScope:
    """What makes the oracle compute with a number type: the inputs are read as it, worlds are its own.

    Parameters
    ----------
    number : callable
        Makes a number of the type of a Python float, or of one of the type.
    """

    def __init__(self, number: Callable[[Any], Any]) -> None:
        readers = Everywhere(OPS_PACKAGE, "f32", number).targets()
        self._replacements = (
            *(Method(owner, name, always(value)) for owner, name, value in readers),
            *own_caches(),
        )

    @contextmanager
    def active(self) -> Iterator[None]:
        """Compute with the type inside the block."""
        with replaced(self._replacements):
            yield


class ModelCandidate(OracleCandidate):
    """The oracle on a number type that rounds elsewhere than retail.

    What it tells is rounded to float32 where the operation's outputs are float32; `unrounded` tells more.
    """

    def __init__(self, name: str, number: Callable[[Any], Any]) -> None:
        self.name = name
        self._scope = NumberScope(number)

    def __repr__(self) -> str:
        return f"ModelCandidate({self.name!r})"

    def answer(self, query: Query) -> Outcome:
        """Perform one operation and round what it tells."""
        outcome = self.unrounded(query)
        return Result(rounded_outputs(query.op, outcome.fields)) if isinstance(outcome, Result) else outcome

    def unrounded(self, query: Query) -> Outcome:
        """Perform one operation; the numbers are as the model computed them."""
        with self._scope.active():
            outcome = super().answer(query)
        return Result(self.told(outcome.fields)) if isinstance(outcome, Result) else outcome

    def told(self, fields: Fields) -> Fields:
        """Return an answer in Python floats."""
        return plain(fields)


def single() -> ModelCandidate:
    """Make the model in which every operation rounds to float32."""
    return ModelCandidate("single", Single)


def double() -> ModelCandidate:
    """Make the model in which no store rounds to float32."""
    return ModelCandidate("double", Double)
