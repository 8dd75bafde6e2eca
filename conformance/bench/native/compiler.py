"""The system's C++ compiler, if there is one, and the yardstick compiled with it."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Final

SOURCE: Final = Path(__file__).with_name("yardstick.cpp")
COMPILERS: Final = ("g++", "clang++", "c++", "cl")
"""Names that are looked for when the environment variable CXX names none."""
FLAGS: Final = (
    "-std=c++17",
    "-O2",
    "-fno-tree-slp-vectorize",  # g++ 12 packs two lanes and then drops (double)(float)x
    "-fno-tree-vectorize",
    "-ffp-contract=off",  # a fused multiply-add rounds once where retail rounds twice
    "-fPIC",
    "-shared",
)
MSVC_FLAGS: Final = ("/nologo", "/std:c++17", "/O2", "/fp:precise", "/EHsc", "/LD")
_SECONDS: Final = 120.0
"""A compilation that takes longer is given up."""


class NoCompilerError(Exception):
    """There is no compiler, or it does not compile the yardstick; the message says which."""


@dataclass(frozen=True, slots=True)
class Compiler:
    """A compiler.

    Attributes
    ----------
    command : tuple of str
        The program, and what CXX says besides.
    """

    command: tuple[str, ...]

    @property
    def is_msvc(self) -> bool:
        """Whether it takes Microsoft's flags."""
        return Path(self.command[0]).stem.lower() == "cl"

    def arguments(self, source: Path, library: Path) -> list[str]:
        """Return the command line that makes a library of a file."""
        if self.is_msvc:
            return [
                *self.command,
                *MSVC_FLAGS,
                str(source),
                f"/Fe{library}",
                f"/Fo{library.with_suffix('.obj')}",
            ]
        return [*self.command, *FLAGS, str(source), "-o", str(library)]

    def describe(self) -> str:
        """Return program and flags, for reports."""
        flags = MSVC_FLAGS if self.is_msvc else FLAGS
        return " ".join([Path(self.command[0]).name, *self.command[1:], *flags])


def find_compiler() -> Compiler:
    """Return what CXX names, or the first of `COMPILERS` that is there.

    Raises
    ------
    NoCompilerError
        If there is none.
    """
    wanted = shlex.split(os.environ.get("CXX", ""), posix=sys.platform != "win32")
    for command in (wanted,) if wanted else ([name] for name in COMPILERS):
        program = shutil.which(command[0])
        if program is not None:
            return Compiler((program, *command[1:]))
    looked_for = f"CXX={wanted[0]}" if wanted else ", ".join(COMPILERS)
    raise NoCompilerError(f"no C++ compiler was found ({looked_for})")


def compile_yardstick(compiler: Compiler, folder: Path) -> Path:
    """Compile the yardstick into a folder, and return the library.

    Raises
    ------
    NoCompilerError
        If the compiler fails.
    """
    library = folder / ("yardstick.dll" if sys.platform == "win32" else "yardstick.so")
    _run(compiler.arguments(SOURCE, library), folder)
    return library


def _run(arguments: list[str], folder: Path) -> None:
    try:
        done = subprocess.run(  # noqa: S603 - the compiler that the user's own environment names
            arguments,
            cwd=folder,
            capture_output=True,
            encoding="utf-8",
            errors="replace",  # a compiler speaks the console's language
            timeout=_SECONDS,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoCompilerError(f"{arguments[0]}: {error}") from error
    if done.returncode:
        raise NoCompilerError(f"{arguments[0]} failed:\n{(done.stderr or done.stdout).strip()}")
