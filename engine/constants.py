"""Retail's constants and enumerations, with unit and source. No kernel holds a bare threshold."""

from __future__ import annotations

import math
from typing import Final, cast

import numpy as np


def frozen(value: int) -> int:
    """Return a NumPy integer: for a Python one, Numba compiles every callee anew, as for a literal."""
    return cast("int", np.int64(value))


EPS: Final = 0.00019999999494757503
"""F_EPSILON, float32 0x3951B717; metres, or a pure number (NM-8)."""
EPS5: Final = EPS * 5.0
"""Tolerance of a valid quaternion's squared length (NM-8)."""
EPS2: Final = EPS * EPS
"""Smallest squared offset of a sub-step, square metres; exact product (04, 0.2)."""
WHOLE: Final = 2.0**52
"""From here on every double is a whole number, and soon larger than integers are."""
MAX_STEPS: Final = 200_000
"""Steps of a move, where retail has no bound: a human (radius 0.48 m) crosses the whole map, 49 km, by its
diagonal in 145,000."""
SPECK: Final = 9.999999747378752e-05
"""Smallest radius of what is put down, metres, a float32: it has some 1e9 positions to try."""
CELL_SLACK: Final = 0.009999999776482582
"""Enlargement of a sphere tested against a cell, float32 0x3C23D70A; metres (NM-8)."""
Z_LANDING: Final = 0.08715569972991943
"""Smallest normal z one can land on, float32 0x3DB27EB0; cosine of 85 degrees (NM-8)."""
FLOOR_Z: Final = 0.6641741394996643
"""Smallest normal z one can walk on, float32 0x3F2A0751 (NM-8)."""
SMALL_STEP: Final = 0.03999999910593033
"""Step height when not on a walkable, float32 of 0.04; metres (04, 0.2)."""
ADJUST_BRACKET: Final = 0.02
"""Width at which adjust_to_plane stops bisecting; fraction of the movement (AT-6)."""
ADJUST_TRIES: Final = 15
"""Tries of adjust_to_plane, both of its loops together (AT-4, AT-6)."""
PLACEMENT_TRIES: Final = 20
"""Pushes of placement_insert before it gives up (PI-7)."""
WALK_INTERP_FLOOR: Final = -0.5
"""How far beyond the whole step adjust_sphere_to_plane may undo (AS-4)."""
LEAST_WALK_INTERP: Final = -0.1
"""The same for standing on a sphere, a cylinder or terrain; a float64 (07, 0.2)."""
BLOCK_STEP: Final = 24.0
"""Edge of a land cell, and metres of one unit of a landblock coordinate (01, 5.1; 10, 1)."""
FIRST_INDOOR: Final = 0x100
"""Smallest low word of an environment cell's id (09)."""

RING_LENGTH: Final = 4.0
"""How far find_placement_pos searches, metres (PP-2)."""
SMALL_RING_LENGTH: Final = 2.0
"""The same for a sphere smaller than `SMALL_RADIUS`, metres (PP-2)."""
SMALL_RADIUS: Final = 0.125
"""Radius below which the search is halved, metres (PP-2)."""
RING_RADIUS: Final = 0.47999998927116394
"""Smallest radius that the rings are spaced by, float32 of 0.48; metres (PP-2)."""
RING_PI: Final = 3.1415998935699463
"""Retail's pi in the ring spacing, float32 of 3.1416 (PP-4)."""
DEGREE: Final = 0.0174532925199433
"""Radians in a degree, as retail writes it (01, 4.8)."""
RADIAN: Final = 57.29577951308232
"""Degrees in a radian, as retail writes it (01, 4.8)."""

# TransitionState (04, 1.1), and one answer of the engine's own.
INVALID: Final = frozen(0)
OK: Final = frozen(1)
COLLIDED: Final = frozen(2)
ADJUSTED: Final = frozen(3)
SLID: Final = frozen(4)
NEEDS_STEP_UP: Final = frozen(5)
"""Path 5 struck something: the caller has to run CTransition::step_up on the requested normal."""

STATE_NAMES: Final = ("INVALID", "OK", "COLLIDED", "ADJUSTED", "SLID")

# SPHEREPATH::InsertType (04, 1.2).
TRANSITION_INSERT: Final = frozen(0)
PLACEMENT_INSERT: Final = frozen(1)
INITIAL_PLACEMENT_INSERT: Final = frozen(2)

# How often an insert is tried (05).
TRANSITION_ATTEMPTS: Final = frozen(3)
STEP_ATTEMPTS: Final = frozen(5)
PROBE_ATTEMPTS: Final = frozen(1)

