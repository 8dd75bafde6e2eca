"""Run a target under libFuzzer: ``python -m conformance.fuzz.worker TARGET TALLY [libFuzzer's arguments]``.

`conformance fuzz` starts it; libFuzzer ends the process by itself, and so does the end of stdin. Two things
are left out that take two thirds of the time and are none of our code: guesses of what was meant, and the
second look at a syntax error. Replaying the corpus, as the tests do, runs them.
"""

from __future__ import annotations

import difflib
import sys
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Final

import atheris

from conformance.fuzz.tally import Tally
from conformance.fuzz.targets import TARGETS
from conformance.fuzz.text_mutations import mutate
from conformance.workers import end_with_stdin

REWORDED: Final = 64
"""Characters of the longest text whose syntax error is also looked up with PyYAML's slow parser."""


def main() -> None:
    """Fuzz the target that the command line names, and count in the file that it names."""
    end_with_stdin()
    target = TARGETS[sys.argv[1]]
    module: Any = difflib
    module.get_close_matches = lambda *_args, **_options: []  # guesses of what was meant
    with atheris.instrument_imports(include=[target.watched], exclude=_kernels()):
        run = target.load()
        yaml_source: Any = import_module("conformance.yaml_source")
    for file in sorted(target.corpus.iterdir()):
        run(file.read_bytes())  # kernels are compiled now, which is no hang
    yaml_source.MAX_REWORDED = REWORDED
    tally = Tally(Path(sys.argv[2]))

    def once(data: bytes) -> None:
        tally.count(accepted=run(data))

    changes = {"custom_mutator": _change_text} if target.is_text else {}
    atheris.Setup([sys.argv[0], *sys.argv[3:]], once, **changes)
    atheris.Fuzz()


def _change_text(data: bytes, limit: int, seed: int) -> bytes:
    return mutate(data, limit, seed, atheris.Mutate)


def _kernels() -> list[str]:
    """List the modules whose functions Numba compiles, which it could not do to watched ones."""
    package = find_spec("engine")
    folders = package.submodule_search_locations if package else None
    files = [file for folder in folders or () for file in Path(folder, "kernels").glob("*.py")]
    return [f"engine.kernels.{file.stem}" for file in files]


if __name__ == "__main__":
    main()
