"""What the short keys of a walk's ticks are called where people read them."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

TICK_NAMES: Final[Mapping[str, str]] = MappingProxyType(
    {
        "r": "outcome",
        "t": "trace",
        "pos": "position",
        "rot": "rotation",
        "cp": "contact_plane",
        "cp_cell": "contact_plane_cell",
        "onw": "on_walkable",
        "sn": "sliding_normal",
        "cn": "collision_normal",
        "fsf": "frames_stationary_fall",
        "env": "collided_with_environment",
        "objs": "collide_objects",
        "kill": "kill_velocity",
        "v": "velocity",
        "ts": "transient_state",
        "om": "omega",
        "cv": "cached_velocity",
        "cwe": "colliding_with_environment",
    }
)
"""By the key in FORMAT.md."""
