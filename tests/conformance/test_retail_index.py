"""Citations of the specification."""

from __future__ import annotations

from pathlib import Path

import pytest

from conformance.retail_index import (
    INDEX_FILE,
    CitationError,
    check_citation,
    cited_steps,
    index_documents,
    shipped_index,
    write_index,
)

ROOT = Path(__file__).parents[2]
DOCUMENTS = ROOT / "docs" / "retail"


def test_the_shipped_index_is_that_of_the_documents() -> None:
    """What the package ships was made from the specification in the repository."""
    index = index_documents(DOCUMENTS)
    assert len(index) == 10
    assert all(content["functions"] and content["steps"] for content in index.values())
    assert shipped_index() == index
    shipped = (ROOT / "conformance" / INDEX_FILE).read_text(encoding="utf-8")
    assert shipped == write_index(index)


@pytest.mark.parametrize(
    "citation",
    [
        "BSPTREE::step_sphere_down SD-1…SD-12",
        "Plane::localtoglobal PL-1...PL-4",
        "CPolygon::check_walkable CW-1, CW-6",
        "BSPLEAF::find_walkable FW-5",
        "CTransition::transitional_insert",
        "CSphere::intersects §3.1",
        "CCylSphere::intersects_sphere §10.8",
        "LandDefs::gid_to_lcoord §2.4",
        "CLandBlockStruct::ConstructPolygons §3.3",
    ],
)
def test_good_citations(citation: str) -> None:
    """A function alone, with steps, with a range, with a section."""
    check_citation(citation)


@pytest.mark.parametrize(
    ("citation", "found", "hint"),
    [
        ("BSPTREE::find_colisions", "the function 'BSPTREE::find_colisions'", "find_collisions"),
        ("BSPTREE::find_collisions FC-99", "the step 'FC-99'", "FC-9"),
        ("CPolygon::make_plane FC-1", "the step 'FC-1'", ""),
        ("find_collisions", "the citation 'find_collisions'", ""),
        ("", "the citation ''", ""),
    ],
)
def test_bad_citations(citation: str, found: str, hint: str) -> None:
    """An unknown function, an unknown step, a step of another document, no function at all."""
    with pytest.raises(CitationError) as caught:
        check_citation(citation)
    assert caught.value.found == found
    assert hint in caught.value.hint


def test_ranges_name_their_ends() -> None:
    """Both ends of a range must exist."""
    assert cited_steps("SD-1…SD-12, §8.1") == ["SD-1", "SD-12", "§8.1"]
