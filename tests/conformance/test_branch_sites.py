"""The branches of a module are told by their conditions, as coverage.py's arcs lead to them."""

from __future__ import annotations

import pytest

from conformance.branches.sites import UnknownBranchError, functions_of

SOURCE = '''
class Mover:
    def step(self, n):
        """Step.

        retail: Mover::step 0x00512345, 05 TI-1…3.
        """
        if (
            n > 0
            and self.up
        ):
            n = 1
        for i in range(n):
            if n > 3:
                continue
            while n:
                n -= 1
        if n > 3:
            return 1
        def inner(x):
            if x:
                return 2
        return inner


def helper():
    return 0
'''


def test_every_function_has_its_conditions() -> None:
    """Both ways of each, in the order of the source; those of an inner function are its own."""
    functions = functions_of(SOURCE)
    assert list(functions) == ["Mover.step", "Mover.step.inner", "helper"]
    assert [branch.key for branch in functions["Mover.step"].branches] == [
        "if n > 0 and self.up: true",
        "if n > 0 and self.up: false",
        "for i in range(n): an item",
        "for i in range(n): no item left",
        "if n > 3: true",
        "if n > 3: false",
        "while n: true",
        "while n: false",
        "if n > 3 #2: true",
        "if n > 3 #2: false",
    ]
    assert [branch.key for branch in functions["Mover.step.inner"].branches] == ["if x: true", "if x: false"]
    assert functions["helper"].branches == ()


def test_the_document_is_the_one_cited() -> None:
    """Helpers count where most of their module is specified."""
    documents = {name: function.document for name, function in functions_of(SOURCE).items()}
    assert documents == {"Mover.step": "05", "Mover.step.inner": "05", "helper": "05"}
    assert functions_of("def f(): pass")["f"].document == ""


@pytest.mark.parametrize(
    ("line", "target", "key"),
    [
        (8, 12, "if n > 0 and self.up: true"),
        (8, 13, "if n > 0 and self.up: false"),
        (13, 14, "for i in range(n): an item"),
        (13, 18, "for i in range(n): no item left"),
        (14, 15, "if n > 3: true"),
        (16, 13, "while n: false"),
        (18, -3, "if n > 3 #2: false"),
    ],
)
def test_an_arc_is_a_way_of_its_condition(line: int, target: int, key: str) -> None:
    """The line after the condition decides; a negative one leaves the function."""
    assert functions_of(SOURCE)["Mover.step"].taken(line, target).key == key


def test_an_arc_from_elsewhere_is_refused() -> None:
    """A line without a condition cannot branch: the source is another one."""
    with pytest.raises(UnknownBranchError, match="step has no condition in line 12"):
        functions_of(SOURCE)["Mover.step"].taken(12, 13)


def test_reformatting_changes_no_key() -> None:
    """A condition is told by its text in one line, without redundant parentheses."""
    one_line = SOURCE.replace("(\n            n > 0\n            and self.up\n        )", "n > 0 and self.up")
    assert one_line != SOURCE
    keys = [[b.key for b in functions_of(text)["Mover.step"].branches] for text in (SOURCE, one_line)]
    assert keys[0] == keys[1]
