"""Mistakes about sliding: the normals that are remembered and what a slide answers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from conformance.candidates.bug_candidate import KnownBug
from conformance.candidates.replacements import Edit, Method
from oracle.sphere import Sphere
from oracle.sphere_path import SpherePath
from oracle.transition import Transition
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Callable


def _store_as_given(
    retail: Callable[[SpherePath, int, Vector3], None],
) -> Callable[[SpherePath, int, Vector3], None]:
    def set_neg_poly_hit(self: SpherePath, step_up: int, normal: Vector3) -> None:
        retail(self, step_up, Vector3(-normal.x, -normal.y, -normal.z))

    return set_neg_poly_hit


def _keep_z(_retail: Callable[[Transition, Vector3], None]) -> Callable[[Transition, Vector3], None]:
    def init_sliding_normal(self: Transition, n: Vector3) -> None:
        collisions = self.collision_info
        collisions.sliding_normal_valid = 1
        collisions.sliding_normal.assign(n)
        if collisions.sliding_normal.normalize_check_small():
            collisions.sliding_normal.assign(Vector3())

    return init_sliding_normal


BUGS: Final = (
    KnownBug(
        "neg-normal-sign",
        "the normal of a polygon overlapped from behind is stored as it is",
        "it is stored negated, pointing to the mover's side (04 4, set_neg_poly_hit; 03 FC-11)",
        (Method(SpherePath, "set_neg_poly_hit", _store_as_given),),
        case="contact-two-spheres-back-face-of-feet",
        output="neg_normal.y",
    ),
    KnownBug(
        "slide-dead-end-ok",
        "a slide that goes straight against the obstacle answers OK",
        "its last branch answers COLLIDED (07 6.B.9)",
        (
            Edit(
                Sphere,
                "slide_sphere",
                (
                    (
                        "        collisions.set_collision_normal(cn)\n    return TransitionState.COLLIDED",
                        "        collisions.set_collision_normal(cn)\n    return TransitionState.OK",
                    ),
                ),
            ),
        ),
        case="bug-slide-dead-end-ok",
        output="result",
    ),
    KnownBug(
        "sliding-normal-z",
        "the sliding normal that a transition is seeded with keeps its z",
        "z is dropped before it is normalised (04 5, init_sliding_normal)",
        (Method(Transition, "init_sliding_normal", _keep_z),),
        case="bug-sliding-normal-z",
        output="offset.y",
    ),
)