# ObjectInfo state bits (04, 1.3).
CONTACT: Final = frozen(0x1)
ON_WALKABLE: Final = frozen(0x2)
IS_VIEWER: Final = frozen(0x4)
PATH_CLIPPED: Final = frozen(0x8)
FREE_ROTATE: Final = frozen(0x10)
PERFECT_CLIP: Final = frozen(0x40)
IS_IMPENETRABLE: Final = frozen(0x80)
IS_PLAYER: Final = frozen(0x100)
EDGE_SLIDE: Final = frozen(0x200)
IGNORE_CREATURES: Final = frozen(0x400)
IS_PK: Final = frozen(0x800)
IS_PKLITE: Final = frozen(0x1000)

# PhysicsState bits of an obstacle (08, 1).
STATIC: Final = frozen(0x1)
ETHEREAL: Final = frozen(0x4)
IGNORE_COLLISIONS: Final = frozen(0x10)
MISSILE: Final = frozen(0x40)
PARTICLE_EMITTER: Final = frozen(0x1000)
HAS_PHYSICS_BSP: Final = frozen(0x10000)

# What a single call of obstacles tests; the engine's own.
TARGET_FIRST_SHAPE: Final = frozen(0)
"""An object's first shape alone, whatever exempts the mover from the object."""
TARGET_OBJECT: Final = frozen(1)
"""One object."""
TARGET_OBJECTS: Final = frozen(2)
"""All objects of a cell."""
TARGET_CELL: Final = frozen(3)
"""A cell's environment, then its objects."""
TARGET_ENTRY: Final = frozen(4)
"""Nothing: whether the mover may enter a cell."""

# What an obstacle's game object answers (08, 1).
WEENIE_PRESENT: Final = frozen(0x1)
WEENIE_CREATURE: Final = frozen(0x2)
WEENIE_PLAYER: Final = frozen(0x4)
WEENIE_PK: Final = frozen(0x8)
WEENIE_PKLITE: Final = frozen(0x10)
WEENIE_IMPENETRABLE: Final = frozen(0x20)

# Water types of land cells and blocks, and how deep one sinks in (10, 6).
NOT_WATER: Final = frozen(0)
PARTIALLY_WATER: Final = frozen(1)
ENTIRELY_WATER: Final = frozen(2)
DEEP_WATER: Final = 0.8999999761581421
"""In a land cell that is all water, float32 of 0.9; metres (10, 6.4)."""
SHALLOW_WATER: Final = 0.44999998807907104
"""Near a corner that is water, of a land cell with a shore, float32 of 0.45; metres (10, 6.5)."""
WET_LAND: Final = 0.10000000149011612
"""Near a corner that is land, of such a cell, float32 of 0.1; metres (10, 6.5)."""
HALF_CELL: Final = 12.0
"""Half the edge of a land cell, metres (10, 1)."""

# BoundingType (01, 7).
OUTSIDE: Final = frozen(0)
PARTIALLY_INSIDE: Final = frozen(1)
ENTIRELY_INSIDE: Final = frozen(2)

# The tick (06): limits.
GRAVITY: Final = -9.800000190734863
"""Acceleration of what falls, float32 of -9.8; metres per second squared (06, 5)."""
MAX_VELOCITY: Final = 50.0
"""Highest speed, metres per second (PH-3, SV-1)."""
MAX_VELOCITY2: Final = MAX_VELOCITY * MAX_VELOCITY
"""Its square (PH-3)."""
LEAST_VELOCITY2: Final = 0.0625
"""Square of the speed below which an object stops, metres per second (PH-5)."""
FRICTION_LIMIT: Final = 0.25
"""Speed away from the ground at which it brakes no more, metres per second (CF-2)."""
SLED_SLOW2: Final = 1.5625
"""Square of the speed below which a sled stops, metres per second (CF-4)."""
SLED_FAST2: Final = 6.25
"""Square of the speed from which a sled glides down a slope, metres per second (CF-4)."""
SLED_SLOPE_Z: Final = math.cos(0.1745329251994329)
"""Normal z of that slope, ten degrees (CF-4)."""
SLED_FRICTION: Final = 0.20000000298023224
"""Friction of a gliding sled, float32 of 0.2 (CF-4)."""
DEFAULT_FRICTION: Final = 0.949999988079071
"""Part of its speed that an object loses in a second of sliding, float32 of 0.95 (06, 1)."""
DEFAULT_ELASTICITY: Final = 0.05000000074505806
"""Part of its speed that an object keeps in a bounce, float32 of 0.05 (06, 1)."""
PLACEMENT_SLACK: Final = 0.05000000074505806
"""How far to the east or north a body may be put that must not slide, float32 of 0.05; metres (SP-5)."""
MAX_ELASTICITY: Final = 0.10000000149011612
"""Largest part of its speed that an object keeps in a bounce, float32 of 0.1 (06, 1)."""
DUMMY_RADIUS: Final = 0.10000000149011612
"""Radius, and height of the centre, of a mover without spheres, float32 of 0.1; metres (SEED-4)."""
MIN_QUANTUM: Final = 1.0 / 30.0
"""Shortest time between simulated frames, seconds (UT-3)."""
MAX_QUANTUM: Final = 0.2
"""Longest tick, seconds (QT-6)."""
HUGE_QUANTUM: Final = 2.0
"""Longest time that is simulated; more is dropped, seconds (QT-5)."""
ACTIVE_DISTANCE: Final = 96.0
"""Distance from the player beyond which objects rest, metres (QT-2)."""
COLLISION_MEMORY: Final = 1.0
"""How long a touched object is remembered, seconds (HC-3)."""
ETHEREAL_MEMORY: Final = 0.0
"""The same for an ethereal one (HC-3)."""
LAND_WIDTH: Final = frozen(2040)
"""Cells along an edge of the land, 255 blocks of 8 (10, 1)."""
BLOCK_EDGE: Final = 192.0
"""Edge of a landblock, metres (10, 1)."""

