"""The steps that retail took, as an indented list."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.life.steps_taken import Step

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from conformance.life.explanation import Citations
    from conformance.life.steps_taken import Item, RetailCall

_INDENT: Final = "  "
_CITED: Final = "* "
_LABEL_WIDTH: Final = 8


def step_lines(items: Iterable[Item], cited: Citations, depth: int | None = None) -> Iterator[str]:
    """Write calls of retail and the steps in them, one a line.

    What is done again and again in the same way is written once. Calls in which no step begins are left out,
    unless the case cites them.

    Parameters
    ----------
    items : iterable of Step or RetailCall
        What was done, in order.
    cited : Citations
        What the case cites; its lines begin with a star.
    depth : int, optional
        How many levels of calls to show; all without it.
    """
    for block in _blocks(items, cited, "", 0, depth):
        yield from block


def _blocks(
    items: Iterable[Item], cited: Citations, function: str, level: int, depth: int | None
) -> Iterator[list[str]]:
    """Yield the lines of each item, those of equal neighbours once."""
    last: list[str] = []
    times = 0
    for item in items:
        block = list(_block(item, cited, function, level, depth))
        if not block:
            continue
        if block == last:
            times += 1
            continue
        yield _times(last, times)
        last, times = block, 1
    yield _times(last, times)


def _times(block: list[str], times: int) -> list[str]:
    return block if times < 2 else [f"{block[0]}  ({times} times)", *block[1:]]


def _block(item: Item, cited: Citations, function: str, level: int, depth: int | None) -> Iterator[str]:
    if isinstance(item, Step):
        label = item.statement.label
        star = _CITED if cited.has_step(function, label) else _INDENT
        yield f"{star}{_INDENT * level}{label:<{_LABEL_WIDTH}} {_words(item)}"
    elif (item.has_steps or cited.has_function(item.function)) and (depth is None or level < depth):
        star = _CITED if cited.has_function(item.function) else _INDENT
        yield f"{star}{_INDENT * level}{_heading(item)}"
        if depth is None or level + 1 < depth:
            for block in _blocks(item.items, cited, item.function, level + 1, depth):
                yield from block


def _words(step: Step) -> str:
    statement = step.statement
    decided = "" if step.holds is None or statement.is_loop else f": {'yes' if step.holds else 'no'}"
    remark = f"  ({statement.remark})" if statement.remark else ""
    return f"{statement.text}{decided}{remark}"


def _heading(call: RetailCall) -> str:
    where = f" ({call.specified})" if call.specified else ""
    returned = f" -> {call.returned}" if call.returned else ""
    return f"{call.function}{where}{returned}"
