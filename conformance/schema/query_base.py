"""What every query model has."""

from __future__ import annotations

from typing import ClassVar, Literal, TypeAlias

from conformance.schema.values import Strictly

Needs: TypeAlias = Literal["cells", "geometry", "scene", "terrain", ""]
"""Which part of the scene a query works on; ``scene``: cells, terrain, or both."""


class QueryModel(Strictly):
    """One operation.

    `needs` and `mover` say what else of the case it works on.
    """

    needs: ClassVar[Needs] = ""
    mover: ClassVar[bool] = False
    op: str
