"""The specified functions that have no port, each with its reason.

A function that gets its port leaves this table: a test fails for a line that is no longer true, and
for a function of the specification that is neither ported nor here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

FILES: Final = "file layout, not behaviour: scenes come as plain data"
POOL: Final = "a pool of ten is not needed: every transition is new, and stale fields start at zero"
UNSPECIFIED: Final = "needs Frame::subtract2, which no document specifies; nothing in movement calls it"

NOT_PORTED: Final[Mapping[str, str]] = {
    "0x00555A90": UNSPECIFIED,  # Position::subtract2
    "0x00538650": FILES,  # CPolygon::UnPack
    "0x0053C030": FILES,  # CVertexArray::UnPack
    "0x00539830": FILES,  # BSPTREE::UnPack
    "0x0050B150": POOL,  # CTransition::makeTransition
    "0x00509DC0": POOL,  # CTransition::cleanupTransition
    "0x00531FD0": FILES,  # CLandBlockStruct::UnPack
}
"""Reason by address, in the order of the documents."""
