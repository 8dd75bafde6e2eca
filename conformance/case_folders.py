"""Folders of case files: which files they hold, for who loads them and for who only looks for them."""

from __future__ import annotations

import os
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

CASE_SUFFIXES: Final = (".yaml", ".yml")
_NOT_ENTERED: Final = ".*", "*.egg", "_darcs", "build", "CVS", "dist", "node_modules", "venv", "{arch}"
"""Names of folders that pytest does not enter, unless it is told to (`norecursedirs`),"""
_MARK_OF_ENVIRONMENT: Final = "pyvenv.cfg"
"""and the file of the others."""


def yaml_files(folder: Path) -> list[Path]:
    """List the YAML files below a folder, sorted, but for those in folders that pytest does not enter."""
    files = (file for file in _below(folder) if file.suffix in CASE_SUFFIXES and file.is_file())
    return sorted(files, key=lambda file: file.relative_to(folder).as_posix())


def _below(folder: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(folder):
        yield from (Path(place, name) for name in names)
        folders[:] = [name for name in folders if _is_entered(Path(place, name))]


def _is_entered(folder: Path) -> bool:
    is_left_out = any(fnmatchcase(folder.name, pattern) for pattern in _NOT_ENTERED)
    return not is_left_out and not (folder / _MARK_OF_ENVIRONMENT).is_file()
