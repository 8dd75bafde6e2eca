"""Rotation: cells turned by quaternions that are not quite of unit length, or not quite what was meant.

Retail copies a cell's quaternion unnormalised and makes the matrix from it; only what composes rotations
normalises. How wrong may it become before a player notices?
"""

from __future__ import annotations

import math
import random
from functools import cache, partial
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.floats import to_float32
from conformance.scenes.rotations import multiply, round_quaternion
from conformance.stress.asking import ErrorSweep
from conformance.stress.effect import Effect
from conformance.stress.moves import furnished_room, room_moves, room_query
from conformance.stress.steps import stepped
from conformance.stress.sweep import Probe

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from conformance.query import Fields, Query
    from conformance.scenes.model import Quaternion, Vec3
    from conformance.stress.settings import Settings

    Turn: TypeAlias = Callable[[float, int], tuple[Quaternion, Quaternion]]
    """From severity and number of a probe to the rotation that its cell has, and the one that was meant."""

FAMILY: Final = "rotation"
MEANT: Final = round_quaternion((0.79, 0.11, -0.07, 0.6))
"""An oblique rotation: floors slope by 15 degrees."""
ORIGIN: Final[Vec3] = (90.0, 45.0, 12.0)
"""Of the turned cell, metres: in the middle of a landblock."""
LENGTHS: Final = (0.0, *(digit * 10.0**power for power in range(-7, -3) for digit in (1, 2, 4)), 4.8e-4)
"""By what share the quaternion is too long; beyond 5e-4 retail's own check of frames refuses it (01, 4.3)."""
COUNTS: Final = (1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6)
"""Compositions, and quarter turns."""
NOISE: Final = (0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
"""Float32 steps, up and down, of each part of the quaternion."""
FLOAT32_PI: Final = to_float32(math.pi)
AXIS: Final[Vec3] = (0.36, -0.48, 0.8)
"""Of the composed turns, unit length."""
TURNS: Final = 3
"""Whole turns that compositions add up to, whatever their number."""


def sweeps(settings: Settings) -> Sequence[ErrorSweep]:
    """Return the family."""
    geometry = furnished_room()
    counts = COUNTS[:-2] if settings.quick else COUNTS

    def probes(turn: Turn, severity: float) -> Iterator[Probe]:
        for number, move in enumerate(room_moves(geometry, settings.seed, settings.probes)):
            rotation, meant = turn(severity, number)
            ideal = room_query(move, geometry, rotation=meant, origin=ORIGIN)
            yield Probe(turned(ideal, rotation), Turned(rotation, meant, ideal))

    plans: Mapping[str, tuple[str, tuple[float, ...], Turn]] = {
        "length": ("share by which the quaternion is too long", LENGTHS, _too_long),
        "compositions": ("compositions, each normalised and rounded", counts, _composed),
        "quarter turns": ("quarter turns by float32 pi", COUNTS, _quarter_turned),
        "noise": ("noise in each part (float32 steps)", NOISE, partial(_noisy, settings.seed)),
    }
    return [
        ErrorSweep(FAMILY, name, axis, settings.thinned(severities), partial(probes, turn))
        for name, (axis, severities, turn) in plans.items()
    ]


def turned(query: Query, rotation: Quaternion) -> Query:
    """Return a query whose cell has another rotation, float32 and not normalised; nothing else changes."""
    (cell,) = query.inputs["cells"]
    pose = {**cell["pose"], "rotation": list(rotation)}
    inputs = {**query.inputs, "cells": [{**cell, "pose": pose}]}
    return type(query)(query.op, inputs, query.geometries, query.label)


class Turned:
    """Measures how far a rotation is from the one that was meant, and what that does to an answer.

    Parameters
    ----------
    rotation : Quaternion
        What the cell has; its length counts.
    meant : Quaternion
        What it should have.
    ideal : Query
        The question with the rotation that was meant.
    """

    def __init__(self, rotation: Quaternion, meant: Quaternion, ideal: Query) -> None:
        w, x, y, z = multiply(rotation, (meant[0], -meant[1], -meant[2], -meant[3]))
        self._values = {
            "turned_radians": 2.0 * math.atan2(math.hypot(x, y, z), abs(w)),
            "stretched": abs(sum(part * part for part in rotation) - 1.0),
        }
        self._effect = Effect(ideal)

    def __call__(self, fields: Fields) -> dict[str, float]:
        """Return what is measured of an answer."""
        return {**self._values, **self._effect(fields)}


def _too_long(share: float, _number: int) -> tuple[Quaternion, Quaternion]:
    w, x, y, z = (to_float32((1.0 + share) * part) for part in MEANT)
    return (w, x, y, z), MEANT


def _noisy(seed: int, steps: float, number: int) -> tuple[Quaternion, Quaternion]:
    numbers = random.Random(f"{seed} {number}")  # noqa: S311 - the same noise at every severity, only larger
    signs = [1 if numbers.random() < 0.5 else -1 for _ in MEANT]
    w, x, y, z = (stepped(part, sign * int(steps)) for part, sign in zip(MEANT, signs, strict=True))
    return (w, x, y, z), MEANT


def _quarter_turned(count: float, _number: int) -> tuple[Quaternion, Quaternion]:
    """Turn about z by an angle that a float32 holds: so many quarters of float32 pi."""
    half = to_float32(count * to_float32(FLOAT32_PI / 2.0)) / 2.0
    quarters = int(count) % 4
    meant = (math.cos(quarters * math.pi / 4.0), 0.0, 0.0, math.sin(quarters * math.pi / 4.0))
    # Half an angle turns the sign of a quaternion: the meant one is that of the same sheet.
    sheet = 1.0 if math.cos(half) * meant[0] + math.sin(half) * meant[3] >= 0.0 else -1.0
    return (
        (to_float32(sheet * math.cos(half)), 0.0, 0.0, to_float32(sheet * math.sin(half))),
        round_quaternion(meant),
    )


def _composed(count: float, _number: int) -> tuple[Quaternion, Quaternion]:
    return spun(int(count)), MEANT


@cache
def spun(count: int) -> Quaternion:
    """Return what so many equal turns, whole turns together, make of `MEANT`.

    They are composed one by one: multiplied in double, normalised, and stored as float32.
    """
    half = math.pi * TURNS / count
    x, y, z = (math.sin(half) * part for part in AXIS)
    turn = round_quaternion((math.cos(half), x, y, z))
    rotation = MEANT
    for _ in range(count):
        rotation = round_quaternion(multiply(turn, rotation))
    if sum(a * b for a, b in zip(rotation, MEANT, strict=True)) < 0.0:
        w, x, y, z = (-part for part in rotation)
        return (w, x, y, z)
    return rotation
