"""The order in which a batch is answered: queries that are near each other one after the other.

What a query has read, and how its branches went, is then at hand for the next: neither is if that is asked
somewhere else. A query is put into one of some thousand buckets by where it is asked; buckets that are near
in space are near in number (a Morton curve), and within one, queries stay in the order in which they came.
The buckets begin anew every 128 metres, or, since they are wider for a batch that spreads farther, every
1,024 at most; of places on the map that are still farther apart each has the narrow ones. A few of the rows
tell, and who meets a stranger in his bucket only loses a little time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from engine.body_layout import B_ORIGIN, B_POSITION, B_TRANSIENT, BODY_SIZE
from engine.constants import ACTIVE_TS, BLOCK_EDGE, frozen
from engine.kernels.ahead import bring_near
from engine.kernels.compile import entry, inlined, kernel
from engine.kernels.indexing import unsigned
from engine.kernels.sharing import SHARE_REORDERED, is_first, make_ready, wait_until_ready
from engine.layout import (
    COLLISION_INFO,
    CONTACT_VALID,
    POSE_ORIGIN,
    POSE_SIZE,
    POSITION_SIZE,
    Q_COLLISION_INFO,
    Q_END,
    QUERY_SIZE,
)

if TYPE_CHECKING:
    from engine.kernels.types import Array, Ints, Order

SPHERES: Final = frozen(0)
"""Rows that begin with where they are: centres of spheres."""
CALLS: Final = frozen(1)
"""Rows of queries, asked where they end."""
MOVES: Final = frozen(2)
"""Rows of queries, asked where they end; who stands on nothing flies, and is not worth it."""
BODIES: Final = frozen(3)
"""Rows of bodies; one that rests is not worth it."""

ACROSS: Final = frozen(6)
"""Bits of a place along x, and along y."""
UPWARDS: Final = frozen(1)
"""Bits of a place along z: one tells a floor from the next. With two, the first cache would not hold as many
numbers as there are buckets."""
BUCKETS: Final = frozen(1 << (2 * ACROSS + UPWARDS))
"""How many there are."""

_MASK: Final = frozen((1 << ACROSS) - 1)
WIDTH: Final = 2.0
"""Of a bucket along x and y, metres, unless the batch is wider than all of them: about a mover's reach."""
MOST_DOUBLINGS: Final = frozen(3)
"""How often that is doubled at most: a bucket of 16 metres is hardly larger than what a query reads."""
HEIGHT: Final = 4.0
"""Of a bucket along z, metres."""
_BLOCK: Final = frozen(int(BLOCK_EDGE / WIDTH))
"""Buckets along the side of a landblock."""
SMALLEST: Final = frozen(1000)
"""Rows that are worth sorting: fewer gain less than it takes to count buckets."""
FEW: Final = frozen(32)
"""About so many rows are asked whether they are worth it, for a batch of free flights is over in no time; and
how far they spread."""
SAMPLE: Final = frozen(128)
"""About so many rows are asked where they are. Every n-th is, n being odd: many batches alternate."""
FEWEST: Final = frozen(16)
"""Columns of buckets that these lie in at least: who is in a square of 8 metres is near all others anyway."""
FEWEST_OF_CALLS: Final = frozen(64)
"""The same for single calls, which gain less than walks and have as large rows: a square of 16 metres."""
EARLY: Final = frozen(12)
"""How many rows before its bucket is asked for a row is brought near."""
_FAR: Final = 2.0**40
"""Metres, and a multiple of all periods of buckets: added to a number that is nearer it makes it positive, so
that its whole part is the whole number below. What is farther, or no number, is at 0."""
_LIMIT: Final = frozen(1 << 60)
"""Beyond all places, in widths."""
_CONTACT_VALID: Final = frozen(Q_COLLISION_INFO - COLLISION_INFO + CONTACT_VALID)
"""Whether a query's mover stands on something."""


@inlined
def turn(order: Order, k: int) -> int:
    """Return which row is the k-th to be answered."""
    return unsigned(order[unsigned(k)]) if len(order) > 0 else unsigned(k)


@inlined
def _whole(value: float) -> int:
    """Return the whole number below a number, plus `_FAR`; 0 for one that is farther, and for NaN."""
    return int(value + _FAR) if abs(value) < _FAR else 0


@inlined
def _spread(bits: int) -> int:
    """Move each of the lowest eight bits of both halves of a number to twice its place."""
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F
    bits = (bits | bits << 2) & 0x3333333333333333
    return (bits | bits << 1) & 0x5555555555555555


@inlined
def _place_of_pose(row: Array, cell: int, origin: int) -> tuple[int, int, float]:
    """Return the place of a pose: a cell id, of whose landblock the origin's axes are."""
    block = _whole(row[cell]) >> 16
    east = _BLOCK * (block >> 8) + _whole(row[origin] / WIDTH)
    north = _BLOCK * (block & 0xFF) + _whole(row[origin + 1] / WIDTH)
    return east, north, row[origin + 2]


@inlined
def _place_of(kind: int, row: Array) -> tuple[int, int, float]:
    """Return where a row is asked: in widths to the east and to the north, and in metres upwards."""
    if kind == SPHERES:
        return _whole(row[0] / WIDTH), _whole(row[1] / WIDTH), row[2]
    if kind == BODIES:
        return _place_of_pose(row, B_POSITION, B_ORIGIN)
    return _place_of_pose(row, Q_END, Q_END + POSE_ORIGIN)


