"""YAML files that one pydantic model describes."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from pydantic import BaseModel

from conformance.validation import validate
from conformance.yaml_source import read_document

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.source import Problem
    from conformance.yaml_source import Document

M = TypeVar("M", bound=BaseModel)


def read_model(path: Path, model: type[M]) -> tuple[Document, M | None, list[Problem]]:
    """Read a file, and what it says as a model.

    Returns
    -------
    Document
        The file, which knows the place of everything.
    BaseModel or None
        None if there are mistakes.
    list of Problem
        Every mistake, with its place.

    Raises
    ------
    OSError
        It cannot be read at all.
    YamlError
        It is not YAML.
    """
    document = read_document(path)
    file, faults = validate(model, document.data)
    problems = [problem for _, problem in document.refusals]
    problems += [document.problem(fault) for fault in faults]
    return document, None if problems else file, problems
