"""What the engine cannot be asked, though it performs the operation."""

from __future__ import annotations


class NotAskableError(Exception):
    """A query has inputs that the engine has no place for; such a query is skipped."""
