"""What can be wrong with what the engine is given: typed, and located in words of the input."""

from __future__ import annotations

from typing import Any


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
        super().__init__(where, problem)
        self.where = where
        self.problem = problem

    def __str__(self) -> str:
        return f"{self.where}: {self.problem}"


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


class UndeterminedError(EngineError):
    """A query needed what the specification of retail does not know (07, 11).

    Attributes
    ----------
    index : int
        Which query or body it was; the first, if there are several.
    results : array or None
        The answers to all queries of a batch; the ``status`` of each tells whether it is one. None where
        bodies ticked: their rows hold them.
    """

    def __init__(self, index: int, results: Any = None) -> None:
        super().__init__(index, results)
        self.index = index
        self.results = results

    def __str__(self) -> str:
        return (
            f"query {self.index}: retail's answer is not known: "
            "a step down onto a sphere that sphere 0 passes beside (07 4.6, 07 11)"
        )


class RecursionBoundError(EngineError, RuntimeError):
    """A query went deeper than retail's transition can (05, 10); the engine is wrong, not the input."""
