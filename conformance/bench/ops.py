"""Names of the operations that are clocked, as they stand in tables and in JSON."""

from __future__ import annotations

from typing import Final

STRIKE: Final = "strike"
STEP_DOWN: Final = "step_down"
FIND_COLLISIONS: Final = "find_collisions"
CONTACT_WALK: Final = "contact_walk"
FREE_FLIGHT: Final = "free_flight"
TICK: Final = "tick"
TOUCH: Final = "touch"

ENGINE_OPS: Final = (STRIKE, STEP_DOWN, FIND_COLLISIONS, CONTACT_WALK, FREE_FLIGHT, TICK)
"""What the engine is asked beside the oracle and beside itself, in the order of tables."""
