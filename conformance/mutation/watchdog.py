"""A limit on the processor time of a piece of pure Python; what other processes do does not count."""

from __future__ import annotations

import ctypes
import gc
import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

_INTERVAL: Final = 0.05
"""How often the time is looked at, seconds."""


class OutOfTimeError(BaseException):
    """The limit is reached; not an `Exception`, so that the code that is limited does not swallow it."""


class Watchdog:
    """Ends what runs for too long in the thread that has made it.

    The interpreter raises the error between two of its instructions, on every system alike.
    """

    def __init__(self) -> None:
        self._thread = ctypes.c_ulong(threading.get_ident())
        self._lock = threading.Lock()
        self._deadline: float | None = None
        self._raised = False
        threading.Thread(target=self._watch, name="watchdog", daemon=True).start()

    @contextmanager
    def limit(self, seconds: float) -> Iterator[None]:
        """Raise `OutOfTimeError` inside the block, if it takes more processor time than this.

        Garbage is not collected meanwhile: callbacks of the collector, such as Hypothesis', swallow errors
        that arrive while they run, and what is limited would go on for ever.
        """
        collected = gc.isenabled()
        gc.disable()
        try:
            with self._limited(seconds):
                yield
        finally:
            if collected:
                gc.enable()

    @contextmanager
    def _limited(self, seconds: float) -> Iterator[None]:
        self._raised = False
        self._deadline = time.process_time() + seconds
        try:
            yield
        except OutOfTimeError:
            self._raised = False
            raise
        finally:
            with self._lock:
                self._deadline = None
            # An error that is on its way arrives here: taken back, it would leave the interpreter waiting
            # for it, and a traced function that follows would never begin.
            while self._raised:
                time.sleep(0)

    def _watch(self) -> None:
        while True:
            time.sleep(_INTERVAL)
            with self._lock:
                if self._deadline is not None and time.process_time() > self._deadline:
                    self._deadline = None
                    self._raised = True
                    ctypes.pythonapi.PyThreadState_SetAsyncExc(self._thread, ctypes.py_object(OutOfTimeError))
