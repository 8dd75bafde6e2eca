"""What each section of a run consists of."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from conformance.bench import ops
from conformance.bench.contests import KERNELS, SHORTENED, THREADED, Contest
from conformance.bench.oracle_jobs import MAKERS
from conformance.bench.settings import THREADS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from conformance.bench.native_jobs import Native


def contests_of(
    sections: Sequence[str], native: Native | None
) -> list[tuple[str, Callable[[Contest], None]]]:
    """Return the contests of the sections that were asked for, each with what it is called."""
    found: list[tuple[str, Callable[[Contest], None]]] = []
    if "noise" in sections:
        found += [
            (f"noise of {op}", partial(Contest.beside_itself, op=op)) for op in (ops.STRIKE, ops.CONTACT_WALK)
        ]
    if "native" in sections and native is not None:
        found += [
            (f"{op} beside native", partial(Contest.beside_native, op=op, native=native)) for op in KERNELS
        ]
    if "oracle" in sections:
        found += [(f"{op} beside the oracle", partial(Contest.beside_oracle, op=op)) for op in MAKERS]
        found.append(("free flight beside contact walk", Contest.air_beside_ground))
    if "plans" in sections:
        found += [(f"shortcuts of {op}", partial(Contest.with_shortcuts, op=op)) for op in SHORTENED]
    if "threads" in sections:
        found += [
            (f"{op} on {THREADS} threads, batch {batch}", partial(Contest.on_threads, op=op, batch=batch))
            for op, batch in THREADED
        ]
    if "peers" in sections:
        found.append(("touch beside peers", Contest.beside_peers))
    if "precision" in sections:
        found.append(("work and precision", Contest.precision))
    return found
