"""Which function of retail is running: the answer is on the interpreter's stack.

A kernel stands for a function of retail if the source in its docstring begins with that function's name
and address. Parts of such a function, whose source begins with a step, count as the function that calls
them, and so do setters.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import CodeType, FrameType

OUTSIDE: Final = "outside"
"""Stands for the caller where no function of retail is running: what asks the query wrote."""

_PACKAGE: Final = "engine.kernels."
_SOURCE: Final = re.compile(r"\bretail: (?:\w+::)+([^\s(]+) 0x[0-9A-F]{8}\b")
_SETTER_MODULES: Final = frozenset({"engine.kernels.vector", "engine.kernels.collision_info"})
"""Their kernels only write what they are given: who calls them is of interest."""
_SETTERS: Final = frozenset({"set_walkable"})
"""Kernels of other modules that do the same."""


def statement_of(frame: FrameType) -> FrameType:
    """Return the frame that is one and the same for all that one statement writes.

    It is the outermost setter's or, where nothing but the statement itself writes, the given one, which
    is that of the statement's hook.
    """
    statement = frame
    above = frame.f_back
    while above is not None and _is_setter(above):
        statement, above = above, above.f_back
    return statement


def running(frame: FrameType) -> str:
    """Name the innermost function of retail above a frame, or `OUTSIDE`."""
    above = frame.f_back
    while above is not None:
        name = None if _is_setter(above) else _retail_name(above.f_code, _module(above))
        if name is not None:
            return name
        above = above.f_back
    return OUTSIDE


def _module(frame: FrameType) -> str:
    module: str = frame.f_globals.get("__name__", "")
    return module


def _is_setter(frame: FrameType) -> bool:
    module = _module(frame)
    return module in _SETTER_MODULES or (module.startswith(_PACKAGE) and frame.f_code.co_name in _SETTERS)


@cache
def _retail_name(code: CodeType, module: str) -> str | None:
    """Read the docstring, which the compiler puts first among the constants."""
    docstring = code.co_consts[0] if module.startswith(_PACKAGE) and code.co_consts else None
    found = _SOURCE.search(docstring) if isinstance(docstring, str) else None
    return found and found[1]
