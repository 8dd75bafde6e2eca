"""Checking data against a model: pydantic's errors in the words of the case format, all at once."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, TypeVar

from pydantic import BaseModel, ValidationError

from conformance.schema.json_schema import allowed_keys
from conformance.schema.mistakes import MISTAKE
from conformance.source import Fault, describe, nearest, quoted

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pydantic_core import ErrorDetails

    from conformance.source import DocPath

M = TypeVar("M", bound=BaseModel)

SLUG_RULE: Final = "lower-case words and numbers joined by '-', such as 'step-up-0-6'"
_EXPECTED: Final = {
    "float_type": "a number",
    "int_type": "a whole number",
    "string_type": "text",
    "bool_type": "true or false",
    "list_type": "a list",
    "tuple_type": "a list",
    "dict_type": "a mapping",
    "model_type": "a mapping",
    "string_too_short": "some text",
    "string_pattern_mismatch": SLUG_RULE,
}
_QUOTED: Final = re.compile(r"'([^']+)'")


def validate(model: type[M], data: Any) -> tuple[M | None, list[Fault]]:
    """Check data against a model.

    Parameters
    ----------
    model : type
        A model of `conformance.schema`.
    data : Any
        Plain data, as read from a file.

    Returns
    -------
    model instance or None
        None if there are faults.
    list of Fault
        Everything that is wrong; paths start at `data`.
    """
    try:
        return model.model_validate(data), []
    except ValidationError as error:
        return None, [_fault(model, data, details) for details in error.errors(include_url=False)]


def worded(path: DocPath, context: Mapping[str, Any]) -> Fault:
    """Return the fault that a `mistake`'s context words."""
    return Fault((*path, *context["at"]), context["found"], context["expected"], context["hint"])


def _fault(model: type[BaseModel], data: Any, details: ErrorDetails) -> Fault:
    kind, value, context = details["type"], details["input"], details.get("ctx", {})
    path = _inside(data, details)
    match kind:
        case _ if kind == MISTAKE:
            return worded(path, context)
        case "extra_forbidden":
            return _unknown_key(model, path, details)
        case "missing":
            return _missing(path, details)
        case "literal_error":
            allowed = str(context["expected"])
            return Fault(path, describe(value), allowed, nearest(str(value), _QUOTED.findall(allowed)))
        case "too_short" | "too_long":
            return Fault(path, _items(context["actual_length"]), _length(context))
        case _:
            return Fault(path, describe(value), _EXPECTED.get(kind) or _lower(details["msg"]))


def _inside(data: Any, details: ErrorDetails) -> DocPath:
    """Return the way through the data that an error's location means.

    A location also names the model that was chosen for a value; such parts are not in the data.
    """
    way: list[str | int] = []
    for part in details["loc"]:
        if isinstance(data, list) and isinstance(part, int):
            data = data[part] if part < len(data) else None
            way.append(part)
        elif isinstance(data, dict) and part in data:
            data = data[part]
            way.append(part)
    return tuple(way)


def _unknown_key(model: type[BaseModel], path: DocPath, details: ErrorDetails) -> Fault:
    key = str(path[-1])
    allowed = allowed_keys(model, details["loc"][:-1])
    return Fault(
        path, f"the unknown key '{key}'", f"one of {quoted(allowed)}", nearest(key, allowed), key=True
    )


def _missing(path: DocPath, details: ErrorDetails) -> Fault:
    name = details["loc"][-1]
    if isinstance(name, int):  # a tuple's item, which pydantic locates behind the end of the list
        below = path[:-1] if path and path[-1] == name else path
        return Fault(below, describe(details["input"]), "a longer list")
    return Fault(path, f"no '{name}'", f"the key '{name}'")


def _items(count: int) -> str:
    return f"{count} item{'' if count == 1 else 's'}"


def _length(context: Mapping[str, Any]) -> str:
    low, high = context.get("min_length"), context.get("max_length")
    return f"at least {low}" if low is not None else f"at most {high}"


def _lower(message: str) -> str:
    text = message.removeprefix("Input should be ")
    return text[:1].lower() + text[1:]
