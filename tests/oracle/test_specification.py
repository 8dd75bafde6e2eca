"""The port and the specification hold together: labels lead somewhere, functions are accounted for."""

from __future__ import annotations

import ast
import csv
import re
import tokenize
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

import oracle
from oracle.not_ported import NOT_PORTED

ORACLE = Path(oracle.__file__).parent
DOCUMENTS = ORACLE.parent / "docs" / "retail"

LABEL = re.compile(r"(?:\b(\d\d) )?\b([A-Z]{2,3})-(\d+[a-z]?)\b(?:…(\d+[a-z]?))?")
"""A document or none, a step label, and perhaps the end of a range."""
SECTION = re.compile(r"\b(0[1-9]|10) (\d+(?:\.\w+)*)")
"""A document and a section, or a step of a section."""
NAMED_DOCUMENT = re.compile(r"\b(0[1-9]|10) (?=[A-Z]{2,3}-\d|\d)")
ADDRESS = re.compile(r"0x[0-9A-F]{8}")

MODULES = sorted(ORACLE.rglob("*.py"))


@dataclass(frozen=True)
class Text:
    """A comment or docstring of the port, and the document that its bare labels belong to."""

    where: str
    text: str
    document: str | None


@cache
def documents() -> dict[str, str]:
    """Return the text of each document by its two digits."""
    return {path.name[:2]: path.read_text(encoding="utf-8") for path in sorted(DOCUMENTS.glob("??-*.md"))}


@cache
def labels_of(document: str) -> frozenset[str]:
    """Return the step labels that a document defines: those that begin a line or a table row."""
    found = re.findall(r"^[\s|*-]*([A-Z]{2,3}-\d+[a-z]?)\b", documents()[document], re.MULTILINE)
    inline = re.findall(r"(?<=[.;] )([A-Z]{2,3}-\d+[a-z]?)\. ", documents()[document])
    return frozenset(found) | frozenset(inline)


@cache
def sections_of(document: str) -> dict[str, str]:
    """Return the text of each numbered section, subsections included."""
    headings = list(re.finditer(r"^(#+) (\d+(?:\.\w+)*)\.? ", documents()[document], re.MULTILINE))
    sections = {}
    for i, heading in enumerate(headings):
        behind = (h.start() for h in headings[i + 1 :] if len(h[1]) <= len(heading[1]))
        sections[heading[2]] = documents()[document][heading.end() : next(behind, None)]
    return sections


def section_exists(document: str, number: str) -> bool:
    """Tell whether a section, a numbered step of one, or a step of a step, is there."""
    return text_of_step(document, number) is not None


def text_of_step(document: str, number: str) -> str | None:
    """Return the text of a section, of a numbered step or of a step of a step; None if it is not there."""
    if number in sections_of(document):
        return sections_of(document)[number]
    outer, _, step = number.rpartition(".")
    within = text_of_step(document, outer) if outer else None
    if within is None:
        return None
    found = re.search(rf"(?:^|[.;:)] )( *)(?:\* )?{re.escape(step)}\. ", within, re.MULTILINE)
    if found is None:
        return None
    rest = within[found.end() :]
    end = re.search(rf"\n {{0,{len(found[1])}}}\S", rest)
    return rest[: end.start()] if end else rest


def texts(path: Path) -> list[Text]:
    """Return every docstring and comment of a module."""
    source = path.read_text(encoding="utf-8")
    tree = ast.parse(source)
    scopes: list[tuple[int, int, str | None]] = []
    found: list[Text] = []

    def visit(node: ast.AST, inherited: str | None) -> None:
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            docstring = ast.get_docstring(node) or ""
            named = NAMED_DOCUMENT.search(docstring)
            inherited = named[1] if named else inherited
            first, last = getattr(node, "lineno", 1), getattr(node, "end_lineno", source.count("\n") + 1)
            scopes.append((first, last, inherited))
            found.append(Text(f"{path.name}:{first}", docstring, inherited))
        for child in ast.iter_child_nodes(node):
            visit(child, inherited)

    visit(tree, None)
    with path.open("rb") as file:
        for token in tokenize.tokenize(file.readline):
            if token.type == tokenize.COMMENT:
                line = token.start[0]
                document = [scope for scope in scopes if scope[0] <= line <= scope[1]][-1][2]
                found.append(Text(f"{path.name}:{line}", token.string, document))
    return found


