"""Evidence that two numbers are equal: their difference vanishes modulo a 127-bit prime.

What the oracle computes is built of float32s by ``+ - * / abs sqrt``. Such an expression can be computed
modulo a prime in which its radicands have roots. Equal numbers have equal residues, for every choice of roots
that respects the relations between them. Unequal numbers have them too with a chance of one in 2^126, as far
as residues of what was not made with these primes in mind are as good as random. They are not for numbers
that differ in the sign of a root alone, as ``s`` and ``sqrt(s * s)`` of a negative ``s`` do: modulo a prime
no root is the positive one. But such numbers are apart by twice the root, and their balls overlap only if
that is less than what 128 bits tell beside the rest. So equal residues of numbers whose balls overlap at 128
bits or more are taken for equality: short of an algebraic proof, but wrong less often than the machine. A
relation that no tried choice of roots respects is not found; such a tie stays undecided, which is the safe
side.

Values of transcendental functions count as unknowns that depend on their arguments (of sine and cosine it is
known that their squares add up to 1): an equality that holds whatever their value is found, others are not.
"""

from __future__ import annotations

from functools import cache
from hashlib import blake2b
from itertools import count
from typing import TYPE_CHECKING, Final, TypeAlias

from flint import fmpz

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.exact.ball import Ball

Origin: TypeAlias = "tuple[str, Ball] | tuple[str, Ball, Ball]"
"""Operation and operands of a number that is not known exactly."""

PRIME_BITS: Final = 127
TRIED_PRIMES: Final = 512
"""Primes looked at before a tie is left undecided; each radicand has a root in half of them."""
EVALUATED_PRIMES: Final = 16
"""Primes in which all radicands have roots, and the difference is not zero, before it is left undecided."""
LARGEST_EXPRESSION: Final = 200_000
"""Operations in an expression that is still tried."""


class _NoResidueError(ArithmeticError):
    """The expression has no value modulo this prime: a radicand without a root, a divisor of zero."""


def vanishes(a: Ball, b: Ball) -> bool:
    """Tell whether the difference of two finite numbers is found to be zero."""
    if not (a.arb.is_finite() and b.arb.is_finite()):
        return False
    nodes = _operands_first(a, b)
    if nodes is None:
        return False
    evaluated = 0
    for index in range(TRIED_PRIMES):
        p = _prime(index)
        try:
            residues = _residues(nodes, p)
        except _NoResidueError:
            continue
        if residues[id(a)] == residues[id(b)]:
            return True
        evaluated += 1
        if evaluated == EVALUATED_PRIMES:
            return False
    return False


@cache
def _prime(index: int) -> int:
    """Return a prime of the form 4n + 3, in which a root is a power; the same in every run."""
    for attempt in count():
        p = _hashed(f"prime {index} {attempt}") % (1 << PRIME_BITS) | 1 << (PRIME_BITS - 1) | 3
        if fmpz(p).is_prime():
            return p
    raise AssertionError("primes never end")


def _operands_first(*roots: Ball) -> list[Ball] | None:
    """List what the numbers are made of, each after its operands; None if it is too much."""
    listed: list[Ball] = []
    seen: set[int] = set()
    stack = [(root, False) for root in roots]
    while stack:
        node, operands_done = stack.pop()
        if operands_done:
            listed.append(node)
        elif id(node) not in seen:
            seen.add(id(node))
            if len(seen) > LARGEST_EXPRESSION:
                return None
            stack.append((node, True))
            stack += [(operand, False) for operand in _operands(node)]
    return listed


def _operands(node: Ball) -> Iterator[Ball]:
    return iter(()) if node.origin is None else iter(node.origin[1:])


def _residues(nodes: list[Ball], p: int) -> dict[int, int]:
    """Compute every number modulo a prime, by identity."""
    residues: dict[int, int] = {}
    for node in nodes:
        if node.origin is None:
            residues[id(node)] = _exact(node, p)
        else:
            operation, *operands = node.origin
            values = [residues[id(operand)] for operand in operands]
            residues[id(node)] = _computed(str(operation), values, p)
    return residues


def _exact(node: Ball, p: int) -> int:
    """Return a number that is known exactly, an integer times a power of two."""
    if not node.arb.is_finite():
        raise _NoResidueError
    mantissa, exponent = node.arb.mid().man_exp()
    return int(mantissa) * pow(2, int(exponent), p) % p


def _computed(operation: str, values: list[int], p: int) -> int:
    match operation, values:
        case "+", [a, b]:
            return (a + b) % p
        case "-", [a, b]:
            return (a - b) % p
        case "*", [a, b]:
            return a * b % p
        case "/", [a, b]:
            return a * _inverse(b, p) % p
        case "neg", [a]:
            return -a % p
        case "sqrt", [a]:
            return _root(a, p)
        case "abs", [a]:
            return _root(a * a % p, p)
        case "sin" | "cos", [_]:
            return _on_circle(operation, _unknown("tangent of half", values, p), p)
        case _:
            return _unknown(operation, values, p)


def _inverse(a: int, p: int) -> int:
    if a == 0:
        raise _NoResidueError
    return pow(a, -1, p)


def _root(a: int, p: int) -> int:
    """Return the root that is a square itself: the choice that most products of roots respect."""
    root = pow(a, (p + 1) // 4, p)
    if root * root % p != a:
        raise _NoResidueError
    return root


def _on_circle(operation: str, t: int, p: int) -> int:
    """Return sine or cosine by the tangent of half the angle: their squares add up to 1 whatever it is."""
    scale = _inverse((1 + t * t) % p, p)
    return (2 * t if operation == "sin" else 1 - t * t) * scale % p


def _unknown(operation: str, values: list[int], p: int) -> int:
    """Return a residue that looks random, the same for the same function of the same arguments."""
    return _hashed(f"{operation} {values}") % p


def _hashed(text: str) -> int:
    """Return 256 bits that depend on a text and look random."""
    return int.from_bytes(blake2b(text.encode(), digest_size=32).digest(), "big")
