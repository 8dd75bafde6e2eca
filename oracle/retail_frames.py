"""Which function of retail is running: the answer is on the interpreter's stack.

A function of the port stands for one of retail if its docstring names retail's address. Parts of such
a function, inlined setters and whatever is put in their place count as the function that calls them.
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import CodeType, FrameType

OUTSIDE: Final = "outside"
"""Stands for the caller where no function of retail is running: what prepares a transition wrote."""

_PACKAGE: Final = "oracle."
_SOURCE: Final = re.compile(r"\bretail: .*\b0x[0-9A-F]{8}\b")
_SETTER_MODULES: Final = frozenset({"oracle.vector", "oracle.plane", "oracle.collision_info"})
"""Their functions change nothing but the object they belong to: who calls them is of interest."""
_SETTERS: Final = frozenset({("oracle.sphere_path", "set_walkable")})


def running(frame: FrameType) -> tuple[str, FrameType]:
    """Find the innermost function of retail above a frame, which is not looked at itself.

    Returns
    -------
    str
        Its name, or `OUTSIDE`.
    FrameType
        The outermost frame below it, which is one and the same for all that one call of a setter does.
        Without a function of retail, the outermost frame of the port.
    """
    below, above = frame, frame.f_back
    outermost: FrameType | None = None
    while above is not None:
        module = above.f_globals.get("__name__", "")
        if not module.startswith(_PACKAGE):
            outermost = outermost or below
        elif _stands_for_retail(above.f_code, module):
            return above.f_code.co_name, below
        below, above = above, above.f_back
    return OUTSIDE, outermost or below


@cache
def _stands_for_retail(code: CodeType, module: str) -> bool:
    """Tell by the docstring, which the compiler puts first among the constants."""
    if module in _SETTER_MODULES or (module, code.co_name) in _SETTERS:
        return False
    docstring = code.co_consts[0] if code.co_consts else None
    return isinstance(docstring, str) and _SOURCE.search(docstring) is not None
