"""Paths into the suite as its documents write them, in a working directory without it."""

from __future__ import annotations

from pathlib import Path
from typing import Final

_PACKAGE: Final = Path(__file__).parent


def installed(path: Path) -> Path:
    """Return what a path means: below `conformance`, if there is no such folder here, what is installed.

    So `pytest conformance` and `conformance verify conformance/vectors` do the same in a clone and elsewhere.
    """
    if path.parts[:1] != (_PACKAGE.name,) or Path(_PACKAGE.name).exists():
        return path
    inside = _PACKAGE.joinpath(*path.parts[1:])
    return inside if inside.exists() else path


def meant(path: Path) -> list[Path]:
    """Return what an argument means: what is `installed`, or the files of a pattern.

    Shells of Windows leave ``my-cases/*.yaml`` to the program. A pattern without files is returned as it is.
    """
    if "*" not in path.name or path.exists():
        return [installed(path)]
    return sorted(installed(path.parent).glob(path.name)) or [path]
