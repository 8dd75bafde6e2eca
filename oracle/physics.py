"""CPhysics: the gate between rendered frames and simulated ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.constants import MIN_QUANTUM

if TYPE_CHECKING:
    from oracle.physics_object import PhysicsObj
    from oracle.world import World


class Physics:
    """Everything that is simulated.

    Attributes
    ----------
    world : World
        Whose clock says what time it is.
    objects : list of PhysicsObj
        The object table; retail goes through it in the order of its hash table.
    last_update : float
        When the objects were simulated last; seconds, a double.
    """

    def __init__(self, world: World, last_update: float) -> None:
        self.world = world
        self.objects: list[PhysicsObj] = []
        self.last_update = last_update

    def use_time(self) -> None:
        """Simulate the objects up to now, unless that was done less than `MIN_QUANTUM` ago.

        What is left of the time is not carried over. Static animations and textures, which UT-5 goes on
        with, do not move anything.

        retail: CPhysics::UseTime 0x00509950, 06 UT-1…5.
        """
        now = self.world.clock.cur_time
        # UT-1
        q = now - self.last_update
        # UT-2
        if q < 0.0:
            self.last_update = now
            return
        # UT-3
        if q < MIN_QUANTUM:
            return
        # UT-4
        for physobj in self.objects:
            physobj.update_object()
        # UT-5
        self.last_update = now
