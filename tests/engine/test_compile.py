"""The compilation cache: keyed by all sources, and dispensable."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from typing import TYPE_CHECKING, Any, NoReturn

import engine
from engine.kernels import compile as kernel_compile
from engine.kernels.compile import KERNELS, KernelCache, entry, source_digest
from engine.kernels.vector import normalize_check_small

if TYPE_CHECKING:
    from pathlib import Path

    import pytest

QUESTION = "from engine.kernels.vector import normalize_check_small as n; print(n(0.001, 0.0, 0.0))"


def copied_engine(tmp_path: Path) -> Path:
    """Copy the package without its caches; return the copy."""
    copy = tmp_path / "engine"
    shutil.copytree(KERNELS.parent, copy, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def answer(folder: Path) -> str:
    """Ask a kernel of the package in a folder, in a process of its own."""
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    environment.pop("NUMBA_CACHE_DIR", None)
    run = subprocess.run(
        [sys.executable, "-c", QUESTION],
        env=environment,
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return run.stdout.strip()


def test_a_changed_constant_is_noticed(tmp_path: Path) -> None:
    """Compiled code is not used again after an edit of another file that it was made of."""
    copy = copied_engine(tmp_path)
    assert answer(tmp_path) == "(False, 1.0, 0.0, 0.0)"
    cached = list((copy / "kernels" / "__pycache__").glob("vector.normalize_check_small*.nbc"))
    assert cached
    constants = copy / "constants.py"
    text = constants.read_text(encoding="utf-8")
    assert "EPS: Final = 0.00019999999494757503" in text
    constants.write_text(text.replace("EPS: Final = 0.0001", "EPS: Final = 0.0101"), encoding="utf-8")
    assert answer(tmp_path) == "(True, 0.001, 0.0, 0.0)"


def test_the_digest_covers_kernels_layout_and_constants(tmp_path: Path) -> None:
    """A change in any of these files changes it, and nothing else does."""
    copy = copied_engine(tmp_path)
    before = source_digest(copy / "kernels")
    assert before == source_digest()
    (copy / "world.py").write_text("", encoding="utf-8")
    source_digest.cache_clear()
    assert source_digest(copy / "kernels") == before
    for name in ("layout/world.py", "body_layout.py", "constants.py", "kernels/rounding.py"):
        file = copy / name
        file.write_text(file.read_text(encoding="utf-8") + "\n# changed\n", encoding="utf-8")
        source_digest.cache_clear()
        after = source_digest(copy / "kernels")
        assert after != before
        before = after


def test_kernels_are_cached_with_the_digest() -> None:
    """A kernel's cache is ours, in a folder that can be written."""
    cache: Any = normalize_check_small._cache  # type: ignore[attr-defined]
    assert isinstance(cache, KernelCache)
    assert cache._impl.locator.get_source_stamp() == source_digest()


def test_without_a_folder_for_the_cache_kernels_still_compile(monkeypatch: pytest.MonkeyPatch) -> None:
    """In a read-only installation code is compiled in each process."""

    def refuse(_function: Any) -> NoReturn:
        raise RuntimeError("no locator available")

    monkeypatch.setattr(kernel_compile, "KernelCache", refuse)

    @entry
    def twice(x: float) -> float:
        return x + x

    assert twice(2.0) == 4.0
    assert engine.__all__
