"""Engines in Python, for tests of ``mod:`` candidates."""

from __future__ import annotations

from conformance.query import Query, Result, Skipped

NOT_CALLABLE = 3


class Blocks:
    """Answers `block_offset`, each query in another way."""

    ops = ("block_offset", "calc_friction")
    features = ()

    def answer(self, query: Query) -> object:
        """Do what the label says."""
        match query.label:
            case "skip":
                return Skipped("not today")
            case "raise":
                raise LookupError("no cell 7")
            case "none":
                return None
            case "field":
                return Result({"v": (0.0, 0.0, 0.0), "speed": 1})
            case "short":
                return Result({"v": [0.0]})
            case _:
                return Result({"v": (0.1, 0, -0.0)})


class Mute:
    """Answers nothing."""


def failing() -> Blocks:
    """Do not make an engine."""
    raise OSError("no licence")
