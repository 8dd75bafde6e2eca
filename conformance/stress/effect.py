"""What stress does to an answer that was right for its inputs: it is held against the unstressed answer."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Result
from conformance.scenes.algebra import subtract

if TYPE_CHECKING:
    from conformance.query import Fields, Query
    from conformance.scenes.model import Vec3


class Effect:
    """Measures how far an answer is from retail's to the same question without the stress.

    Parameters
    ----------
    ideal : Query
        A transition, the question without the stress.
    shift : Vec3
        Where the stressed scene lies in the unstressed one's frame, metres.
    """

    def __init__(self, ideal: Query, shift: Vec3 = (0.0, 0.0, 0.0)) -> None:
        outcome = OracleCandidate().answer(ideal)
        if not isinstance(outcome, Result):
            raise TypeError(f"{ideal.label or ideal.op}: retail has no answer: {outcome}")
        self._ideal = outcome.fields
        self._shift = shift

    def __call__(self, fields: Fields) -> dict[str, float]:
        """Return the distance of the places, if the decisions agree, and whether they do not."""
        if _decided(fields) != _decided(self._ideal):
            return {"effect_flips": 1.0}
        place, ideal = (answer["curr"]["origin"] for answer in (fields, self._ideal))
        return {"effect_flips": 0.0, "effect_metres": math.dist(subtract(place, self._shift), ideal)}


def _decided(fields: Fields) -> tuple[object, ...]:
    valid = fields["contact_plane"]["valid"]
    return fields["result"], fields["walkable"], valid