def missing_labels(item: Text) -> list[str]:
    """Return the labels and sections cited by a text that are not in the specification."""
    missing = []
    for document, prefix, first, last in LABEL.findall(item.text):
        for number in filter(None, (first, last)):
            label = f"{prefix}-{number}"
            owners = [name for name in documents() if label in labels_of(name)]
            named = document or item.document
            if not (named in owners if named else len(owners) == 1):
                missing.append(f"{item.where}: {named or '??'} {label}")
    missing += [
        f"{item.where}: {document} {number}"
        for document, number in SECTION.findall(item.text)
        if not section_exists(document, number)
    ]
    return missing


@cache
def specified_functions() -> dict[str, str]:
    """Return the name of every function that has a section, by its address."""
    with (DOCUMENTS / "functions.tsv").open(encoding="utf-8", newline="") as file:
        return {row["address"]: row["function"] for row in csv.DictReader(file, delimiter="\t")}


@cache
def ported_addresses() -> set[str]:
    """Return every address that a docstring of the port claims behind ``retail:``."""
    claims = (item.text.partition("retail:")[2] for path in MODULES for item in texts(path))
    return {address for claim in claims for address in ADDRESS.findall(claim)}


def test_the_specification_is_there() -> None:
    """Ten documents, many functions and many modules: nothing below passes on nothing."""
    assert sorted(documents()) == [f"{i:02}" for i in range(1, 11)]
    assert len(specified_functions()) > 180
    assert len(MODULES) > 25
    assert len(labels_of("05")) > 80


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.name)
def test_cited_steps_exist(path: Path) -> None:
    """Every step label and section that a module cites is in the document it names."""
    assert [problem for item in texts(path) for problem in missing_labels(item)] == []


@pytest.mark.parametrize(
    ("text", "document"),
    [
        ("# SD-99", "03"),
        ("# 03 TI-7", "05"),
        ("# 07 6.B.99", None),
        ("# 07 10.4.4.9", None),
        ("# 01 44.1", None),
        ("# SD-1", None),
    ],
)
def test_a_wrong_citation_is_found(text: str, document: str | None) -> None:
    """A label that is absent, in another document, or in several without saying which is a problem."""
    assert missing_labels(Text("somewhere", text, document))


@pytest.mark.parametrize(
    ("text", "document"),
    [
        ("# SD-9", "03"),
        ("# SD-5", "05"),
        ("# 05 TI-7…12", "04"),
        ("# 07 6.B.5", None),
        ("# 07 10.4.4.3", None),
        ("# NM-3", None),
    ],
)
def test_a_right_citation_is_found(text: str, document: str | None) -> None:
    """A label of the enclosing docstring's document, of a named one, or of the only one is right."""
    assert missing_labels(Text("somewhere", text, document)) == []


def test_every_function_is_ported_or_listed() -> None:
    """Each function of the specification has its port, or a line that says why not."""
    accounted = ported_addresses() | set(NOT_PORTED)
    assert {a: n for a, n in specified_functions().items() if a not in accounted} == {}


def test_the_list_is_not_stale() -> None:
    """What is listed as not ported has no port, and is in the specification."""
    assert set(NOT_PORTED) & ported_addresses() == set()
    assert set(NOT_PORTED) - set(specified_functions()) == set()


def test_every_listed_function_has_a_reason() -> None:
    """A line without a reason would be a silent skip."""
    assert all(reason.strip() for reason in NOT_PORTED.values())
