"""Where land, transit and registration round, and in which order they add: checked on expressions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from oracle_land import BLOCK, land, land_cell, land_id
from oracle_worlds import CELL, OTHER_CELL, ScriptedCell, ScriptedWorld, at
from symbols import Symbol, assert_compared, assert_floored, assert_vector, f, frame, vec

from oracle import land_defs
from oracle.bbox import BBox
from oracle.cell_array import CellArray
from oracle.cell_list import find_cell_list, find_cell_list_for_sphere
from oracle.constants import EPS
from oracle.enums import TransitionState
from oracle.env_cell import CellPortal, CellStruct, EnvCell
from oracle.land_cell import LandCell
from oracle.outside_cells import add_all_outside_cells, add_all_outside_cells_of_parts
from oracle.physics_part import GfxObj, PhysicsPart
from oracle.plane import Plane
from oracle.position import Position
from oracle.ref import Ref
from oracle.sphere import Sphere
from oracle.world import World

if TYPE_CHECKING:
    from collections.abc import Iterator

    from oracle.vector import Vector3

HERE, EAST = land_id(3, 3), land_id(3, 3, BLOCK + 0x100)
SPAN = 192.0


@pytest.fixture(autouse=True)
def _no_comparisons_yet() -> Iterator[None]:
    """Forget the comparisons of other tests."""
    Symbol.compared.clear()
    yield
    Symbol.compared.clear()


def ball(x: float = 30.0, y: float = 50.0) -> Any:
    """Return a sphere of symbols."""
    return Sphere(vec("c", x, y), Symbol(0.5, "r"))  # type: ignore[arg-type]


def cell_of_symbols(portal: CellPortal) -> EnvCell:
    """Return an interior cell whose pose is made of symbols."""
    world = World()
    made = EnvCell(CELL, Position(CELL, frame("p")), CellStruct(None, None), world, portals=[portal])
    world.add_cell(made)
    return made


def wall() -> Any:
    """Return a plane of symbols."""
    return Plane(vec("N", 1.0, 0.0, 0.0), Symbol(0.0, "d"))  # type: ignore[arg-type]


class TestLandDefs:
    """10 2.7 to 10 2.9."""

    def test_the_cell_under_a_point(self) -> None:
        """10 2.7.3: quotients stay in the register."""
        loc = vec("p", 30.0, 50.0)
        land_defs.get_outside_lcoord(HERE, loc)
        assert_floored(loc.x / 24.0, loc.y / 24.0)

    def test_into_the_block_of_the_point(self) -> None:
        """10 2.8.4: quotient and product stay in the register, the difference is stored; z is not touched."""
        loc = vec("p", 200.0, -50.0)
        x, y, z = loc.x, loc.y, loc.z
        assert land_defs.adjust_to_outside(HERE, loc)[0] == 1
        assert_floored(x / 24.0, y / 24.0, x / SPAN, y / SPAN)
        assert_vector(loc, f(x - SPAN), f(y - -SPAN), z)
        assert_compared(abs(x), "<", EPS)

    def test_within_a_block(self) -> None:
        """10 2.9: the limit is not stored."""
        center, radius = vec("p", 30.0, 50.0), Symbol(0.5, "r")
        assert land_defs.within_block(center, radius)  # type: ignore[arg-type]
        assert_compared(center.x, ">=", radius)
        assert_compared(SPAN - radius, ">", center.x)
        assert_compared(SPAN - radius, ">", center.y)


class TestOutsideCells:
    """09 6.4, 09 6.5."""

    def test_the_point_within_its_cell(self) -> None:
        """09 6.4.2: point and upper limit are stored, the radius is the lower limit as it is."""
        sphere = ball()
        add_all_outside_cells(World(), at(0.0, 0.0, 0.0, HERE), 1, [sphere], CellArray())
        x, y = f(sphere.center.x - 0.0), f(sphere.center.y - 0.0)
        px, py, hi = f(x - 24.0), f(y - 48.0), f(24.0 - sphere.radius)
        for left, operator, right in (
            (px, ">", hi),
            (px, "<", sphere.radius),
            (py, ">", hi),
            (py, "<", sphere.radius),
        ):
            assert_compared(left, operator, right)

    def test_flat_parts(self) -> None:
        """09 6.5.4: sums and quotients stay in the register; the origin is the part's own."""
        gfxobj = GfxObj(None, drawing_sphere=Sphere(vec("s"), Symbol(0.5, "r")))  # type: ignore[arg-type]
        pose = Position(HERE, frame("p"))
        part = PhysicsPart(gfxobj, pose, vec("scale"))
        part.degrade_modes = (2,)
        world = land()
        Symbol.compared.clear()
        add_all_outside_cells_of_parts(world, [part], CellArray())
        q: Any = pose.frame.origin
        r: Any = Symbol(0.5, "r")
        floors = [left for left, operator, _ in Symbol.compared if operator == "floor"]
        wanted = [(q.x - r) / 24.0, (q.y - r) / 24.0, (q.x + r) / 24.0, (q.y + r) / 24.0]
        assert floors[-4:] == [w.text for w in wanted]

    def test_boxes(self) -> None:
        """09 6.5.4: the quotients of the box's corners stay in the register."""
        box: Any = BBox(vec("l", 20.0, 30.0), vec("h", 40.0, 60.0))
        part: Any = PhysicsPart(GfxObj(None, bounding_box=box), at(30.0, 40.0, 0.0, HERE), vec("scale"))
        around = box.local_to_global(part.pos, part.pos)
        Symbol.compared.clear()
        add_all_outside_cells_of_parts(land(), [part], CellArray())
        assert_floored(around.min.x / 24.0, around.min.y / 24.0, around.max.x / 24.0, around.max.y / 24.0)


