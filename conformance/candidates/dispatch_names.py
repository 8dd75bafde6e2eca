"""The paths of a BSP call: the letter that a trace has for each, and the name that records have."""

from __future__ import annotations

from typing import Final

DISPATCH_NAMES: Final = {
    "I": "initial_placement",
    "P": "placement",
    "W": "check_walkable",
    "D": "step_down",
    "L": "collide",
    "K": "contact",
    "M": "path_clipped",
    "A": "airborne",
}
"""Name by letter, as in FORMAT.md."""
