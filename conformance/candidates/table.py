"""A candidate in this process: a table of operations, and what becomes of those that fail."""

from __future__ import annotations

from traceback import extract_tb
from typing import TYPE_CHECKING, ClassVar

from conformance.query import Errored, Result, Skipped

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from conformance.query import Fields, Outcome, Query


class TableCandidate:
    """Answers a query with the function that its table has for the operation.

    Attributes
    ----------
    name : str
        How reports call it.
    operations : Mapping of str to callable
        What performs each operation.
    missing : str
        Why an operation that is not in the table is skipped.
    unable : tuple of exception types
        What a function raises for a query that the candidate does not do; such a query is skipped.
    """

    name: str
    operations: ClassVar[Mapping[str, Callable[[Query], Fields]]]
    missing: ClassVar[str]
    unable: ClassVar[tuple[type[Exception], ...]]

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"

    def answer(self, query: Query) -> Outcome:
        """Perform one operation; what is not done is skipped, what fails is an error."""
        operation = self.operations.get(query.op)
        if operation is None:
            return Skipped(f"{self.missing}: operation {query.op}")
        try:
            return Result(operation(query))
        except self.unable as error:
            return Skipped(self.reason(error))
        except Exception as error:  # noqa: BLE001 - a candidate records its failures, the run goes on
            return Errored(describe(error))

    def reason(self, error: Exception) -> str:
        """Say why a query is skipped that the candidate does not do."""
        return str(error)


def describe(error: Exception) -> str:
    """Return an error's kind and message, and the last place in the code where it happened."""
    frames = extract_tb(error.__traceback__)
    where = f" ({frames[-1].filename}:{frames[-1].lineno}, in {frames[-1].name})" if frames else ""
    return f"{type(error).__name__}: {error}{where}"
