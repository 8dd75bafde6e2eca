"""What makes a campaign the same campaign: who is asked, by what, and what is drawn."""

from __future__ import annotations

import platform
import re
import shutil
import sys
from functools import cache
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.candidates.registry import COMMAND_PREFIX, MODULE_PREFIX
from conformance.gate.digests import candidate_digest, digest_of, file_digest, suite_digest
from conformance.protocol.process import split_command
from conformance.soak.records import FORMAT, Identity
from conformance.vector_library import GEOMETRY_FILES, WORLD_FILE

if TYPE_CHECKING:
    from collections.abc import Iterable

_VECTORS: Final = Path(__file__).parent.parent / "vectors"
_DIGITS: Final = 16
"""Of a digest: enough to notice a change."""


def identity_of(
    candidate: str, given: str | None, *, seed: int, shard_size: int, families: Iterable[str]
) -> Identity:
    """Return the identity of a campaign that this installation would run.

    Parameters
    ----------
    candidate : str
        As ``--candidate`` takes it.
    given : str or None
        What its author says its version is; None: what can be told from its files.
    seed, shard_size, families
        As of `Identity`.
    """
    return Identity(
        soak=FORMAT,
        suite=drawing_digest(),
        candidate=candidate,
        candidate_digest=digest_of_candidate(candidate, given),
        seed=seed,
        shard_size=shard_size,
        families=list(families),
    )


@cache
def drawing_digest() -> str:
    """Return the digest of retail, of the comparison, and of all that a draw depends on."""
    shared = [file_digest(_VECTORS / name) for name in (*GEOMETRY_FILES, WORLD_FILE)]
    system = (platform.system(), platform.machine())  # whose sines and roots the strategies use
    return digest_of(suite_digest(), metadata.version("hypothesis"), *system, *shared)[:_DIGITS]


@cache
def digest_of_candidate(candidate: str, given: str | None) -> str:
    """Return the digest of a candidate; of a foreign one, of those of its files that its name leads to."""
    if given is None and candidate.startswith((COMMAND_PREFIX, MODULE_PREFIX)):
        files = sorted(_files_of(candidate))
        return digest_of(candidate, *map(file_digest, files))[:_DIGITS] if files else ""
    return candidate_digest(candidate, given)[:_DIGITS]


def _files_of(candidate: str) -> list[Path]:
    """Return the files that a foreign candidate's name leads to: program and arguments, or the module."""
    if candidate.startswith(MODULE_PREFIX):
        module = candidate.removeprefix(MODULE_PREFIX).partition(":")[0]
        spec = find_spec(module)
        return [Path(spec.origin)] if spec is not None and spec.origin is not None else []
    words = split_command(candidate.removeprefix(COMMAND_PREFIX))
    names = _windows_words(words) if isinstance(words, str) else words
    found = [shutil.which(names[0]), *names[1:]]
    return [Path(name) for name in found if name is not None and _is_program(name)]


def _windows_words(command: str) -> list[str]:
    """Return the words of a command on Windows, where each program splits its own."""
    return [quoted or plain for quoted, plain in re.findall(r'"([^"]*)"|(\S+)', command)]


def _is_program(name: str) -> bool:
    """Tell whether a word names a file other than this Python, whose version is known already."""
    return Path(name).is_file() and Path(name).resolve() != Path(sys.executable).resolve()
