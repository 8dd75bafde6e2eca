"""A Python object as a candidate: ``mod:package.module:factory``."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from conformance.candidates.registry import MODULE_PREFIX
from conformance.candidates.table import describe
from conformance.fields import FieldError, normalise
from conformance.outputs import OUTPUTS
from conformance.protocol.features import FEATURES, undeclared
from conformance.protocol.replies import BadReplyError
from conformance.query import Errored, Result, Skipped

if TYPE_CHECKING:
    from collections.abc import Callable

    from conformance.query import Outcome, Query


class FactoryError(Exception):
    """A factory cannot be imported or called, or what it makes answers nothing."""


class ModuleCandidate:
    """Asks an object of another package, and holds it to what an engine in a process is held to.

    The object has ``answer(query)``, which returns one of `Result`, `Skipped` and `Errored` of
    `conformance.query`. It may have ``ops`` and ``features``, collections of the names of what it does.

    Parameters
    ----------
    target : str
        ``package.module:factory``; the factory is called without arguments.

    Raises
    ------
    FactoryError
    """

    def __init__(self, target: str) -> None:
        self.name = MODULE_PREFIX + target
        made = _make(target)
        if not callable(getattr(made, "answer", None)):
            raise FactoryError(f"{self.name} made {made!r}, expected an object with answer(query)")
        self._answer: Callable[[Query], object] = made.answer
        self._ops = frozenset(getattr(made, "ops", OUTPUTS))
        self._features = frozenset(getattr(made, "features", FEATURES))

    def __repr__(self) -> str:
        return f"ModuleCandidate({self.name.removeprefix(MODULE_PREFIX)!r})"

    def answer(self, query: Query) -> Outcome:
        """Perform one operation; what the object raises is recorded."""
        refusal = undeclared(query, self._ops, self._features)
        if refusal is not None:
            return refusal
        try:
            outcome = self._answer(query)
        except Exception as error:  # noqa: BLE001 - a candidate's failure is recorded, the run goes on
            return Errored(describe(error))
        if isinstance(outcome, Result):
            return _checked(query, outcome)
        if isinstance(outcome, Skipped | Errored):
            return outcome
        return Errored(f"found {outcome!r:.80} as an answer, expected a Result, Skipped or Errored")


def find_factory(target: str) -> Callable[[], object]:
    """Import a module, from the current folder too as Python itself does, and return its factory.

    Raises
    ------
    FactoryError
    """
    module_name, colon, factory_name = target.partition(":")
    if not (module_name and colon and factory_name):
        raise FactoryError(f"found {MODULE_PREFIX}{target}, expected {MODULE_PREFIX}package.module:factory")
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.insert(0, here)
    try:
        factory = getattr(import_module(module_name), factory_name)
    except Exception as error:
        raise FactoryError(f"{MODULE_PREFIX}{target}: {describe(error)}") from error
    if not callable(factory):
        raise FactoryError(f"{MODULE_PREFIX}{target}: found {factory!r:.80}, expected something to call")
    made: Callable[[], object] = factory
    return made


def _make(target: str) -> Any:
    factory = find_factory(target)
    try:
        return factory()
    except Exception as error:
        raise FactoryError(f"{MODULE_PREFIX}{target}: {describe(error)}") from error


def _checked(query: Query, result: Result) -> Outcome:
    """Read a result as one that came from a process: every field there, of its kind, floats float32."""
    try:
        return Result(normalise(query.op, _lists(result.fields)))
    except FieldError as error:
        where = f"result.{error.path}" if error.path else "result"
        return Errored(str(BadReplyError(f"{error.found} at {where}", error.expected)))


def _lists(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _lists(item) for key, item in value.items()}
    return [_lists(item) for item in value] if isinstance(value, list | tuple) else value
