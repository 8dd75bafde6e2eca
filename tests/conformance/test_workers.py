"""What works for another process ends with it."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from conformance import workers
from conformance.commands.options import UsageError, check_jobs

if TYPE_CHECKING:
    from collections.abc import Mapping

ROOT = Path(__file__).parents[2]
SECONDS = 60.0
"""Longer than any of this takes, on a machine that does much else."""
PARENT = """
import sys, time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from conformance.mutation import run
from conformance.soak.crews import Processes

def make(initializer, *begin):
    return ProcessPoolExecutor(1, get_context("spawn"), initializer, begin)

def pools():
    yield "mutants", make(run._begin, (), ((), {}))
    yield "soak", Processes(1)
    if "stress" in sys.argv:
        from conformance.stress import models, runner, settings
        context = get_context("spawn")
        begin = settings.quick(), models.Spec("oracle", None), context.SimpleQueue(), context.Event()
        yield "stress", make(runner._open, *begin)

if __name__ == "__main__":
    made = list(pools())
    for name, pool in made:
        pool.submit(time.sleep, 0.0).result()
        print(name, flush=True)
    for _, pool in made:
        pool.submit(time.sleep, 600.0)
    print("at work", flush=True)
    time.sleep(600.0)
"""
"""Makes the pools of the commands as they do, and gives each something long to do."""
CHILD = """
import time
from conformance.workers import end_with_stdin
end_with_stdin()
print("at work", flush=True)
time.sleep(600.0)
"""


@pytest.fixture
def environment() -> Mapping[str, str]:
    """Return one in which this package is found."""
    return {**os.environ, "PYTHONPATH": str(ROOT)}


def test_workers_do_not_outlive_who_has_started_them(tmp_path: Path, environment: Mapping[str, str]) -> None:
    """Killed, it can tell them nothing. Its stdout, which they have as well, ends when all have ended."""
    program = tmp_path / "parent.py"
    program.write_text(PARENT, encoding="utf-8")
    names = ["mutants", "soak", *(["stress"] if find_spec("flint") else [])]
    command = [sys.executable, str(program), *names]
    with subprocess.Popen(command, stdout=subprocess.PIPE, encoding="utf-8", env=environment) as parent:
        assert parent.stdout is not None
        assert [parent.stdout.readline().rstrip() for _ in range(len(names) + 1)] == [*names, "at work"]
        parent.kill()
        assert parent.communicate(timeout=SECONDS) == ("", None)


@pytest.mark.parametrize("cores", [None, 1, 10_000])
def test_there_are_no_more_workers_than_there_can_be(
    cores: int | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One for each core; who asks for more by himself is told."""
    monkeypatch.setattr(os, "cpu_count", lambda: cores)
    jobs = workers.one_for_each_core()
    assert jobs == min(cores or 1, workers.MOST_WORKERS)
    check_jobs(jobs)
    with pytest.raises(UsageError, match=rf"^--jobs 10000: from 1 to {workers.MOST_WORKERS} processes"):
        check_jobs(10_000)


def test_a_worker_ends_with_its_stdin(environment: Mapping[str, str]) -> None:
    """As one does that no pool has started."""
    command = [sys.executable, "-c", CHILD]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8", env=environment
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline().rstrip() == "at work"
        assert child.communicate(timeout=SECONDS) == ("", None)
        assert child.returncode == 130


@pytest.mark.skipif(os.name == "nt", reason="skipped: Windows has no signals to block")
def test_a_process_is_born_deaf_to_interrupts(environment: Mapping[str, str]) -> None:
    """An interrupt that comes while it is started reaches who has started it, afterwards, and nobody else."""
    program = """
import os, signal, subprocess, sys
from conformance.workers import without_interrupts

child = "import signal; signal.raise_signal(signal.SIGINT); print('deaf')"
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    with without_interrupts():
        signal.raise_signal(signal.SIGINT)
        print(subprocess.run([sys.executable, "-c", child], stdout=subprocess.PIPE, text=True).stdout)
except KeyboardInterrupt:
    print("interrupted")
"""
    done = subprocess.run(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, encoding="utf-8", env=environment, check=True
    )
    assert done.stdout.split() == ["deaf", "interrupted"]
