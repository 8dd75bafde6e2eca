"""The mistakes that are planted in the oracle, one kind at a time."""

from __future__ import annotations

import ast

import pytest

from conformance.branches.measure import oracle_sources
from conformance.mutation.facts import facts_of, signatures_of
from conformance.mutation.mutant import Operator
from conformance.mutation.operators import OPERATORS, plans
from conformance.mutation.places import places_of
from conformance.mutation.run import DOCUMENTS
from oracle import constants, enums

SIGNATURES = {"far": ("Vector3", "Vector3", "float"), "dot_x": ("Vector3", "Vector3")}


def mistakes(operator: Operator, body: str) -> list[tuple[str, str]]:
    """Return what one kind of mistake makes of a function's body: what is written, and what instead."""
    (function,) = ast.parse(f"def f(a, b, c, node):\n    {body}").body
    assert isinstance(function, ast.FunctionDef)
    facts = facts_of(function, {**vars(constants), **vars(enums)}, SIGNATURES)
    found: list[tuple[str, str]] = []
    for place in places_of(function):
        others = OPERATORS[operator](place, facts)
        found += [
            (ast.unparse(place.node), ast.unparse(ast.fix_missing_locations(other))) for other in others
        ]
    return found


@pytest.mark.parametrize(
    ("written", "instead"),
    [("a < b", "a <= b"), ("a >= b", "a > b"), ("a == b", "a != b"), ("a is not None", "a is None")],
)
def test_a_limit_changes_sides(written: str, instead: str) -> None:
    """What has no order becomes its opposite."""
    assert mistakes(Operator.COMPARISON, f"return {written}") == [(written, instead)]


def test_each_limit_of_a_chain_changes_alone() -> None:
    """A chained comparison has two."""
    after = [instead for _, instead in mistakes(Operator.COMPARISON, "return 0.0 <= a <= b")]
    assert after == ["0.0 < a <= b", "0.0 <= a < b"]


def test_conditions_and_their_parts_are_negated() -> None:
    """A negation that is there is taken away."""
    assert mistakes(Operator.CONDITION, "return 1 if a and not b else 0") == [
        ("a and (not b)", "not (a and (not b))"),
        ("a", "not a"),
        ("not b", "b"),
    ]


def test_a_connective_becomes_the_other() -> None:
    """All of its conditions stay."""
    assert mistakes(Operator.CONNECTIVE, "return a and b and c") == [("a and b and c", "a or b or c")]


def test_a_rounding_is_left_out() -> None:
    """The register that it rounds stays."""
    assert mistakes(Operator.ROUNDING, "return f32(a * b)") == [("f32(a * b)", "a * b")]


@pytest.mark.parametrize(
    ("written", "instead"),
    [
        ("a + b + c", ["a + (b + c)", "a + c + b"]),
        ("a - b - c", ["a - (b + c)", "a - c - b"]),
        ("a + b - c", ["a + (b - c)", "a - c + b"]),
        ("a - b + c", ["a - (b - c)", "a + c - b"]),
        ("a - (b - c)", ["a - b + c", "a + c - b"]),
        ("a + (b - c)", ["a + b - c", "a - c + b"]),
    ],
)
def test_three_terms_are_added_in_the_other_orders(written: str, instead: list[str]) -> None:
    """Each is the same number, but for the rounding."""
    found = mistakes(Operator.ASSOCIATION, f"return {written}")
    assert [after for before, after in found if before == written] == instead
    values = {"a": 7, "b": 4, "c": 2}
    assert {eval(after, values) for _, after in found} == {eval(written, values)}  # noqa: S307 - sums from above


def test_signs_and_operands() -> None:
    """Of an absolute difference the order of the operands does not matter, so it stays."""
    assert mistakes(Operator.SIGN, "return -a + b") == [("-a + b", "-a - b"), ("-a", "a")]
    assert mistakes(Operator.OPERANDS, "return a - b") == [("a - b", "b - a")]
    assert mistakes(Operator.OPERANDS, "return abs(a - b)") == []


def test_constants_have_the_neighbours_of_their_format() -> None:
    """EPS is a float32, 0.02 a double; zero has no neighbour that says something, so it becomes one."""
    eps = ["0.00020000000949949026", "0.0001999999803956598"]
    assert [after for _, after in mistakes(Operator.CONSTANT, "return a < EPS")] == eps
    assert mistakes(Operator.CONSTANT, "return a * 0.02")[0] == ("0.02", "0.020000000000000004")
    assert mistakes(Operator.CONSTANT, "return a * 0.0") == [("0.0", "1.0")]


def test_counts_move_and_flags_flip() -> None:
    """A 0 or 1 that is returned or stored is a flag, elsewhere it counts."""
    assert mistakes(Operator.CONSTANT, "return 1") == [("1", "0")]
    assert [after for _, after in mistakes(Operator.CONSTANT, "return a > 1")] == ["2", "0"]
    assert [after for _, after in mistakes(Operator.CONSTANT, "return range(1)")] == ["2", "0"]


def test_states_and_bits_become_others_of_their_kind() -> None:
    """A local name that is called like a bit is none."""
    assert mistakes(Operator.STATE, "return TransitionState.OK") == [
        ("TransitionState.OK", "TransitionState.COLLIDED")
    ]
    assert mistakes(Operator.STATE, "return a & CONTACT_OI") == [("CONTACT_OI", "2")]
    assert mistakes(Operator.STATE, "CONTACT_OI = 1; return CONTACT_OI") == []


def test_children_and_arguments_change_places() -> None:
    """Arguments only where both have the same type and the order matters."""
    assert mistakes(Operator.CHILDREN, "return node.pos_node") == [("node.pos_node", "node.neg_node")]
    assert mistakes(Operator.ARGUMENTS, "return far(a, b, 1.0)") == [("far(a, b, 1.0)", "far(b, a, 1.0)")]
    assert mistakes(Operator.ARGUMENTS, "return dot_x(a, b)") == []


def test_writes_calls_and_jumps_are_left_out() -> None:
    """The first value of a name stays: nothing would run without it."""
    assert mistakes(Operator.WRITE, "a.x = b") == [("a.x = b", "pass")]
    assert mistakes(Operator.WRITE, "a.clear()") == [("a.clear()", "pass")]
    assert mistakes(Operator.WRITE, "d = a") == []
    assert mistakes(Operator.WRITE, "a = b") == [("a = b", "pass")]


def test_errors_of_the_port_are_not_mutated() -> None:
    """They are not retail's."""
    assert all(not mistakes(operator, "raise ValueError(a < 1.0)") for operator in OPERATORS)


def test_parameters_of_the_same_type_are_known() -> None:
    """Of functions that share a name only what they agree on; `self` is none of them."""
    source = "class A:\n    def far(self, p: V, q: V): ...\ndef near(self: A, p: V): ...\ndef far2(p: V): ..."
    other = "def far2(p: W): ..."
    assert signatures_of({"a.py": source, "b.py": other}) == {"far": ("V", "V"), "near": ("V",)}


def test_every_mutant_is_another_one() -> None:
    """Keys tell them apart; all documents have some, and there are all kinds of mistakes."""
    mutants = [plan.mutant for plan in plans(oracle_sources(), DOCUMENTS)]
    assert len({mutant.key for mutant in mutants}) == len(mutants) > 0
    assert {mutant.operator for mutant in mutants} == set(Operator)
    assert {mutant.document for mutant in mutants} == set(DOCUMENTS)
