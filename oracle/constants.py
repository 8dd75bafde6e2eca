"""Retail's constants, with unit and source. No formula of the port holds a bare threshold."""

from __future__ import annotations

from typing import Final

EPS: Final = 0.00019999999494757503
"""F_EPSILON, float32 0x3951B717; metres, or a pure number (NM-8)."""
EPS5: Final = EPS * 5.0
"""Tolerance of a valid quaternion's squared length (NM-8)."""
EPS2: Final = EPS * EPS
"""Smallest squared offset of a sub-step, square metres; exact product, not rounded (04, 0.2)."""
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
LEAST_WALK_INTERP: Final = -0.5
"""How far below the start a sphere may be put back onto a plane; fraction of the movement (02, AS-4)."""
CELL_EDGE: Final = 24.0
"""Edge of a land cell, metres."""
HALF_CELL_EDGE: Final = 12.0
"""Half an edge of a land cell, float32; metres (10 1)."""
BLOCK_EDGE: Final = 192.0
"""Edge of a landblock, metres."""
DEGREES_PER_RADIAN: Final = 57.29577951308232
"""180/pi as the headings use it, a double (01, 4.8)."""
RADIANS_PER_DEGREE: Final = 0.0174532925199433
"""pi/180 as the headings use it, a double with the literal's digits (01, 4.8)."""
HEADING_TURN: Final = 450.0
"""What a heading (from north, clockwise) and an angle (from east) add up to, degrees (01, 4.8)."""
FULL_TURN: Final = 360.0
"""A full turn, degrees."""
WALK_INTERP_LOWEST: Final = -0.1
"""Least walk interpolation that a step down accepts on terrain; fraction of a step (04 VW-23, 07 0.2)."""
DEFAULT_STEP: Final = 0.009999999776482582
"""Step height of parts without a setup, float32 of 0.01; metres (04, 0.2)."""
RING_REACH: Final = 4.0
"""How far out a placement is tried; metres (05 PP-2)."""
SMALL_RING_REACH: Final = 2.0
"""The same for a mover thinner than `SMALL_RADIUS`; metres (05 PP-2)."""
SMALL_RADIUS: Final = 0.125
"""Radius below which a placement tries the small reach; metres (05 PP-2)."""
RING_RADIUS: Final = 0.47999998927116394
"""Least radius, float32 of 0.48, that spaces the rings of other movers; metres (05 PP-2)."""
RING_PI: Final = 3.1415998935699463
"""Pi as the placement rings have it, float32 of 3.1416 (05 PP-4)."""
FULL_CIRCLE: Final = 360.0
"""Degrees."""
ADJUST_TRIES: Final = 15
"""Positions that adjust_to_plane tries, both of its loops together (03, AT-4 and AT-6)."""
PLACEMENT_TRIES: Final = 20
"""Times that a placement pushes the spheres before it gives up (03, PI-7)."""
GRAVITY: Final = -9.800000190734863
"""Vertical acceleration in the air, float32 of -9.8; metres per second squared (04, 0.2)."""
MIN_QUANTUM: Final = 1.0 / 30.0
"""Least time between two simulated frames, a double; seconds (06 UT-3, QT-7)."""
MAX_QUANTUM: Final = 0.2
"""Longest tick, a double; seconds (06 QT-6, QT-7)."""
HUGE_QUANTUM: Final = 2.0
"""Time that is dropped rather than simulated, if longer; seconds (06 QT-5)."""
MAX_VELOCITY: Final = 50.0
"""Highest speed, metres per second (06 PH-3, SV-1)."""
MAX_VELOCITY2: Final = 2500.0
"""Its square (06 PH-3)."""
LEAST_VELOCITY2: Final = 0.0625
"""Squared speed below which an object stops, square metres per second squared (06 PH-5)."""
FRICTION_LIMIT: Final = 0.25
"""Speed away from the contact plane from which there is no friction, metres per second (06 CF-2)."""
SLED_SLOW2: Final = 1.5625
"""Squared speed below which a sled stops at once, square metres per second squared (06 CF-4)."""
SLED_FAST2: Final = 6.25
"""Squared speed from which a sled glides on slopes, square metres per second squared (06 CF-4)."""
SLED_SLOPE: Final = 0.1745329251994329
"""Slope from which a sled glides, radians; a double, about 10 degrees (06 CF-4)."""
SLED_FRICTION: Final = 0.20000000298023224
"""Friction of a gliding sled, float32 of 0.2; fraction of the speed lost in a second (06 CF-4)."""
DEFAULT_FRICTION: Final = 0.949999988079071
"""Friction of a new object, float32 of 0.95; fraction of the speed lost in a second (04, 0.2)."""
DEFAULT_ELASTICITY: Final = 0.05000000074505806
"""Elasticity of a new object, float32 of 0.05; fraction of the speed given back (04, 0.2)."""
MAX_ELASTICITY: Final = 0.10000000149011612
"""Highest elasticity, float32 of 0.1 (06, 1)."""
DUMMY_RADIUS: Final = 0.10000000149011612
"""Radius and height of the sphere of an object without spheres, float32 of 0.1; metres (04, 0.2)."""
ACTIVE_DISTANCE: Final = 96.0
"""Distance from the player beyond which an object rests, metres (06 QT-2)."""
COLLISION_MEMORY: Final = 1.0
"""How long a touched object is remembered, seconds (06 HC-3)."""
ETHEREAL_MEMORY: Final = 0.0
"""The same for an ethereal one (06 HC-3)."""
PLACEMENT_SLACK: Final = 0.05000000074505806
"""How far a placement that may not slide can move, float32 of 0.05; metres (06 SP-5)."""
