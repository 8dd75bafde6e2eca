"""The functions and numbered steps of the specification, so that a case cannot cite what is not there.

``retail_index.json`` ships with the package, the specification (``docs/retail``) need not; a test holds
the two together, and `index_documents` makes the one from the other.
"""

from __future__ import annotations

import functools
import json
import re
from importlib import resources
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, TypeAlias

from conformance.source import nearest

if TYPE_CHECKING:
    import pathlib
    from collections.abc import Mapping

Index: TypeAlias = "Mapping[str, Mapping[str, list[str]]]"
"""Document name to its ``functions`` and its ``steps`` (labels, and section numbers with a §)."""

INDEX_FILE: Final = "retail_index.json"

_FUNCTION: Final = re.compile(r"\b([A-Z]\w*)::(~?[a-zA-Z]\w*)(?!:)\b")
_BARE_HEADING: Final = re.compile(r"^##+ (?:([\d.]+) )?`?([a-zA-Z]\w*)(?:\(| - | \(\w+ form\))", re.MULTILINE)
_VIRTUAL_SECTION: Final = re.compile(r"^## [^\n]*`(\w+)\(.*?(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_STEP: Final = re.compile(r"\b([A-Z][A-Z0-9]*-\d+[a-z]?)\b")
_SECTION: Final = re.compile(r"^##+ (\d+(?:\.\d+)*)\.? ", re.MULTILINE)
_CITATION: Final = re.compile(r"([A-Za-z]\w*::~?\w+)(?: (.+))?")
_CLASS_OF_BARE_NAMES: Final[Mapping[str, Mapping[str, str]]] = MappingProxyType(
    {
        "05-transition.md": {"": "CTransition"},
        "06-tick.md": {"": "CPhysicsObj"},
        "07-sphere-and-cylsphere.md": {"10.": "CCylSphere"},
        "10-terrain-and-landdefs.md": {
            "2.": "LandDefs",
            "3.": "CLandBlockStruct",
            "6.": "CLandBlockStruct",
        },
    }
)
"""The class that headings without one mean, by document and by the section's number."""
_HOW: Final = "FUNCTION, or FUNCTION STEPS, such as 'BSPTREE::step_sphere_down SD-1…SD-12'"


class CitationError(ValueError):
    """A citation names no function, or no step, of the specification."""

    def __init__(self, found: str, expected: str, hint: str = "") -> None:
        super().__init__(f"found {found}, expected {expected}")
        self.found = found
        self.expected = expected
        self.hint = hint


def check_citation(citation: str, index: Index | None = None) -> None:
    """Check that ``FUNCTION STEPS`` names a function of the specification and steps of the same document.

    Raises
    ------
    CitationError
        It does not; the error says which part, and what comes nearest.
    """
    documents = shipped_index() if index is None else index
    match = _CITATION.fullmatch(citation)
    if match is None:
        raise CitationError(f"the citation {citation!r}", _HOW)
    function, steps = match.groups()
    candidates = [content["steps"] for content in documents.values() if function in content["functions"]]
    if not candidates:
        every = [name for content in documents.values() for name in content["functions"]]
        raise CitationError(
            f"the function {function!r}", "a function of docs/retail", nearest(function, every)
        )
    cited = cited_steps(steps or "")
    if not any(set(cited) <= set(steps) for steps in candidates):
        missing = next(step for step in cited if not any(step in steps for steps in candidates))
        known = [step for steps in candidates for step in steps]
        expected = f"a step of the document that specifies {function}"
        raise CitationError(f"the step {missing!r}", expected, nearest(missing, known))


def cited_steps(text: str) -> list[str]:
    """Split ``SD-1…SD-12, §8.1`` into the steps that it names; a range names its two ends."""
    return [step.strip() for step in re.split(r"[,…]|\.\.\.", text) if step.strip()]


@functools.cache
def shipped_index() -> Index:
    """Read the index that the package ships."""
    text = resources.files("conformance").joinpath(INDEX_FILE).read_text(encoding="utf-8")
    index: Index = json.loads(text)
    return index


def index_documents(folder: pathlib.Path) -> Index:
    """Find the functions and steps of each document of a specification folder."""
    documents = {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.glob("[0-9]*.md"))}
    return {
        name: {"functions": sorted(_functions(name, text)), "steps": sorted(_steps(text))}
        for name, text in documents.items()
    }


def write_index(index: Index) -> str:
    """Format an index as the shipped file has it."""
    return json.dumps(index, indent=1) + "\n"


def _functions(name: str, text: str) -> set[str]:
    found = {f"{cls}::{function}" for cls, function in _FUNCTION.findall(text)}
    for section, cls in _CLASS_OF_BARE_NAMES.get(name, {}).items():
        headings = _BARE_HEADING.findall(text)
        found |= {f"{cls}::{function}" for number, function in headings if number.startswith(section)}
    for match in _VIRTUAL_SECTION.finditer(text):
        # A function that nodes and leaves each implement has one section, with a part for either.
        if "**BSPNODE**" in match[0]:
            found |= {f"BSPNODE::{match[1]}", f"BSPLEAF::{match[1]}"}
    return found


def _steps(text: str) -> set[str]:
    return set(_STEP.findall(text)) | {f"§{number}" for number in _SECTION.findall(text)}
