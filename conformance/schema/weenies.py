"""The flags of a game object: what movement asks it."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator

from conformance.scenes.validate_objects import WEENIE_FLAGS
from conformance.schema.mistakes import mistake
from conformance.source import describe, nearest, quoted


def _weenie(value: Any) -> Any:
    for index, flag in enumerate(value if isinstance(value, list) else ()):
        if flag not in WEENIE_FLAGS:
            expected = f"one of {quoted(WEENIE_FLAGS)}"
            raise mistake(describe(flag), expected, nearest(str(flag), WEENIE_FLAGS), at=(index,))
    return value


Weenie: TypeAlias = Annotated[list[str], BeforeValidator(_weenie)]
"""Names of flags; [] for a game object without any."""
