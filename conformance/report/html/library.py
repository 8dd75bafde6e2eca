"""The 3-D library that a report carries inside: plotly.js, from the package plotly."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from types import ModuleType

REMEDY: Final = "pip install 'retail-conformance[viz]'"
"""How to get what pictures need."""


class MissingVizError(ImportError):
    """Pictures were asked for, and what draws them is not installed."""

    def __init__(self, module: str) -> None:
        super().__init__(f"pictures need {module}: {REMEDY}", name=module)


def viz_module(name: str, package: str) -> ModuleType:
    """Import a module of the extra `viz`.

    Parameters
    ----------
    name : str
        Of the module.
    package : str
        The top-level package that it is in.

    Raises
    ------
    MissingVizError
        The package is not installed.
    """
    if find_spec(package) is None:
        raise MissingVizError(package)
    return import_module(name)


def plotly_source() -> str:
    """Return plotly.js, minified, with line feeds; raises `MissingVizError`."""
    source: str = viz_module("plotly.offline", "plotly").get_plotlyjs()
    return source.replace("\r\n", "\n")  # as browsers read it, who hash what they have read