@inlined
def _bucket_of(kind: int, row: Array, doublings: int) -> int:
    """Return the bucket of a row, of buckets whose width has been doubled so often."""
    east, north, z = _place_of(kind, row)
    both = _spread((east >> doublings & _MASK) | (north >> doublings & _MASK) << 32)
    level = _whole(z / HEIGHT) & ((1 << UPWARDS) - 1)
    return ((both | both >> 31) & ((1 << 2 * ACROSS) - 1)) << UPWARDS | level


@inlined
def _breadth(kind: int, rows: Array, northwards: bool) -> int:
    """Return about how far rows spread to the east, or to the north, in widths.

    The outermost on each side does not count: somebody may be lost.
    """
    first = lowest = _LIMIT
    last = highest = -_LIMIT
    for i in range(0, len(rows), len(rows) // FEW | 1):
        east, north, _ = _place_of(kind, rows[unsigned(i)])
        here = north if northwards else east
        lowest, first = min(lowest, max(first, here)), min(first, here)
        highest, last = max(highest, min(last, here)), max(last, here)
    return highest - lowest


@inlined
def _doublings(kind: int, rows: Array) -> int:
    """Return how often a bucket's width is doubled, so that buckets do not begin anew within the batch.

    A batch that is too wide for that is taken for one of several places far from each other.
    """
    breadth = max(_breadth(kind, rows, False), _breadth(kind, rows, True))
    for doublings in range(MOST_DOUBLINGS + 1):
        if breadth >> doublings <= _MASK:
            return doublings
    return 0


@inlined
def _bring_place(kind: int, rows: Array, i: int) -> None:
    """Have what the bucket of a row depends on brought near; spheres lie close enough without."""
    if kind == BODIES:
        bring_near(rows, BODY_SIZE * i + B_POSITION, POSITION_SIZE)
    elif kind != SPHERES:
        bring_near(rows, QUERY_SIZE * i + Q_END, POSE_SIZE)


@inlined
def _is_worth_it(kind: int, row: Array) -> bool:
    """Say whether the query of a row takes longer than to read a row out of turn."""
    if kind == BODIES:
        return int(row[B_TRANSIENT]) & ACTIVE_TS != 0
    return kind != MOVES or row[_CONTACT_VALID] != 0.0


@inlined
def _are_worth_it(kind: int, rows: Array) -> bool:
    """Say, from a few of the rows, whether most are worth it."""
    asked, worth = 0, 0
    for i in range(0, len(rows), len(rows) // FEW | 1):
        asked += 1
        worth += _is_worth_it(kind, rows[unsigned(i)])
    return 2 * worth > asked


@inlined
def _are_apart(kind: int, rows: Array, columns: Order, doublings: int) -> bool:
    """Say, from a sample of the rows, whether they are not near each other as they lie.

    `columns` is room for a mark on each column of buckets.
    """
    for c in range(BUCKETS >> UPWARDS):
        columns[c] = 0
    found = 0
    for i in range(0, len(rows), len(rows) // SAMPLE | 1):
        column = unsigned(_bucket_of(kind, rows[unsigned(i)], doublings) >> UPWARDS)
        found += columns[column] == 0
        columns[column] = 1
    return found >= (FEWEST_OF_CALLS if kind == CALLS else FEWEST)


@inlined
def _sort(kind: int, rows: Array, order: Order, own: Order, buckets: Order, doublings: int) -> None:
    """Write the numbers of the rows by their buckets: a counting sort."""
    for b in range(BUCKETS):
        buckets[b] = 0
    for i in range(len(rows)):
        _bring_place(kind, rows, i + EARLY)
        bucket = unsigned(_bucket_of(kind, rows[unsigned(i)], doublings))
        own[unsigned(i)] = bucket
        buckets[bucket] += 1
    place = 0
    for b in range(BUCKETS):
        count = buckets[b]
        buckets[b] = place
        place += count
    for i in range(len(rows)):
        bucket = unsigned(own[unsigned(i)])
        order[unsigned(buckets[bucket])] = i
        buckets[bucket] += 1


@inlined
def _sort_if_it_pays(kind: int, rows: Array, order: Order) -> bool:
    """Sort the rows, unless they are few, soon answered, or near each other anyway; say whether they are."""
    if len(rows) < SMALLEST or not _are_worth_it(kind, rows):
        return False
    count = len(rows)
    own, buckets = order[count : 2 * count], order[2 * count :]
    doublings = _doublings(kind, rows)
    if not _are_apart(kind, rows, buckets, doublings):
        return False
    _sort(kind, rows, order, own, buckets, doublings)
    return True


@kernel
def put_in_order(kind: int, rows: Array, order: Order, share: Ints) -> None:
    """Sort rows by their buckets, each bucket in the order in which its rows lie, if that pays.

    The first thread does it, mostly while the others wake up, and they wait until it has: it has the rows in
    its cache. Two that share it read what the other has just written, and take longer than one does.

    Parameters
    ----------
    kind : int
        What rows they are: one of the numbers above.
    rows : ndarray, shape (n, size)
    order : ndarray of int32, shape (0,) or (2 n + BUCKETS,)
        Takes the numbers of the rows. Behind them is room for each row's bucket, and for how many rows are in
        each. Empty: they stay as they lie.
    share : ndarray of int64
        Takes how many have been sorted, all of them or none: `SHARE_REORDERED`.
    """
    if len(order) == 0:
        return
    if is_first(share):
        if _sort_if_it_pays(kind, rows, order):
            share[SHARE_REORDERED] = len(rows)
        else:
            for i in range(len(rows)):
                order[unsigned(i)] = i
        make_ready(share)
    else:
        wait_until_ready(share)


@entry
def order_all(kind: int, rows: Array, order: Order, share: Ints) -> None:
    """Sort all rows; see `put_in_order`."""
    put_in_order(kind, rows, order, share)
