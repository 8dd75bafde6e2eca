"""What makes a campaign the same campaign."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest
from faux import command_of

from conformance.gate.digests import file_digest
from conformance.soak.identity import _windows_words, digest_of_candidate, drawing_digest, identity_of

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def forget() -> None:
    """Forget digests; what they are of does not change while a program runs."""
    digest_of_candidate.cache_clear()
    file_digest.cache_clear()


@pytest.fixture(autouse=True)
def nothing_known() -> Iterator[None]:
    """Know no digest before a test, and none of its own after it."""
    forget()
    yield
    forget()


def digest_with(path: Path, text: str, candidate: str) -> str:
    """Return a candidate's digest while a file holds a text."""
    path.write_text(text, encoding="utf-8")
    forget()
    return digest_of_candidate(candidate, None)


def test_a_command_is_known_by_its_files(tmp_path: Path) -> None:
    """Program and arguments; this Python itself is known by its version."""
    path = tmp_path / "my engine.py"
    candidate = f"cmd:{command_of(sys.executable, path, '--fast')}"
    one, other = (digest_with(path, text, candidate) for text in ("one", "other"))
    assert "" != one != other
    assert one == digest_with(path, "one", candidate)
    assert digest_of_candidate(f"cmd:{command_of(sys.executable, '-m', 'engine')}", None) == ""


def test_a_command_of_windows_is_read_as_its_programs_do() -> None:
    """A path with spaces stands in quotation marks; a backslash is a backslash."""
    words = [r"C:\My Engine\engine.exe", "--map", r"D:\map.bin"]
    assert _windows_words(r'"C:\My Engine\engine.exe" --map D:\map.bin') == words


def test_a_python_object_is_known_by_its_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of packages that it uses nothing is known."""
    monkeypatch.syspath_prepend(tmp_path)
    path = tmp_path / "an_engine_of_mine.py"
    one, other = (digest_with(path, text, "mod:an_engine_of_mine:make") for text in ("one = 1", "two = 2"))
    assert "" != one != other


def test_what_the_author_says_counts_instead() -> None:
    """For every kind of candidate."""
    for candidate in ("engine", "mod:soak_engines:Right", "cmd:./my-engine"):
        assert digest_of_candidate(candidate, "build 7") != digest_of_candidate(candidate, "build 8")


def test_candidates_of_the_suite_are_known_by_their_sources() -> None:
    """The engine by its own; a known bug is the oracle's sources with a name."""
    digests = {digest_of_candidate(name, None) for name in ("engine", "oracle", "bug:cell-origin")}
    assert len(digests) == 3
    assert "" not in digests


def test_an_identity_is_the_same_each_time() -> None:
    """And says what is drawn from."""
    one, other = (identity_of("engine", None, seed=3, shard_size=10, families=["cells"]) for _ in range(2))
    assert one == other
    assert (one.suite, one.families) == (drawing_digest(), ["cells"])
