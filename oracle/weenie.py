"""The few things that movement asks the game object behind a physics object."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Weenie:
    """Answers of ACCWeenieObject's virtual queries (08 1).

    Attributes
    ----------
    is_creature, is_player, is_pk, is_pklite, is_impenetrable : bool
        What the game object is.
    can_bypass_move_restrictions : bool
        Whether housing restrictions do not apply to it.
    id : int
        Its object id, by which a house knows whom it admits (CanMoveInto, 08 1).
    """

    is_creature: bool = False
    is_player: bool = False
    is_pk: bool = False
    is_pklite: bool = False
    is_impenetrable: bool = False
    can_bypass_move_restrictions: bool = False
    id: int = 0
