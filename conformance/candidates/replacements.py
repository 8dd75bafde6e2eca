"""Making the oracle wrong for a while: attributes, constants and pieces of source that are replaced."""

from __future__ import annotations

import inspect
import sys
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache
from textwrap import dedent
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator


class Replacement(Protocol):
    """Something of the oracle that is replaced for a while."""

    def targets(self) -> Iterator[tuple[object, str, Any]]:
        """Yield each owner, the name of its attribute, and the wrong value."""
        ...


@dataclass(frozen=True, slots=True)
class Method:
    """One attribute of one class or module.

    Attributes
    ----------
    owner : object
        The class or module.
    name : str
        The attribute.
    make : callable
        Gets retail's version, returns the wrong one.
    """

    owner: object
    name: str
    make: Callable[[Any], Any]

    def targets(self) -> Iterator[tuple[object, str, Any]]:
        """Yield the one attribute."""
        yield self.owner, self.name, self.make(vars(self.owner)[self.name])


@dataclass(frozen=True, slots=True)
class Edit:
    """One function of one class or module, with pieces of its source replaced.

    Attributes
    ----------
    owner : object
        The class or module.
    name : str
        The function.
    changes : tuple of (str, str)
        What retail's source says and what the wrong one says; see `edited`.
    """

    owner: object
    name: str
    changes: tuple[tuple[str, str], ...]

    def targets(self) -> Iterator[tuple[object, str, Any]]:
        """Yield the one function."""
        retail = vars(self.owner)[self.name]
        if isinstance(retail, staticmethod):
            yield self.owner, self.name, staticmethod(edited(retail.__func__, *self.changes))
        else:
            yield self.owner, self.name, edited(retail, *self.changes)


@dataclass(frozen=True, slots=True)
class Everywhere:
    """A name of a package, in every module of it that has the name, however it was imported.

    Attributes
    ----------
    package : str
        The package, whose loaded modules are looked through.
    name : str
        The name.
    value : object
        The wrong value.
    """

    package: str
    name: str
    value: Any

    def targets(self) -> Iterator[tuple[object, str, Any]]:
        """Yield the name in each module that knows it."""
        for module_name, module in list(sys.modules.items()):
            if module_name.startswith(f"{self.package}.") and self.name in vars(module):
                yield module, self.name, self.value


@dataclass(frozen=True, slots=True)
class Constant:
    """A constant of `oracle.constants`, in every module that has imported it.

    Attributes
    ----------
    name : str
        The constant.
    value : float
        The wrong value.
    """

    name: str
    value: float

    def targets(self) -> Iterator[tuple[object, str, Any]]:
        """Yield the constant in each module of the oracle that knows it."""
        return Everywhere("oracle", self.name, self.value).targets()


@contextmanager
def replaced(replacements: Iterable[Replacement]) -> Iterator[None]:
    """Make the oracle wrong inside the block, and right again after it, whatever happens."""
    with ExitStack() as stack:
        for replacement in replacements:
            for owner, name, value in list(replacement.targets()):
                stack.callback(setattr, owner, name, vars(owner)[name])
                setattr(owner, name, value)
        yield


@cache
def edited(function: FunctionType, *changes: tuple[str, str]) -> FunctionType:
    """Return a function with pieces of its source replaced; decorators are left off.

    So a wrong function differs from retail's by what is written in the table, and by nothing else.

    Parameters
    ----------
    function : function
        The original, at the top of a module or a class.
    *changes : tuple of (str, str)
        A piece of the source, indented as in a function at the left margin, and what replaces it.

    Raises
    ------
    LookupError
        A piece does not occur exactly once.
    """
    source = dedent(inspect.getsource(function))
    for old, new in changes:
        if source.count(old) != 1:
            message = f"{function.__qualname__}: {source.count(old)} occurrences of {old!r}, expected one"
            raise LookupError(message)
        source = source.replace(old, new)
    module = compile(f"from __future__ import annotations\n{source}", inspect.getfile(function), "exec")
    (code,) = (c for c in module.co_consts if isinstance(c, CodeType) and c.co_name == function.__name__)
    return _remade(function, code, function.__globals__)


def with_globals(function: FunctionType, **names: Any) -> FunctionType:
    """Return a function that sees other values under some of its module's names."""
    return _remade(function, function.__code__, {**function.__globals__, **names})


def _remade(function: FunctionType, code: CodeType, names: dict[str, Any]) -> FunctionType:
    made = FunctionType(code, names, function.__name__, function.__defaults__, function.__closure__)
    made.__kwdefaults__ = function.__kwdefaults__
    made.__qualname__ = function.__qualname__
    return made
