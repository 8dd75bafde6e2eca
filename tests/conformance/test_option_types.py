"""Numbers of options: what is read, and what is refused."""

from __future__ import annotations

import argparse

import pytest

from conformance import cli
from conformance.option_types import positive, whole_from


@pytest.mark.parametrize(
    ("text", "number"), [("3", 3), ("1e3", 1000), (" 7 ", 7), ("12345678901234567", 12345678901234567)]
)
def test_a_whole_number(text: str, number: int) -> None:
    """Written out, every digit counts; a round one may have an exponent."""
    read = whole_from(3)(text)
    assert (read, type(read)) == (number, int)


@pytest.mark.parametrize("text", ["2", "-3", "3.5", "1e400", "nan", "inf", "three", ""])
def test_what_is_no_number_of_things(text: str) -> None:
    """Too few, a part of one, endless, or none at all: what was found and what was expected is said."""
    with pytest.raises(argparse.ArgumentTypeError) as caught:
        whole_from(3)(text)
    assert str(caught.value) == f"found {text}, expected a whole number, 3 or more"


@pytest.mark.parametrize("text", ["0", "-1", "nan", "inf", "1e10", "soon"])
def test_a_time_is_positive_and_ends(text: str) -> None:
    """And has a unit, which is said."""
    assert positive("seconds")("0.25") == 0.25
    with pytest.raises(argparse.ArgumentTypeError) as caught:
        positive("seconds")(text)
    limits = "at most 1e+06" if text in {"inf", "1e10"} else "more than 0"
    assert str(caught.value) == f"found {text}, expected seconds, {limits}"


@pytest.mark.parametrize(
    "arguments",
    [
        ("verify", "x.jsonl", "--max-differences", "-1"),
        ("export", "-o", "x.jsonl", "--poses", "-1"),
        ("errors", "--draws", "0"),
        ("report", "-o", "x.html", "--poses", "1.5"),
        ("explain", "some-case", "--depth", "0"),
    ],
)
def test_a_command_says_what_it_expected(
    arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit status 2, before anything is read or run."""
    with pytest.raises(SystemExit) as caught:
        cli.main(list(arguments))
    assert caught.value.code == 2
    assert f"found {arguments[-1]}, expected a whole number, " in capsys.readouterr().err
