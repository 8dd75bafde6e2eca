"""The target `yaml`: a file of cases, from its bytes to queries."""

from __future__ import annotations

import math
from typing import Any, Final

import yaml

from conformance.case import Vary
from conformance.fuzz.finding import FindingError, check_place, require
from conformance.loader import load_document
from conformance.yaml_source import YamlError, parse

NAME: Final = "fuzz.yaml"
_AS_WRITTEN: Final = Vary(poses=0)
_LOADER: Final[Any] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def run(data: bytes) -> bool:
    """Read a file of cases; return whether it holds one.

    Raises
    ------
    FindingError
        Other data than PyYAML composes, a mistake without a place, or neither a case nor a mistake.
    """
    try:
        document = parse(data, NAME)
    except YamlError as error:
        check_place(error.problem, data)
        return False
    if not document.refusals:
        _compare(yaml.compose(data.decode("utf-8"), _LOADER), document.data)
    loaded = load_document(document, _AS_WRITTEN)
    for problem in loaded.problems:
        check_place(problem, data)
    require(loaded.cases or loaded.problems, "neither a case nor a mistake")
    return bool(loaded.cases)


def _compare(root: Any, data: Any) -> None:
    """Compare data with the nodes of the same text, without recursion."""
    waiting = [(root, data)]
    while waiting:
        node, value = waiting.pop()
        match node, value:
            case None, None:
                pass
            case yaml.MappingNode(), dict():
                keys = [key.value for key, _ in node.value]
                require(keys == list(value), f"the keys {keys} read as {list(value)}")
                waiting += [(item, value[key.value]) for key, item in node.value]
            case yaml.SequenceNode(), list():
                require(len(node.value) == len(value), f"{len(node.value)} items read as {len(value)}")
                waiting += zip(node.value, value, strict=True)
            case yaml.ScalarNode(), _:
                _compare_scalar(node, value)
            case _:
                raise FindingError(f"{node!r} read as {value!r}")


def _compare_scalar(node: yaml.ScalarNode, value: Any) -> None:
    text = node.value
    match value:
        case str():
            same = value == text
        case None:
            same = text in {"", "~", "null", "Null", "NULL"}
        case bool():
            same = text.lower() == str(value).lower()
        case int():
            same = int(text, 16 if text.startswith("0x") else 10) == value
        case float():
            same = math.isfinite(value) and float(text) == value
        case _:
            same = False
    require(same, f"{text!r} read as {value!r}")
