"""The queries about a mover: local spheres, slides, one collision call, a whole transition."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field, model_validator

from conformance.schema.frames import PoseModel
from conformance.schema.mistakes import mistake
from conformance.schema.mover import PathModel, SeedModel
from conformance.schema.query_base import Needs, QueryModel
from conformance.schema.values import CellId, Flag, Number, Plane, Vec3
from conformance.source import quoted


class MoverQuery(QueryModel):
    """A query about the case's mover."""

    mover: ClassVar[bool] = True


class CacheSpheresQuery(MoverQuery):
    """Take the mover's spheres to the space of a cell or part."""

    op: Literal["cache_localspace_sphere"]
    pose: PoseModel
    scale: Number
    from_: PoseModel = Field(alias="from")
    to: PoseModel


class SlideSphereQuery(MoverQuery):
    """Slide the first sphere along a surface."""

    op: Literal["slide_sphere"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel
    seed: SeedModel = SeedModel()
    normal: Vec3


class AdjustOffsetQuery(MoverQuery):
    """Bend a movement along contact plane and sliding normal."""

    op: Literal["adjust_offset"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel
    seed: SeedModel = SeedModel()
    offset: Vec3


class CliffSlideQuery(MoverQuery):
    """Slide along the crease of two contact planes."""

    op: Literal["cliff_slide"]
    from_: PoseModel = Field(alias="from")
    to: PoseModel
    seed: SeedModel = SeedModel()
    plane: Plane


class CallQuery(MoverQuery):
    """One collision call of a mover that goes from one place to another, or stays."""

    from_: PoseModel | None = Field(None, alias="from")
    to: PoseModel | None = None
    at: PoseModel | None = Field(None, description="Both 'from' and 'to': no movement.")
    seed: SeedModel = SeedModel()
    path: PathModel

    @model_validator(mode="after")
    def _moves_or_stays(self) -> CallQuery:
        given = [name for name in ("from", "to", "at") if getattr(self, name.replace("from", "from_"))]
        if given not in (["from", "to"], ["at"]):
            raise mistake(quoted(given) or "no position", "'from' and 'to', or 'at'")
        return self


class FindCollisionsQuery(CallQuery):
    """One collision call on the tree of the scene's only cell, or of its only static."""

    needs: ClassVar[Needs] = "cells"
    op: Literal["find_collisions"]


class TransitionQuery(MoverQuery):
    """One find_valid_position in the scene."""

    needs: ClassVar[Needs] = "scene"
    op: Literal["transition"]
    from_: PoseModel | None = Field(alias="from", description="null for a placement.")
    to: PoseModel
    begin_cell: CellId | None = Field(None, description="In a scene of cells; a world's is that of 'from'.")
    seed: SeedModel = SeedModel()
    placement_allows_sliding: Flag = 1