class TestTransit:
    """09 4.2, 09 4.3, 09 4.5."""

    def test_an_exterior_portal(self) -> None:
        """09 4.2 A: differences in registers, two rows stored and one not, the radius stored."""
        one = cell_of_symbols(CellPortal(None, 0, wall()))
        sphere, n, m = ball(99.0), wall().N, one.pos.frame
        one.find_transit_cells(at(0.0, 0.0, 0.0), 1, [sphere], CellArray(), None)
        c, o = sphere.center, m.origin
        dx, dy, dz = c.x - o.x, c.y - o.y, c.z - o.z
        lx = f((dx * m.m0 + dz * m.m2) + dy * m.m1)
        ly = f((dx * m.m3 + dz * m.m5) + dy * m.m4)
        lz = (dz * m.m8 + dy * m.m7) + dx * m.m6
        d = ((lz * n.z + ly * n.y) + lx * n.x) + wall().d
        assert_compared(d, ">", -f(sphere.radius + EPS))
        assert_compared(d, "<", f(sphere.radius + EPS))

    @pytest.mark.parametrize(("side", "operator"), [(0, "<"), (1, ">")])
    def test_an_unloaded_neighbour(self, side: int, operator: str) -> None:
        """09 4.2 C: the point is stored, the radius is not; x is added last."""
        one = cell_of_symbols(CellPortal(OTHER_CELL, side, wall()))
        sphere, n = ball(0.25), wall().N
        one.find_transit_cells(at(0.0, 0.0, 0.0), 1, [sphere], CellArray(), None)
        l: Any = one.pos.frame.globaltolocal(sphere.center)
        d = ((l.y * n.y + l.z * n.z) + l.x * n.x) + wall().d
        rad = sphere.radius + EPS
        assert_compared(d, operator, rad if side == 0 else -rad)

    @pytest.mark.parametrize(("side", "leaving"), [(0, True), (1, True), (0, False), (1, False)])
    def test_a_part(self, side: int, leaving: bool) -> None:
        """09 4.3.2, 09 4.3.3: both radii are stored; the distance is not; x is added last."""
        one = cell_of_symbols(CellPortal(OTHER_CELL, side, wall()))
        sphere: Any = Sphere(vec("s"), Symbol(0.5, "r"))  # type: ignore[arg-type]
        pose = Position(CELL, frame("q"))
        part = PhysicsPart(GfxObj(None, drawing_sphere=sphere), pose, vec("scale"))
        part.pos.frame.origin.x = Symbol(99.0 if leaving == (side == 0) else -99.0, "q.x")  # type: ignore[assignment]
        if leaving:
            one.find_transit_cells_of_parts([part], CellArray())
        else:
            one.check_building_transit_of_parts(0, [part], CellArray())
        c: Any = one.pos.localtolocal(pose, sphere.center)
        n, r = wall().N, sphere.radius + EPS
        d = ((c.y * n.y + c.z * n.z) + c.x * n.x) + wall().d
        if leaving == (side == 0):
            assert_compared(d, ">", f(r))
        else:
            assert_compared(d, "<", f(-r))


