"""CPhysicsObj, registration: in which cells others find the object.

The functions here are methods of `oracle.physics_object.PhysicsObj`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from oracle.cell_array import CellArray
from oracle.cell_list import find_cell_list_for_cylspheres, find_cell_list_for_sphere
from oracle.constants import DUMMY_RADIUS
from oracle.physics_state import HAS_PHYSICS_BSP_PS, PARTICLE_EMITTER_PS
from oracle.sphere import Sphere
from oracle.vector import Vector3

if TYPE_CHECKING:
    from collections.abc import Sequence

    from oracle.cyl_sphere import CylSphere
    from oracle.obj_cell import ObjCell
    from oracle.physics_object import PhysicsObj


def calc_cross_cells_static(self: PhysicsObj) -> CellArray:
    """Register an object that never moves in the cells it reaches; returns their list.

    retail: CPhysicsObj::calc_cross_cells_static 0x00515160, 08 9.1.
    """
    # 08 9.1.1
    array = CellArray()
    array.do_not_load_cells = 1
    # 08 9.1.2
    cylspheres = _cylspheres(self)
    if not self.state & HAS_PHYSICS_BSP_PS and cylspheres:
        find_cell_list_for_cylspheres(self.world, self.m_position, cylspheres, array, None)
    else:
        self.find_bbox_cell_list(array)
    # 08 9.1.3
    self.remove_shadows_from_cells()
    self.add_shadows_to_cells(array)
    return array


def calc_cross_cells(self: PhysicsObj) -> CellArray:
    """Register an object that may move in the cells it reaches; returns their list.

    Cylinders and sorting sphere are taken as the setup has them: the object's scale plays no role.

    retail: CPhysicsObj::calc_cross_cells 0x00515230, 08 9.2.
    """
    # 08 9.2.1
    array = CellArray()
    # 08 9.2.2
    cylspheres = _cylspheres(self)
    if self.state & HAS_PHYSICS_BSP_PS:
        self.find_bbox_cell_list(array)
    elif cylspheres:
        find_cell_list_for_cylspheres(self.world, self.m_position, cylspheres, array, None)
    else:
        find_cell_list_for_sphere(self.world, self.m_position, _sorting_sphere(self), array, None)
    # 08 9.2.3
    self.remove_shadows_from_cells()
    self.add_shadows_to_cells(array)
    return array


def _cylspheres(self: PhysicsObj) -> Sequence[CylSphere]:
    return () if self.part_array is None else self.part_array.get_cylsphere()


def _sorting_sphere(self: PhysicsObj) -> Sphere:
    """Return the setup's sorting sphere, or a small one if there is none (08 9.2.2)."""
    parts = self.part_array
    if parts is None or parts.setup is None or parts.setup.sorting_sphere is None:
        return Sphere(Vector3(0.0, 0.0, DUMMY_RADIUS), DUMMY_RADIUS)
    return parts.setup.sorting_sphere


def find_bbox_cell_list(self: PhysicsObj, array: CellArray) -> None:
    """List the cells that the object's parts reach, beginning with its own.

    retail: CPhysicsObj::find_bbox_cell_list 0x00510FC0, 08 9.3.
    """
    # 08 9.3.1
    array.cells.clear()
    array.added_outside = 0
    # 08 9.3.2
    array.add_cell(self.m_position.objcell_id, self.cell)
    # 08 9.3.3
    if self.cell is None or self.part_array is None:
        return
    i = 0
    while i < array.num_cells:
        cell = array.cells[i].cell
        if cell is not None:
            cell.find_transit_cells_of_parts(self.part_array.parts, array)
        i += 1


def add_shadows_to_cells(self: PhysicsObj, array: CellArray) -> None:
    """Register the object, and what is attached to it, in the cells of a list.

    A cell that is not loaded is noted, and nothing is in it.

    retail: CPhysicsObj::add_shadows_to_cells 0x00514AE0, 08 9.4.
    """
    # 08 9.4.1
    if self.state & PARTICLE_EMITTER_PS:
        _register(self, self.m_position.objcell_id, self.cell)
    # 08 9.4.2
    else:
        for cell_id, cell in array.cells:
            _register(self, cell_id, cell)
    # 08 9.4.3
    for child in self.children:
        child.add_shadows_to_cells(array)


def _register(self: PhysicsObj, cell_id: int, cell: ObjCell | None) -> None:
    self.shadow_objects.append((cell_id, cell))
    if cell is not None:
        cell.add_shadow_object(self)


def remove_shadows_from_cells(self: PhysicsObj) -> None:
    """Take the object, and what is attached to it, out of the cells it is registered in (08 9.1.3)."""
    for _, cell in self.shadow_objects:
        if cell is not None:
            cell.remove_shadow_object(self)
    self.shadow_objects.clear()
    for child in self.children:
        child.remove_shadows_from_cells()
