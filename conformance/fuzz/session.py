"""One run of the fuzzer: its worker processes, what they say while they run, and what came of it."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import time
from collections import deque
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance.fuzz.tally import new_tally, read_tally

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from conformance.fuzz.targets import Target

LONGEST_INPUT: Final = 1024
"""Bytes of an input; longer ones are slower and seldom reach more."""
LONGEST_RUN: Final = 60
"""Seconds after which one execution is a hang."""
MOST_MEMORY: Final = 3000
"""MB that the worker may take."""
MOST_RUNS: Final = 100_000
"""Executions of a process; the next goes on from what it kept, with another seed and fresh memory."""
BROKEN_OFF: Final = "broken off"
"""How a run ends that Ctrl-C has ended."""
_SHOWN_LINES: Final = 40
_PULSE: Final = re.compile(r"^#(\d+)\s.*exec/s: (\d+)")
_WRITTEN: Final = re.compile(r"Test unit written to (.+)$")


class FuzzerMissingError(Exception):
    """Atheris, which comes with the extra `fuzz`, is not installed."""

    def __init__(self) -> None:
        super().__init__(
            "the fuzzer is not installed: pip install 'retail-conformance[fuzz]' (atheris, for Linux)"
        )


@dataclass(slots=True)
class Report:
    """What came of a run.

    Attributes
    ----------
    executed, accepted : int
        How many inputs were given to the target, and how many of them it accepted.
    seconds : float
        Wall time.
    finding : str
        File of the input that raised, hung or took too much memory; empty if none did.
    ended : str
        How the run ended, if not by itself.
    output : tuple of str
        The last lines that the worker wrote.
    """

    executed: int = 0
    accepted: int = 0
    seconds: float = 0.0
    finding: str = ""
    ended: str = ""
    output: tuple[str, ...] = ()


def check_fuzzer() -> None:
    """Raise `FuzzerMissingError` if atheris is not installed."""
    if find_spec("atheris") is None:
        raise FuzzerMissingError


def fuzz(
    target: Target,
    folders: Sequence[Path],
    *,
    runs: int,
    seed: int,
    findings: Path,
    say: Callable[[str], None],
) -> Report:
    """Run a target's workers, one after the other; Ctrl-C ends them early, and what is known is reported.

    Parameters
    ----------
    target : Target
        What is fuzzed.
    folders : sequence of Path
        Inputs to start from; new ones are written to the first.
    runs : int
        Executions; every worker begins with all inputs of the folders, which count.
    seed : int
        Of the fuzzer's choices, one more for each further worker; 0 takes new ones.
    findings : Path
        Folder, already there, into which an input that fails is written.
    say : callable
        Where to say how far it is.

    Raises
    ------
    FuzzerMissingError
    """
    check_fuzzer()
    report, started = Report(), time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        tally = Path(scratch, "tally")
        for number in count():
            left = min(runs - report.executed, MOST_RUNS)
            if left <= 0 or report.ended:
                break
            command = [
                *(sys.executable, "-m", "conformance.fuzz.worker", target.name, str(tally)),
                *(f"-runs={left}", f"-seed={seed + number if seed else 0}", f"-max_len={LONGEST_INPUT}"),
                *(f"-timeout={LONGEST_RUN}", f"-rss_limit_mb={MOST_MEMORY}", f"-artifact_prefix={findings}/"),
                *map(str, folders),
            ]
            _run_worker(command, tally, report, say)
    report.seconds = time.monotonic() - started
    return report


def _run_worker(command: Sequence[str], tally: Path, report: Report, say: Callable[[str], None]) -> None:
    """Run a worker to its end, and add to the report what came of it."""
    new_tally(tally)
    with subprocess.Popen(  # noqa: S603 - our own module, with arguments of our own
        command,
        stdin=subprocess.PIPE,  # held open as long as this process lives
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        encoding="utf-8",
        errors="replace",
    ) as worker:
        try:
            _follow(worker.stderr or (), report, say)
        except KeyboardInterrupt:
            worker.terminate()
            report.ended = BROKEN_OFF
    executed, accepted = read_tally(tally)
    report.executed += executed
    report.accepted += accepted
    if not report.ended and worker.returncode:
        report.ended = _ending(worker.returncode)
    elif not report.ended and not executed:
        report.ended = "the worker ran nothing"


def _follow(lines: Iterable[str], report: Report, say: Callable[[str], None]) -> None:
    last: deque[str] = deque(maxlen=_SHOWN_LINES)
    for line in lines:
        if pulse := _PULSE.match(line):
            say(f"{report.executed + int(pulse[1])} executions, {pulse[2]} a second")
            continue
        last.append(line.rstrip())
        report.output = tuple(last)
        if written := _WRITTEN.search(line):
            report.finding = written[1]


def _ending(code: int) -> str:
    return f"the worker was killed by signal {-code}" if code < 0 else f"the worker ended with code {code}"