class Noting(ScriptedCell):
    """A cell that notes the points it is asked for."""

    def __init__(self) -> None:
        super().__init__([], cell_id=CELL)
        self.points: list[Any] = []

    def point_in_cell(self, point: Vector3) -> int:
        """Note it."""
        self.points.append(point)
        return 0


class TestCellList:
    """09 5.1, 09 5.3."""

    def test_the_point_in_each_cell_s_block(self) -> None:
        """09 5.1.6: three differences, each stored."""
        cell, sphere = Noting(), ball()
        found: Ref[Any] = Ref(None)
        p = at(0.0, 0.0, 0.0, CELL)
        find_cell_list(ScriptedWorld(cell), p, 1, [sphere], CellArray(), found, None)
        c = sphere.center
        assert_vector(cell.points[0], f(c.x - 0.0), f(c.y - 0.0), f(c.z - 0.0))

    def test_a_sphere_of_the_object_s_space(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """09 5.3: Position::localtoglobal of the position itself; the radius is copied."""
        given: list[Any] = []
        monkeypatch.setattr("oracle.cell_list.find_cell_list", lambda *args: given.append(args[3][0]))
        p, sphere = Position(CELL, frame("p")), ball()
        find_cell_list_for_sphere(World(), p, sphere, CellArray(), None)
        center: Any = p.localtoglobal(p, sphere.center)
        assert_vector(given[0].center, center.x, center.y, center.z)
        assert given[0].radius is sphere.radius


class TestLandCell:
    """10 6.5, 10 7."""

    def test_what_is_tested(self, monkeypatch: pytest.MonkeyPatch) -> None:
        """10 7.2, 10 7.5, 10 7.6: low point and centre are stored differences, the depth is stored."""
        points: list[Any] = []
        world = land()
        cell = land_cell(world)

        def find(_self: LandCell, point: Any) -> Any:
            points.append(point)
            return cell.polygons[0]

        monkeypatch.setattr(LandCell, "find_terrain_poly", find)
        monkeypatch.setattr(LandCell, "get_water_depth", lambda *_: Symbol(0.1, "depth"))
        given: list[Any] = []

        def validate(*args: Any) -> TransitionState:
            given.extend(args)
            return TransitionState.OK

        sphere, low = ball(), vec("low")
        path = type("Path", (), {"check_pos": at(0.0, 0.0, 0.0, EAST), "global_low_point": low})()
        path.global_sphere = [sphere]
        weenie = type("Mover", (), {"weenie_obj": None, "state": 0})()
        oi = type("Info", (), {"object": weenie, "state": 0, "mover": lambda _: weenie})()
        oi.validate_walkable = validate
        made: Any = type("Moving", (), {"sphere_path": path, "object_info": oi, "trace": None})()
        made.collision_info = None
        assert cell.find_env_collisions(made) == TransitionState.OK
        assert_vector(points[0], f(low.x - -SPAN), f(low.y - 0.0), f(low.z - 0.0))
        c = ball().center
        assert_vector(given[0].center, f(c.x - -SPAN), f(c.y - 0.0), f(c.z - 0.0))
        assert given[0] is not sphere
        assert given[0].radius is sphere.radius
        assert given[1] is cell.polygons[0].plane
        assert (given[2], given[3].text, given[6]) == (0, "f32(depth)", HERE)

    def test_the_nearest_corner(self) -> None:
        """10 6.5.2: the point as it is, against whole numbers; no modulus."""
        point = vec("p", 80.0, 90.0)
        land().landscape.blocks[BLOCK].calc_water_depth(HERE, point)
        assert_compared(point.x, ">", 84.0)
        assert_compared(point.y, ">", 84.0)
