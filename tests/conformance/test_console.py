"""Terminal output: plain when piped, silent when short."""

from __future__ import annotations

import io
import sys
from typing import TYPE_CHECKING

from rich.console import Console

from conformance import console as console_module
from conformance.console import Progress, make_console, print_document, tolerate_unprintable

if TYPE_CHECKING:
    import pytest


def test_text_is_printed_as_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    """No markup, no emoji, no wrapping, and no colour where there is no terminal."""
    text = "test_x[step_down] :smile: " + "0x3F800000 " * 30
    make_console().print(text, style="red")
    assert capsys.readouterr().out == f"{text}\n"


def test_no_color_is_respected(monkeypatch: pytest.MonkeyPatch) -> None:
    """A terminal that asks for no colour gets none."""
    monkeypatch.setenv("NO_COLOR", "1")
    assert make_console().no_color


def clock(monkeypatch: pytest.MonkeyPatch, *times: float) -> None:
    """Let the clock show these times, one after the other."""
    shown = iter(times)
    monkeypatch.setattr(console_module.time, "monotonic", lambda: next(shown))


def terminal() -> tuple[Console, io.StringIO]:
    """Return a console that takes itself for a terminal, and what it writes to."""
    output = io.StringIO()
    return Console(file=output, force_terminal=True, width=80), output


def test_progress_is_silent_at_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run of less than two seconds shows nothing."""
    console, output = terminal()
    clock(monkeypatch, 0.0, 1.9)
    with Progress(console) as progress:
        progress.say("file: 64 records")
    assert output.getvalue() == ""


def test_progress_of_a_long_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """After two seconds the terminal says what the run is doing."""
    console, output = terminal()
    progress = Progress(console)
    monkeypatch.setattr(progress, "_started", progress._started - 3.0)
    with progress:
        progress.say("file: 64 records")
        progress.say("file: 128 records")
    assert "file: 128 records" in output.getvalue()


def test_progress_needs_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe gets no progress, however long the run."""
    output = io.StringIO()
    progress = Progress(Console(file=output))
    monkeypatch.setattr(progress, "_started", progress._started - 3.0)
    with progress:
        progress.say("file: 64 records")
    assert output.getvalue() == ""


def test_unprintable_characters(monkeypatch: pytest.MonkeyPatch) -> None:
    """What the terminal's encoding lacks is printed as a question mark."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", stream)
    tolerate_unprintable()
    stream.write("48.38°")
    stream.flush()
    assert stream.buffer.getvalue() == b"48.38?"  # type: ignore[attr-defined]


def test_documents_are_for_files(monkeypatch: pytest.MonkeyPatch) -> None:
    """UTF-8 and line feeds, whatever the console writes; behind what was printed before."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding="cp1252", newline="\r\n")
    monkeypatch.setattr(sys, "stdout", stream)
    stream.write("\N{DEGREE SIGN}")
    print_document("SD-1…SD-12 → d\n")
    stream.flush()
    assert stream.buffer.getvalue() == b"\xb0" + "SD-1…SD-12 → d\n".encode()  # type: ignore[attr-defined]


def test_a_document_may_name_any_file(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also one whose name is not UTF-8: as JSON would write it, wherever the document goes."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    monkeypatch.setattr(sys, "stdout", stream)
    print_document('{"file": "a\udcff.yaml"}')
    stream.flush()
    assert stream.buffer.getvalue() == b'{"file": "a\\udcff.yaml"}'  # type: ignore[attr-defined]


def test_documents_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """There they are text as any other."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="replace")
    monkeypatch.setattr(stream, "isatty", lambda: True, raising=False)
    monkeypatch.setattr(sys, "stdout", stream)
    print_document("→")
    stream.flush()
    assert stream.buffer.getvalue() == b"?"  # type: ignore[attr-defined]


def test_progress_without_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """A run of hours may print a line now and then where nothing can be replaced."""
    output = io.StringIO()
    clock(monkeypatch, 0.0, 30.0, 60.0, 90.0, 120.0)
    with Progress(Console(file=output), plain_seconds=60.0) as progress:
        for shard in range(4):
            progress.say(f"shard {shard}")
    assert output.getvalue() == "shard 1\nshard 3\n"
