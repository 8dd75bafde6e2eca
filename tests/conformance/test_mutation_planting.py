"""Mutants in the running oracle: planted, and taken out again."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

import pytest

from conformance.branches.measure import oracle_sources
from conformance.mutation.operators import plans
from conformance.mutation.planting import Seed
from conformance.mutation.run import DOCUMENTS
from oracle.bsp_tree import BSPTree
from oracle.transition_step import step_down
from oracle.vector import Vector3

if TYPE_CHECKING:
    from conformance.mutation.operators import Plan

FILES = ("vector.py", "transition_step.py", "bsp_tree.py", "cell_array.py", "plane.py", "land_cell.py")


@pytest.fixture(scope="module")
def mutants() -> list[Plan]:
    """Make the mutants of a few modules."""
    sources = {file: oracle_sources()[file] for file in FILES}
    return list(plans(sources, DOCUMENTS))


def seed_of(mutants: list[Plan], site: str, before: str) -> Seed:
    """Return the first mutant of a function that changes an expression."""
    return Seed(next(plan for plan in mutants if plan.mutant.site == site and plan.mutant.before == before))


def _fail_unless(retail: bool) -> None:
    if not retail:
        raise ZeroDivisionError


def test_a_planted_mutant_runs_instead_of_retail(mutants: list[Plan]) -> None:
    """A vector whose x differs by EPS and a bit becomes equal to one that differs."""
    seed = seed_of(mutants, "vector.Vector3.differs", "abs(self.x - other.x) > EPS")
    a, b = Vector3(0.0, 0.0, 0.0), Vector3(0.00019999999494757503, 0.0, 0.0)
    assert not a.differs(b)
    with seed.planted():
        assert a.differs(b)
    assert not a.differs(b)


def test_it_is_taken_out_whatever_happens(mutants: list[Plan]) -> None:
    """Also after an error."""
    retail = Vector3.differs.__code__
    seed = seed_of(mutants, "vector.Vector3.differs", "abs(self.x - other.x) > EPS")
    with pytest.raises(ZeroDivisionError), seed.planted():
        _fail_unless(Vector3.differs.__code__ is retail)
    assert Vector3.differs.__code__ is retail


def test_the_source_is_as_it_was(mutants: list[Plan]) -> None:
    """Making a mutant leaves the tree that the others are made from unchanged."""
    plan = mutants[0]
    written = ast.dump(plan.tree)
    assert Seed(plan).code
    assert ast.dump(plan.tree) == written


def test_methods_bound_elsewhere_and_decorated_ones_are_found(mutants: list[Plan]) -> None:
    """A function of a module that a class takes over is one function; a decorator is looked through."""
    sites = {plan.mutant.site: plan for plan in mutants}
    assert Seed(sites["transition_step.step_down"]).function is step_down
    found = Seed(sites["bsp_tree.BSPTree.find_collisions"]).function
    assert found is BSPTree.find_collisions.__wrapped__  # type: ignore[attr-defined]


def test_static_methods_are_found(mutants: list[Plan]) -> None:
    """The function below the wrapper is what is exchanged."""
    plan = next(plan for plan in mutants if plan.mutant.site == "plane.Plane.localtoglobal")
    assert Seed(plan).function.__qualname__ == "Plane.localtoglobal"


def test_every_mutant_compiles(mutants: list[Plan]) -> None:
    """And keeps the variables that the function closes over, `super()`'s too where it is what is left out."""
    for plan in mutants:
        seed = Seed(plan)
        assert seed.code.co_freevars == seed.function.__code__.co_freevars, str(plan.mutant)
