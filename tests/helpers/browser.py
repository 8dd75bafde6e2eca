"""A headless Chromium, driven over the WebDriver protocol (W3C) by ChromeDriver: no package is needed."""

from __future__ import annotations

import base64
import json
import shutil
import socket
import subprocess
import time
from contextlib import contextmanager
from http import HTTPStatus
from http.client import HTTPConnection
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_FLAGS = (
    "--headless",
    "--no-sandbox",  # as root, in containers
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-unsafe-swiftshader",  # WebGL without a graphics card
    "--window-size=1400,1000",
)
SECONDS = 60.0
"""How long anything may take."""
_PAUSE = 0.05
"""Seconds after which it is looked again."""


def missing() -> str:
    """Say what of a browser is not on this machine; nothing if all of it is."""
    names = {"ChromeDriver": ("chromedriver",), "Chromium": ("chromium", "chromium-browser", "google-chrome")}
    absent = [name for name, programs in names.items() if not any(map(shutil.which, programs))]
    return f"not on this machine: {', '.join(absent)}" if absent else ""


class BrowserError(Exception):
    """The browser could not do what it was told."""


class Browser:
    """A window."""

    def __init__(self, session: str) -> None:
        self._session = session

    def open(self, url: str) -> None:
        """Go to a page."""
        _ask("POST", f"{self._session}/url", {"url": url})

    def run(self, script: str, *arguments: Any) -> Any:
        """Return what the body of a function returns in the page."""
        return _ask("POST", f"{self._session}/execute/sync", {"script": script, "args": list(arguments)})

    def wait(self, script: str) -> None:
        """Wait until an expression is true in the page; raises `TimeoutError`."""
        until = time.monotonic() + SECONDS
        while not self.run(f"return Boolean({script})"):
            if time.monotonic() > until:
                raise TimeoutError(script)
            time.sleep(_PAUSE)

    def console(self) -> list[str]:
        """Return what went wrong in the page since the last call."""
        lines = _ask("POST", f"{self._session}/se/log", {"type": "browser"})
        return [line["message"] for line in lines if line["level"] == "SEVERE"]

    def screenshot(self, path: Path) -> None:
        """Write what is seen, as PNG."""
        path.write_bytes(base64.b64decode(_ask("GET", f"{self._session}/screenshot")))


@contextmanager
def browser(profile: Path) -> Iterator[Browser]:
    """Start a browser with an empty profile, and end it with the block."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    driver = subprocess.Popen(
        [shutil.which("chromedriver") or "chromedriver", f"--port={port}"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        root = f"http://127.0.0.1:{port}"
        until_ready(root, driver)
        options = {"args": [*_FLAGS, f"--user-data-dir={profile}"]}
        wanted = {"goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        made = _ask("POST", f"{root}/session", {"capabilities": {"alwaysMatch": wanted}})
        session = f"{root}/session/{made['sessionId']}"
        try:
            yield Browser(session)
        finally:
            _ask("DELETE", session)
    finally:
        driver.terminate()
        driver.wait(timeout=SECONDS)


def until_ready(root: str, driver: subprocess.Popen[bytes]) -> None:
    """Wait until the driver takes sessions; raises `BrowserError` if it ends, or does not in time."""
    until = time.monotonic() + SECONDS
    found = "no answer"
    while time.monotonic() < until:
        if driver.poll() is not None:
            raise BrowserError(f"ChromeDriver ended with exit status {driver.returncode}")
        try:
            status = _ask("GET", f"{root}/status")
        except (ConnectionError, TimeoutError) as error:
            found = str(error)
        else:
            if status["ready"]:
                return
            found = str(status)
        time.sleep(_PAUSE)
    raise BrowserError(f"ChromeDriver is not ready within {SECONDS:g} s: {found}")


def _ask(method: str, url: str, body: Any = None) -> Any:
    parts = urlsplit(url)
    connection = HTTPConnection(parts.netloc, timeout=SECONDS)
    try:
        data = None if body is None else json.dumps(body)
        connection.request(method, parts.path, data, {"Content-Type": "application/json"})
        reply = connection.getresponse()
        value = json.load(reply)["value"]
        if reply.status != HTTPStatus.OK:
            raise BrowserError(value["message"])
        return value
    finally:
        connection.close()
