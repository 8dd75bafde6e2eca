"""The C++ bridge of the documents: compiled, tried and compared, where there is a compiler."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from faux import SECONDS, command_of
from shipped_vectors import VECTORS, library

from conformance.bench.native.compiler import MSVC_FLAGS, NoCompilerError, find_compiler
from conformance.candidates.command_candidate import CommandCandidate
from conformance.protocol.smoke import Mark, examine
from conformance.verification import verify_file

SOURCE = Path(__file__).parents[2] / "docs" / "examples" / "cpp_bridge" / "bridge.cpp"
FLAGS = ("-std=c++17", "-O0", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off")
PASSED = {"polygon.jsonl": 526, "boundary_polygon.jsonl": 434}
"""Every record of the files that is not advisory."""


@pytest.fixture(scope="module")
def bridge(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Compile the bridge and return its command."""
    try:
        compiler = find_compiler()
    except NoCompilerError as error:
        pytest.skip(f"skipped: {error}")
    folder = tmp_path_factory.mktemp("bridge")
    program = folder / "bridge.exe"
    if compiler.is_msvc:
        flags = [flag for flag in MSVC_FLAGS if flag != "/LD"]
        probe = [*compiler.command, "/nologo", "/EP"]
        build = [*compiler.command, *flags, str(SOURCE), f"/Fe{program}", f"/Fo{folder / 'bridge.obj'}"]
    else:
        probe = [*compiler.command, "-E", "-x", "c++"]
        build = [*compiler.command, *FLAGS, str(SOURCE), "-o", str(program)]
    header = folder / "header.cpp"
    header.write_text("#if !__has_include(<nlohmann/json.hpp>)\n#error\n#endif\n", encoding="utf-8")
    if subprocess.run([*probe, str(header)], capture_output=True, check=False).returncode:
        pytest.skip("skipped: nlohmann/json.hpp is absent (Debian: nlohmann-json3-dev)")
    subprocess.run(build, cwd=folder, check=True, capture_output=True)
    return command_of(program)


@pytest.mark.parametrize("file", PASSED)
def test_the_bridge_agrees_with_retail(file: str, bridge: str) -> None:
    """On every bit of every operation on polygons."""
    candidate = CommandCandidate(bridge, read_timeout=SECONDS)
    tally = verify_file(VECTORS / file, candidate, library())
    assert candidate.close() == ()
    assert (tally.passed, tally.failed, tally.skipped.total()) == (PASSED[file], 0, 0)


def test_the_bridge_skips_the_rest(bridge: str) -> None:
    """By name, and counted; two operations on planes are answered."""
    candidate = CommandCandidate(bridge, read_timeout=SECONDS)
    tally = verify_file(VECTORS / "math.jsonl", candidate, library())
    assert candidate.close() == ()
    assert (tally.passed, tally.failed, tally.skipped.total()) == (53, 0, 215)
    assert tally.skipped["operation frame_cache is not declared"] == 15


def test_the_bridge_keeps_the_contract(bridge: str, tmp_path: Path) -> None:
    """No step of the examination goes wrong, and every operation answers as retail does."""
    for name in ("geometries.jsonl", "math.jsonl", "polygon.jsonl"):
        shutil.copy(VECTORS / name, tmp_path)
    findings = list(examine(bridge, SECONDS, lambda _said: None, vectors=tmp_path))
    assert {found.mark for found in findings} == {Mark.OK}
    assert findings[1].said.startswith("15 of 15 answer as retail does: ")
