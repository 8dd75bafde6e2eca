"""JSON that every reader takes: what is no number there is written as messages and vectors write it."""

from __future__ import annotations

import json
import math
from typing import Any


def json_text(record: Any, indent: int) -> str:
    """Return a record as JSON in lines; NaN and infinities become ``"nan"``, ``"inf"`` and ``"-inf"``."""
    return json.dumps(_printable(record), indent=indent, ensure_ascii=False, allow_nan=False) + "\n"


def _printable(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else str(value)
    if isinstance(value, dict):
        return {key: _printable(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_printable(each) for each in value]
    return value
