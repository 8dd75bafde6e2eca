"""A Dask cluster as a crew: other machines, whose workers come and go (extra `cluster`)."""

from __future__ import annotations

import math
import time
import warnings
from concurrent.futures import CancelledError
from contextlib import suppress
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, ParamSpec, TypeVar

from hypothesis.errors import HypothesisDeprecationWarning

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future

P = ParamSpec("P")
T = TypeVar("T")

REMEDY: Final = "pip install 'retail-conformance[cluster]'"
_RANDOM: Final = "Do not use the `random` module inside strategies"
_PATIENCE: Final = 20.0
"""How long to wait for a scheduler, seconds."""
_RUNNING: Final = "running"
"""What Dask calls a client whose scheduler is there."""
_LOOK_SECONDS: Final = 5.0
"""How often to look how many workers there are."""


class ClusterError(RuntimeError):
    """There is no cluster to work with: the extra is not installed, or no scheduler answers."""


class Cluster:
    """Runs tasks on the workers of a Dask scheduler; what a lost worker was doing is done by another one.

    Parameters
    ----------
    address : str
        Of the scheduler, such as ``tcp://10.0.0.1:8786``.

    Raises
    ------
    ClusterError
        Dask is not installed, or no scheduler answers there.
    """

    chances = 2

    def __init__(self, address: str) -> None:
        try:
            distributed: Any = import_module("distributed")
        except ImportError as error:
            raise ClusterError(f"--scheduler needs Dask: {REMEDY}") from error
        # The scheduler itself gives what a dead worker was doing to the next; after four it gives up, for all
        # that the fourth was to do.
        self.lost: tuple[type[BaseException], ...] = (distributed.KilledWorker, CancelledError)
        self._address = address
        try:
            self._client: Any = distributed.Client(address, timeout=_PATIENCE)
        except (OSError, ValueError) as error:
            raise ClusterError(f"found no scheduler at {address}: {error}") from error
        # The same shard twice is two tasks: otherwise the second would be given the first one's failure.
        self._executor = self._client.get_executor(pure=False)
        self._places = 2
        self._looked = -math.inf

    @property
    def places(self) -> int:
        """Twice as many as there are threads now; two if there is nobody, who may be on the way."""
        if self._client.status == _RUNNING and time.monotonic() - self._looked >= _LOOK_SECONDS:
            self._looked = time.monotonic()
            with suppress(OSError):  # the scheduler is gone just now: the next task will tell
                self._places = 2 * max(1, sum(self._client.nthreads().values()))
        return self._places

    def submit(self, task: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Give somebody a task.

        Raises
        ------
        ClusterError
            The scheduler is gone.
        """
        if self._client.status != _RUNNING:
            raise ClusterError(f"the scheduler at {self._address} is gone")
        future: Future[T] = self._executor.submit(_on_a_worker, task, *args, **kwargs)
        return future

    def close(self) -> None:
        """Take back what was not begun, and leave the cluster as it is."""
        self._executor.shutdown(wait=False)
        self._client.close()


def _on_a_worker(task: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T:
    """Run a task in a thread of a worker, whose other threads do what they like.

    Hypothesis warns if `random` is used while it draws. Here that is Dask, not a strategy; and no strategy
    of ours would gain by it, because Hypothesis sets its seed.
    """
    warnings.filterwarnings("ignore", message=_RANDOM, category=HypothesisDeprecationWarning)
    return task(*args, **kwargs)
