"""Makes this folder runnable by pytest also where the plug-in is not installed as an entry point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from conformance import plugin, profiles
from conformance.agreement import agree, record_counts

if TYPE_CHECKING:
    import pytest

__all__ = ["agree", "record_counts"]

profiles.register()


def pytest_addoption(parser: pytest.Parser, pluginmanager: pytest.PytestPluginManager) -> None:
    """Load the plug-in, once."""
    del parser
    if not pluginmanager.is_registered(plugin):
        pluginmanager.register(plugin, "conformance")
