"""What each section of a run consists of."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from conformance.bench import ops
from conformance.bench.contests import KERNELS, Contest
from conformance.bench.variants import variants_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from conformance.bench.native_jobs import Native


def contests_of(
    sections: Sequence[str], native: Native | None
) -> list[tuple[str, Callable[[Contest], None]]]:
    """Return the contests of the sections that were asked for, each with what it is called."""
    found: list[tuple[str, Callable[[Contest], None]]] = [
        (
            f"{op} beside itself, batch {batch}",
            partial(Contest.beside_itself, op=op, batch=batch, variants=those),
        )
        for op, batch, those in variants_of(sections)
    ]
    if "native" in sections and native is not None:
        found += [
            (f"{op} beside native", partial(Contest.beside_native, op=op, native=native)) for op in KERNELS
        ]
    if "oracle" in sections:
        found += [(f"{op} beside the oracle", partial(Contest.beside_oracle, op=op)) for op in ops.ENGINE_OPS]
        found.append(("free flight beside contact walk", Contest.air_beside_ground))
    if "peers" in sections:
        found.append(("touch beside peers", Contest.beside_peers))
    if "precision" in sections:
        found.append(("work and precision", Contest.precision))
    return found
