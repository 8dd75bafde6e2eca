"""Watches how a comparison of the oracle turns out, each time that it is made."""

from __future__ import annotations

import ast
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from conformance.mutation.mutant import Mutant, Operator
from conformance.mutation.operators import Plan
from conformance.mutation.planting import Seed
from conformance.stress.comparisons.sites import compared

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.stress.comparisons.sites import Site

_NAME = "_seen"


@contextmanager
def seen(site: Site) -> Iterator[list[bool]]:
    """Collect what a comparison says inside the block; the oracle answers as ever."""
    outcomes: list[bool] = []

    def note(outcome: bool) -> bool:
        outcomes.append(outcome)
        return outcome

    tree, place, document = compared()[site]
    assert isinstance(place.node, ast.Compare)
    watched = ast.Call(ast.Name(_NAME, ast.Load()), [place.node], [])
    where = f"{site.module}.py", site.function, document
    mutant = Mutant(*where, Operator.COMPARISON, site.text, _NAME, 1, place.node.lineno, "", place.reach)
    seed = Seed(Plan(mutant, tree, place, watched))
    function: Any = seed.function
    names: dict[str, Any] = function.__globals__
    names[_NAME] = note
    try:
        with seed.planted():
            yield outcomes
    finally:
        del names[_NAME]
