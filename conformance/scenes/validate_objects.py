"""Checks of a world's objects and of the lists that say in which cells they are tested."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from conformance.scenes.errors import SceneError
from conformance.scenes.validate import pose_errors
from conformance.scenes.validate_numbers import number_errors, show

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.scenes.object_model import Part, WorldObject
    from conformance.scenes.world_model import World

WEENIE_FLAGS: Final = ("creature", "player", "pk", "pklite", "impenetrable", "bypass")
"""What a weenie can be asked (08 1.)."""
OBJECT_IDS: Final = range(1, 1 << 32)


def object_errors(world: World) -> Iterator[SceneError]:
    """Yield what is wrong with a world's objects, their geometries apart."""
    ids: set[int] = set()
    for n, thing in enumerate(world.objects):
        if thing.id in ids:
            yield SceneError(f"objects[{n}].id", f"the object id 0x{thing.id:08X} twice", "an id of its own")
        ids.add(thing.id)
        yield from single_object_errors(thing, f"objects[{n}]")
    for n, thing in enumerate(world.objects):
        for k, other in enumerate(thing.attached):
            if other not in ids or other == thing.id:
                path = f"objects[{n}].attached[{k}]"
                yield SceneError(path, f"the object 0x{other:08X}", "another object of this world")


def single_object_errors(thing: WorldObject, path: str) -> Iterator[SceneError]:
    """Yield what is wrong with one object."""
    if thing.id not in OBJECT_IDS:
        yield SceneError(f"{path}.id", f"the object id {thing.id}", "1 to 0xFFFFFFFF; 0 is no object")
    yield from pose_errors(thing.pose, f"{path}.pose")
    yield from _scale_errors(thing.scale, f"{path}.scale")
    for flag in thing.weenie or ():
        if flag not in WEENIE_FLAGS:
            yield SceneError(f"{path}.weenie", repr(flag), f"one of {', '.join(WEENIE_FLAGS)}")
    for k, part in enumerate(thing.parts):
        yield from _part_errors(part, f"{path}.parts[{k}]")
    shapes: list[tuple[str, tuple[float, ...]]] = [
        *((f"cylspheres[{k}]", shape) for k, shape in enumerate(thing.cylspheres)),
        *((f"spheres[{k}]", shape) for k, shape in enumerate(thing.spheres)),
    ]
    for name, shape in shapes:
        yield from number_errors(shape, f"{path}.{name}")
        if not all(size > 0.0 for size in shape[3:]):
            yield SceneError(f"{path}.{name}", show(shape[3:]), "sizes greater than 0")


def _part_errors(part: Part, path: str) -> Iterator[SceneError]:
    if part.pose is not None:
        yield from pose_errors(part.pose, f"{path}.pose")
    if part.scale is not None:
        yield from _scale_errors(part.scale, f"{path}.scale")
    drawn = part.drawing_sphere
    if drawn is not None:
        yield from number_errors(drawn, f"{path}.drawing_sphere")
        if part.physics:
            found = "a drawing sphere beside a physics tree"
            yield SceneError(f"{path}.drawing_sphere", found, "one of a part without physics")
        elif not drawn[3] > 0.0:
            yield SceneError(f"{path}.drawing_sphere", show(drawn[3:]), "a radius greater than 0")


def shadow_errors(world: World) -> Iterator[SceneError]:
    """Yield what is wrong with the lists of a world's cells."""
    ids = {thing.id for thing in world.objects}
    for cell, objects in world.shadow.items():
        path = f"shadow.{cell}"
        unknown = [thing for thing in objects if thing not in ids]
        if unknown:
            yield SceneError(path, f"the object 0x{unknown[0]:08X}", "an object of this world")
        if len(set(objects)) != len(objects):
            yield SceneError(path, "an object twice in one cell", "each object once")


def _scale_errors(scale: float, path: str) -> Iterator[SceneError]:
    if not 0.0 < scale < math.inf:
        yield SceneError(path, f"{scale!r}", "a finite scale greater than 0")
