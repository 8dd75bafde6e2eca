"""Digests of what a case's outcome depends on: what has not changed need not be asked again."""

from __future__ import annotations

import hashlib
import platform
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.bench.machine import versions
from conformance.candidates.registry import COMMAND_PREFIX, MODULE_PREFIX

if TYPE_CHECKING:
    from conformance.case import Case
    from conformance.gate.config import Draws

_ENGINE: Final = "engine"


@cache
def sources_digest(package: str) -> str:
    """Return the digest of a package's Python sources, names included.

    Raises
    ------
    ModuleNotFoundError
        There is no such package.
    """
    spec = find_spec(package)
    if spec is None or spec.origin is None:
        raise ModuleNotFoundError(f"no package {package!r} with sources", name=package)
    root = Path(spec.origin).parent
    total = hashlib.sha256()
    for path in sorted(root.rglob("*.py"), key=lambda path: path.relative_to(root).as_posix()):
        total.update(f"{path.relative_to(root).as_posix()}\0{_of_bytes(path.read_bytes())}\n".encode())
    return total.hexdigest()


@cache
def file_digest(path: Path) -> str:
    """Return the digest of a file, which does not change while a gate runs."""
    return _of_bytes(path.read_bytes())


def suite_digest() -> str:
    """Return the digest of retail and of what compares with it."""
    return digest_of(
        sources_digest("oracle"), sources_digest("conformance"), platform.python_version(), repr(versions())
    )


def candidate_digest(candidate: str, given: str | None) -> str:
    """Return the digest of a candidate; empty where only its author could tell that it has changed.

    Parameters
    ----------
    candidate : str
        As ``--candidate`` takes it.
    given : str or None
        What its author says, such as the id of a build.
    """
    if given is not None:
        return digest_of(candidate, given)
    if candidate.startswith((COMMAND_PREFIX, MODULE_PREFIX)):
        return ""
    return digest_of(candidate, sources_digest(_ENGINE) if candidate == _ENGINE else suite_digest())


def case_digest(case: Case, poses: Draws | None, suite: str, candidate: str) -> str:
    """Return the digest of a case and of everyone who answers it; empty if the candidate's is.

    The whole file counts: cases may share what an anchor in another one names.
    """
    if not candidate:
        return ""
    asked = "as written" if poses is None else f"{poses.count} poses from {poses.seed}"
    return digest_of(file_digest(Path(case.location.file)), case.id, asked, suite, candidate)


def digest_of(*texts: str) -> str:
    """Return the digest of texts, in this order."""
    return _of_bytes("\0".join(texts).encode("utf-8"))


def _of_bytes(raw: bytes) -> str:
    return hashlib.sha256(raw).hexdigest()
