"""What can be wrong with what the engine is given: typed, and located in words of the input."""

from __future__ import annotations


class EngineError(Exception):
    """Base of everything that the engine raises on purpose."""


class InputError(EngineError, ValueError):
    """Input that no world or query can be made of.

    Attributes
    ----------
    where : str
        What is wrong, as a path in the input (``cell 0xA9B40111, object 2, pose``).
    problem : str
        What is wrong with it, with the offending value.
    """

    def __init__(self, where: str, problem: str) -> None:
        super().__init__(f"{where}: {problem}")
        self.where = where
        self.problem = problem


class GeometryError(InputError):
    """A shape's vertices, polygons, tree or containment planes."""


class PoseError(InputError):
    """A pose that is not finite or not of unit rotation."""


class WorldError(InputError):
    """Cells, landblocks, buildings and obstacles that do not make a world."""


class QueryError(InputError):
    """A mover, a seed or a position that cannot be asked about."""


class CrowdedError(EngineError):
    """A body has touched more objects within a second than it can remember."""


class RecursionBoundError(EngineError, RuntimeError):
    """A query went deeper than retail's transition can (05, 10); the engine is wrong, not the input."""
