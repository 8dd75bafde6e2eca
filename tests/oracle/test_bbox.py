"""BBox: boxes around points, and around boxes of other spaces."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from oracle_land import land_id
from oracle_worlds import at, vec, xyz

from oracle.bbox import BBox
from oracle.frame import Frame
from oracle.position import Position

HERE, EAST = land_id(0, 0), land_id(0, 0, 0xAAB4)
POINTS = st.lists(
    st.tuples(*[st.floats(-1e3, 1e3, width=32)] * 3).map(lambda p: vec(*p)), min_size=1, max_size=6
)


def corners(box: BBox) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the lowest and the highest corner."""
    return xyz(box.min), xyz(box.max)


def test_around_points() -> None:
    """The extremes of each coordinate; the points stay their owner's."""
    first = vec(1.0, 5.0, -2.0)
    box = BBox.around([first, vec(3.0, 4.0, 7.0)])
    assert corners(box) == ((1.0, 4.0, -2.0), (3.0, 5.0, 7.0))
    assert corners(BBox.around([first])) == ((1.0, 5.0, -2.0), (1.0, 5.0, -2.0))
    assert repr(box).startswith("BBox(")
    box.min.x = -9.0
    assert first.x == 1.0


@given(POINTS)
def test_every_point_is_inside(points: list[object]) -> None:
    """And every face has one."""
    box = BBox.around(points)  # type: ignore[arg-type]
    for axis in "xyz":
        values = [getattr(point, axis) for point in points]
        assert (getattr(box.min, axis), getattr(box.max, axis)) == (min(values), max(values))


def test_into_another_space() -> None:
    """09 8: a quarter turn to the left about z takes (x, y) to (-y, x); the origins differ by 10 - 4."""
    box = BBox(vec(0.0, 1.0, 2.0), vec(3.0, 5.0, 9.0))
    half = 0.7071067690849304
    turned = Position(HERE, Frame.unpack(vec(10.0, 0.0, 0.0), half, 0.0, 0.0, half))
    turned.frame.m0 = turned.frame.m4 = 0.0
    turned.frame.m1, turned.frame.m3 = 1.0, -1.0
    moved = box.local_to_local(turned, at(4.0, 0.0, 0.0, HERE))
    assert corners(moved) == ((6.0 - 5.0, 0.0, 2.0), (6.0 - 1.0, 3.0, 9.0))


def test_into_a_block() -> None:
    """09 8: only the block of the target counts, 192 metres to the west of the box's."""
    box = BBox(vec(-1.0, -1.0, -1.0), vec(1.0, 1.0, 1.0))
    block = box.local_to_global(at(5.0, 6.0, 7.0, EAST), at(99.0, 99.0, 99.0, HERE))
    assert corners(block) == ((196.0, 5.0, 6.0), (198.0, 7.0, 8.0))
