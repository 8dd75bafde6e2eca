"""Queries and outcomes: what a candidate is asked, and the three things it may answer.

A query is one operation of ``vectors/FORMAT.md`` with its inputs. It is the only thing that passes
between the suite and a candidate, so whatever asks (a YAML case, a random pose, a vector file) and
whoever answers (oracle, engine, a foreign engine) are independent of each other.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping

    from conformance.scenes.model import Geometry

Fields: TypeAlias = dict[str, Any]
"""The outputs of a query, in the shape of the record's ``expect`` block.

Floats are Python floats holding float32 values; flags and ids are ints; states are names.
"""


@dataclass(frozen=True, slots=True, eq=False)
class Query:
    """One operation to perform.

    Attributes
    ----------
    op : str
        Name of the operation, as in ``vectors/FORMAT.md``.
    inputs : Mapping
        The record's input blocks, as FORMAT.md describes them; floats exactly float32.
    geometries : Mapping of str to Geometry
        Every geometry that the inputs name.
    label : str
        Where the query comes from (case id and variant), for messages.
    """

    op: str
    inputs: Mapping[str, Any]
    geometries: Mapping[str, Geometry] = field(default_factory=dict)
    label: str = ""

    def _repr_pretty_(self, printer: Any, _cycle: bool) -> None:
        # Hypothesis writes what failed: a world would fill its report, and ours tells the scene anyway.
        printer.text(f"Query(op={self.op!r}, label={self.label!r})")


@dataclass(frozen=True, slots=True)
class Result:
    """The candidate performed the operation."""

    fields: Fields


@dataclass(frozen=True, slots=True)
class Skipped:
    """The candidate does not do this; the reason is counted and shown."""

    reason: str


@dataclass(frozen=True, slots=True)
class Errored:
    """The candidate failed while performing the operation; the run goes on."""

    context: str


Outcome: TypeAlias = Result | Skipped | Errored
