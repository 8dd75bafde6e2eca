"""The targets by name, and what a fuzzer watches while each runs."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

CORPUS: Final = Path(__file__).parent / "corpus"
"""A folder of inputs for each target, found by fuzzing and kept because each reaches something new."""


@dataclass(frozen=True, slots=True)
class Target:
    """What is fuzzed.

    Attributes
    ----------
    name : str
        What the command line calls it.
    what : str
        What it reads, for people.
    module : str
        Where its ``run`` is: a function of bytes that says whether they were accepted.
    watched : str
        Package whose branches guide the fuzzer; kernels, which are compiled, are not among them.
    is_text : bool
        Whether inputs are text, and are mostly changed as such (`conformance.fuzz.text_mutations`).
    """

    name: str
    what: str
    module: str
    watched: str
    is_text: bool

    @property
    def corpus(self) -> Path:
        """Folder of its kept inputs."""
        return CORPUS / self.name

    def load(self) -> Callable[[bytes], bool]:
        """Import it and return its function."""
        run: Callable[[bytes], bool] = import_module(self.module).run
        return run


TARGETS: Final[Mapping[str, Target]] = MappingProxyType(
    {
        target.name: target
        for target in (
            Target(
                "yaml",
                "files of cases, from bytes to queries",
                "conformance.fuzz.yaml_target",
                "conformance",
                is_text=True,
            ),
            Target(
                "vectors",
                "vector files with their shared geometry and worlds",
                "conformance.fuzz.vector_target",
                "conformance",
                is_text=True,
            ),
            Target(
                "world",
                "the engine's world compiler, and a move in what it accepts",
                "conformance.fuzz.world_target",
                "engine",
                is_text=False,
            ),
        )
    }
)