# PhysicsState bits of a mover (04, 1.5; 08, 1), besides those of an obstacle above.
REPORT_COLLISIONS_PS: Final = frozen(0x8)
ALIGNPATH_PS: Final = frozen(0x100)
GRAVITY_PS: Final = frozen(0x400)
HIDDEN_PS: Final = frozen(0x4000)
INELASTIC_PS: Final = frozen(0x20000)
COLLIDES_AS_ENVIRONMENT_PS: Final = frozen(0x200000)
EDGE_SLIDE_PS: Final = frozen(0x400000)
SLEDDING_PS: Final = frozen(0x800000)
FROZEN_PS: Final = frozen(0x1000000)
FLIGHT_PS: Final = frozen(0x340)
"""What a missile loses when it hits something: missile, align path, path clipped (06, 7)."""
DEFAULT_STATE: Final = 0x400C08
"""PhysicsState of a new object: edge slide, 0x800, gravity, report collisions (06, 1)."""

# Bits of a body's transient state (04, 1.4).
CONTACT_TS: Final = frozen(0x1)
ON_WALKABLE_TS: Final = frozen(0x2)
SLIDING_TS: Final = frozen(0x4)
WATER_CONTACT_TS: Final = frozen(0x8)
STATIONARY_FALL_TS: Final = frozen(0x10)
STATIONARY_STOP_TS: Final = frozen(0x20)
STATIONARY_STUCK_TS: Final = frozen(0x40)
STATIONARY_TS: Final = frozen(0x70)
"""All that count ticks without movement (HC-6)."""
ACTIVE_TS: Final = frozen(0x80)
CHECK_ETHEREAL_TS: Final = frozen(0x100)

# The broad phase (`engine.kernels.broad` derives them); the engine's own.
BOUND_SLACK: Final = 0.03
"""What bounds are enlarged by, metres: sqrt(EPS) of nearly touching spheres, CELL_SLACK, and unit vectors."""
BOUND_ROUNDING: Final = 2.0**-15
"""The same for roundings, as a part of a coordinate: 512 stores to float32."""
BOUND_TILT: Final = 0.0025
"""How much a matrix may stretch whose quaternion is of unit length within EPS5, as a part of a length."""
BOUND_CORNER: Final = 1.4143
"""How far a sphere's centre may be from a cylinder that it overlaps, as a part of its radius: the root of 2,
and more. Retail compares the level distance and the upright one, each with the radius (07 10.1)."""
BOUND_MOST: Final = 2.0**14
"""Greatest coordinate, or radius, of geometry that has bounds, metres: float32 counts by 1 mm there."""
UP_SLACK: Final = 2.0**-10
"""How far, all three coordinates together, an up may be from the one that slopes have been measured along."""
GATE_LEAST: Final = 0.0625
"""Radius of the smallest sphere that may walk without bounding spheres, metres: it is hundreds of EPS."""
GATE_MOST: Final = 4.0
"""Radius of the largest one, metres: a human's is 0.48."""
LATTICE_REACH: Final = 0.5
"""Radius of the largest sphere for which cubes know what is near, metres: a human's is 0.48."""
GATE_WAY: Final = 2.0**20
"""Longest movement, metres: back along it no sphere gets where float32 ends."""
FLIGHT_STEPS: Final = 64.0
"""Most sub-steps that are bounded together."""
UNBOUNDED: Final = math.inf
"""Radius of a ball about what is not bounded: every ball reaches it."""
