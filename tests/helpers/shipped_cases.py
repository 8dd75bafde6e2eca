"""Help for tests that use the cases of the package."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from conformance.loader import Vary, load_paths

if TYPE_CHECKING:
    from conformance.case import Case


@cache
def shipped_cases() -> dict[str, Case]:
    """Return every case of the package as it is written, by its id; read once in a process."""
    loaded = load_paths(vary=Vary(poses=0))
    assert not loaded.problems
    assert len(loaded.cases) > 1000
    return {case.id: case for case in loaded.cases}
