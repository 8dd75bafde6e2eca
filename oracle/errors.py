"""What the oracle raises."""

from __future__ import annotations


class OracleError(Exception):
    """Base of the oracle's own errors."""


class NotPortedError(OracleError):
    """A query reached a part of retail that has no port yet.

    Attributes
    ----------
    what : str
        What is missing, with the document that specifies it.
    """

    def __init__(self, what: str) -> None:
        super().__init__(f"not ported yet: {what}")
        self.what = what


class UndeterminedError(OracleError):
    """A query reached a branch of which the specification does not know how retail takes it.

    Attributes
    ----------
    what : str
        What happened, with the place in the specification.
    """

    def __init__(self, what: str) -> None:
        super().__init__(f"retail's answer is not known: {what}")
        self.what = what


class MissingChildError(OracleError):
    """A physics query reached an interior node that lacks a child.

    Attributes
    ----------
    node : object
        The node.
    """

    def __init__(self, node: object) -> None:
        super().__init__(f"interior node of a physics tree without both children: {node!r}")
        self.node = node
