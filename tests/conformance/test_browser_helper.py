"""The browser of the tests waits for its driver, and not forever."""

from __future__ import annotations

import subprocess
import sys

import browser
import pytest


def run(code: str) -> subprocess.Popen[bytes]:
    """Start Python instead of a driver."""
    return subprocess.Popen([sys.executable, "-c", code])


def test_a_driver_that_ends_is_not_waited_for() -> None:
    """The port that nobody listens on is asked no more, and the exit status is told."""
    with run("raise SystemExit(3)") as driver:
        driver.wait()
        with pytest.raises(browser.BrowserError, match="ended with exit status 3"):
            browser.until_ready("http://127.0.0.1:9", driver)


@pytest.mark.parametrize("status", [{"ready": False, "message": "busy"}, ConnectionRefusedError("refused")])
def test_a_driver_that_is_never_ready_is_given_up(
    status: dict[str, object] | ConnectionError, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether it says so or does not answer: what was found last is told."""

    def ask(method: str, url: str) -> dict[str, object]:
        assert (method, url) == ("GET", "http://127.0.0.1:9/status")
        if isinstance(status, ConnectionError):
            raise status
        return status

    monkeypatch.setattr(browser, "SECONDS", 0.2)
    monkeypatch.setattr(browser, "_ask", ask)
    with run("import time; time.sleep(60)") as driver:
        try:
            with pytest.raises(browser.BrowserError, match=r"not ready within 0\.2 s: .*(busy|refused)"):
                browser.until_ready("http://127.0.0.1:9", driver)
        finally:
            driver.kill()
