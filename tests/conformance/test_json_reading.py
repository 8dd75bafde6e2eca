"""JSON of people and engines, read strictly."""

from __future__ import annotations

import json
import math

import pytest

from conformance.json_reading import LooseJsonError, read_json


@pytest.mark.parametrize(
    "text", ['{"a": 1, "b": 2, "a": 1}', '[{"x": {"a": null, "a": 3}}]', '{"\\u0061": 1, "a": 2}']
)
def test_a_key_is_there_once(text: str) -> None:
    """At any depth, spelt alike or not, with the same value or another."""
    with pytest.raises(LooseJsonError) as caught:
        read_json(text)
    assert (caught.value.found, caught.value.expected) == ("the key 'a' twice in an object", "each key once")


def test_objects_beside_each_other_may_have_the_same_keys() -> None:
    """Twice in one object is a mistake, once in each of two is not."""
    assert read_json('[{"a": 1}, {"a": {"a": 2}}]') == [{"a": 1}, {"a": {"a": 2}}]


@pytest.mark.parametrize(
    ("name", "spelling"), [("NaN", '"nan"'), ("Infinity", '"inf"'), ("-Infinity", '"-inf"')]
)
def test_a_bare_constant_is_refused(name: str, spelling: str) -> None:
    """What Python reads beyond JSON has a spelling of ours, which the message names."""
    with pytest.raises(LooseJsonError) as caught:
        read_json(f'{{"d": [{name}]}}')
    assert caught.value.found == f"{name}, which is not JSON"
    assert caught.value.expected == f"the string {spelling}"


@pytest.mark.parametrize("text", ["-0", "[-0,1]", '{"d":-0}'])
def test_minus_zero_keeps_its_sign(text: str) -> None:
    """Written without a point, as .NET and Go do."""
    number = next(iter(_numbers(read_json(text))))
    assert type(number) is float
    assert math.copysign(1.0, number) == -1.0


def test_whole_numbers_stay_whole_beside_a_minus_zero() -> None:
    """Ids and counts are no floats; -0.5 and -0e0 are what they always were."""
    read = read_json("[-0, 0, 7, -7, -0.5, -0e0]")
    assert [type(number) for number in read] == [float, int, int, int, float, float]
    assert read == [0, 0, 7, -7, -0.5, 0.0]


def test_floats_are_read_by_whoever_asks() -> None:
    """The caller's function reads what has a point or an exponent, and nothing else."""
    assert read_json("[1, 2.5, 1e3, -0]", lambda text: 2.0 * float(text)) == [1, 5.0, 2000.0, 0]


def test_what_is_no_json_has_its_place() -> None:
    """The decoder's own error goes through."""
    with pytest.raises(json.JSONDecodeError) as caught:
        read_json('{"a": 1,}')
    assert caught.value.colno == 9


def _numbers(value: object) -> list[float]:
    if isinstance(value, dict):
        return [number for item in value.values() for number in _numbers(item)]
    if isinstance(value, list):
        return [number for item in value for number in _numbers(item)]
    assert isinstance(value, int | float)
    return [value]


@pytest.mark.parametrize("text", [r'"\ud83d"', r'{"\uDE00": 1}', r'[{"a": ["x\ude00\ud83d"]}]'])
def test_half_a_character_is_refused(text: str) -> None:
    """Wherever it stands: Python reads it, and cannot write it into any file."""
    with pytest.raises(LooseJsonError, match=r"^found half a character, U\+(D83D|DE00), expected text$"):
        read_json(text)


def test_a_character_of_two_halves_is_whole() -> None:
    """As is what only looks like half of one."""
    assert read_json(r'["\ud83d\ude00", "\\ud83d"]') == ["\U0001f600", "\\ud83d"]
