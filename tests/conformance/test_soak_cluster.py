"""A Dask cluster as a crew: workers may die, and nothing is lost or counted twice."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from concurrent.futures import Future
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis.errors import HypothesisDeprecationWarning
from soak_runs import FAMILY, SHARD_SIZE, engine, run

from conformance import cli, exit_codes
from conformance.journal import read_journal
from conformance.soak.cluster import Cluster, ClusterError

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parents[2]
HELPERS = ROOT / "tests" / "helpers"


class KilledWorkerError(Exception):
    """What Dask raises for a task that has ended several workers."""


class FakeClient:
    """Stands for Dask: runs what it is given in this process."""

    def __init__(self, address: str, timeout: float) -> None:
        assert timeout > 0.0
        if not address.startswith("tcp://"):
            raise ValueError(f"unknown address scheme in {address!r}")
        if address.endswith(":1"):
            raise OSError("timed out")
        self.status = "running"
        self.asked = 0
        self.killed = 0

    def get_executor(self, *, pure: bool) -> FakeClient:
        """Return what tasks are submitted to: each is a task of its own."""
        assert not pure
        return self

    def nthreads(self) -> dict[str, int]:
        """Return the workers, two of a thread each."""
        self.asked += 1
        return {"tcp://a": 1, "tcp://b": 1}

    def submit(self, task: Callable[..., Any], *args: Any) -> Future[Any]:
        """Run a task, or kill who does."""
        future: Future[Any] = Future()
        if self.killed:
            self.killed -= 1
            future.set_exception(KilledWorkerError("four workers died"))
        else:
            future.set_result(task(*args))
        return future

    def shutdown(self, *, wait: bool) -> None:
        """End the executor, for which nobody waits."""
        assert not wait

    def close(self) -> None:
        """End the client."""
        self.status = "closed"


@pytest.fixture
def dask(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the fake be Dask."""
    fake = SimpleNamespace(Client=FakeClient, KilledWorker=KilledWorkerError)
    monkeypatch.setitem(sys.modules, "distributed", fake)


@pytest.mark.usefixtures("dask")
def test_a_cluster_does_what_one_process_does(tmp_path: Path) -> None:
    """It has four tasks on their way for two threads, and asks now and then how many there are."""
    cluster = Cluster("tcp://here:8786")
    assert [cluster.places for _ in range(3)] == [4, 4, 4]
    assert cluster._client.asked == 1
    tally = run(tmp_path / "cluster", engine("Right"), crew=cluster)
    alone = run(tmp_path / "alone", engine("Right"))
    assert (tally.shards, tally.agreed) == (alone.shards, alone.agreed) == (3, 60)
    assert cluster._client.status == "closed"


@pytest.mark.usefixtures("dask")
def test_a_scheduler_that_goes_while_it_is_asked_is_not_a_full_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask's error about a closed connection is an `OSError`; the next task tells what has happened."""
    cluster = Cluster("tcp://here:8786")

    def closed(_: FakeClient) -> dict[str, int]:
        raise OSError("connection closed")

    monkeypatch.setattr(FakeClient, "nthreads", closed)
    assert cluster.places == 2


@pytest.mark.usefixtures("dask")
def test_a_shard_that_dask_has_given_up_is_tried_alone(tmp_path: Path) -> None:
    """Whoever died of another shard is not blamed for this one."""
    cluster = Cluster("tcp://here:8786")
    cluster._client.killed = 2
    assert run(tmp_path, engine("Right"), crew=cluster).shards == 3


@pytest.mark.usefixtures("dask")
def test_a_scheduler_that_goes_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The command ends as if it were broken off, and says how to go on."""
    size = ("--queries", "40", "--shard-size", "20", "--family", FAMILY, "-o", str(tmp_path))
    command = ["soak", *size, "--candidate", engine("Right"), "--scheduler", "tcp://here:8786"]

    def leaving(client: FakeClient, *_: Any) -> Future[Any]:
        client.status = "closing"
        future: Future[Any] = Future()
        future.cancel()
        future.set_running_or_notify_cancel()
        return future

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(FakeClient, "submit", leaving)
        assert cli.main(command) == exit_codes.BROKEN_OFF
    said = capsys.readouterr().out
    assert "the scheduler at tcp://here:8786 is gone\n" in said
    assert "--resume goes on\n" in said
    assert cli.main([*command, "--resume"]) == exit_codes.OK


@pytest.mark.usefixtures("dask")
@pytest.mark.parametrize("address", ["tcp://here:1", "here"])
def test_where_no_scheduler_is_nothing_is_begun(
    address: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The address is named; there is no empty journal in the way of the next try."""
    assert cli.main(["soak", "--queries", "1", "--scheduler", address, "-o", str(tmp_path)]) == 2
    assert f"found no scheduler at {address}: " in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.usefixtures("dask")
def test_processes_of_this_machine_are_no_cluster(capsys: pytest.CaptureFixture[str]) -> None:
    """Both at once means nothing."""
    assert cli.main(["soak", "--queries", "1", "--scheduler", "tcp://here:8786", "--jobs", "2"]) == 2
    assert "--jobs is about processes here" in capsys.readouterr().err


def test_without_the_extra_it_is_said_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The core install has no Dask."""
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ClusterError, match=r"pip install 'retail-conformance\[cluster\]'"):
        Cluster("tcp://here:8786")


@pytest.mark.usefixtures("dask")
def test_what_dask_does_beside_is_no_warning() -> None:
    """Of a worker's other threads Hypothesis knows nothing."""

    def warned() -> None:
        text = "Do not use the `random` module inside strategies; instead"
        warnings.warn(HypothesisDeprecationWarning(text), stacklevel=1)

    with warnings.catch_warnings():
        Cluster("tcp://here:8786").submit(warned).result()


def imported(module: str) -> Any:
    """Import a module, or skip the test by its name."""
    return pytest.importorskip(module, reason=f"skipped: no {module} (extra cluster)")


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="skipped: Windows has no such signal")
@pytest.mark.filterwarnings("default")
def test_a_worker_that_is_killed_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two real workers, one of which is killed while it asks: each shard is in the journal, once."""
    distributed = imported("distributed")
    paths = os.pathsep.join(map(str, (ROOT, HELPERS)))
    monkeypatch.setenv("PYTHONPATH", paths)
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options) as machines:
        cluster = Cluster(machines.scheduler_address)
        killed: list[int] = []

        class Killing(list[str]):
            """Kills a worker as soon as the first shard is there."""

            def append(self, line: str) -> None:
                if not killed and not line.startswith("0 of "):
                    killed.extend(cluster._client.run(os.getpid).values())
                    os.kill(killed[0], signal.SIGKILL)

        tally = run(tmp_path, engine("Right"), 10 * SHARD_SIZE, crew=cluster, said=Killing())
    assert len(killed) == 2
    assert (tally.shards, tally.agreed) == (10, 10 * SHARD_SIZE)
    noted = [record["shard"] for _, record in read_journal(tmp_path / "journal.jsonl") if "shard" in record]
    assert sorted(noted) == list(range(10))
