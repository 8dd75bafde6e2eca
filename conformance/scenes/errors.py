"""What is wrong with a scene, and where."""

from __future__ import annotations


class SceneError(ValueError):
    """A scene that no candidate may be given.

    Attributes
    ----------
    path : str
        Where in the scene, like ``cells[0].geometry.polygons[3]``.
    found : str
        What is there, with the offending number.
    expected : str
        What would be right.
    """

    def __init__(self, path: str, found: str, expected: str) -> None:
        super().__init__(path, found, expected)
        self.path = path
        self.found = found
        self.expected = expected

    def __str__(self) -> str:
        where = f"{self.path}: " if self.path else ""
        return f"{where}found {self.found}, expected {self.expected}"

    def under(self, prefix: str) -> SceneError:
        """Return the same error seen from further out: its path prefixed with `prefix`."""
        return SceneError(join_path(prefix, self.path), self.found, self.expected)


def join_path(prefix: str, path: str) -> str:
    """Join two parts of a path; an index needs no dot before it."""
    if not prefix or not path:
        return prefix or path
    return f"{prefix}{path}" if path.startswith("[") else f"{prefix}.{path}"
