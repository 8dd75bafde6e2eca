"""The mover of aimed queries: a human, with two spheres and the heights of its steps."""

from __future__ import annotations

from typing import Final

RADIUS: Final = 0.48
"""Of both spheres of a human, metres."""
HUMAN: Final = ((0.0, 0.0, 0.48, RADIUS), (0.0, 0.0, 1.35, RADIUS))
MOVER: Final = {
    "spheres": HUMAN,
    "scale": 1.0,
    "step_up_height": 0.6,
    "step_down_height": 1.5,
    "ethereal": 0,
    "step_down": 1,
    "gravity": 1,
}
"""What is the same in every human; a query adds the state."""
