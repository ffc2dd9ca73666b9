# SPDX-License-Identifier: BSD-3-Clause
"""The part of a mesh that PLY, OBJ and STL files can hold."""

from __future__ import annotations

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkPolyData

from .arrays import to_array, to_points

# The name of the array of colours in the surface.
COLOURS = "colours"


def surface_of(mesh: vtkPolyData) -> vtkPolyData:
    """The mesh's polygons and attributes, in the form that VTK's writers need."""
    if mesh.GetNumberOfStrips():
        mesh = _without_strips(mesh)
    surface = vtkPolyData()
    surface.SetPoints(to_points(vtk_to_numpy(mesh.GetPoints().GetData()).astype(np.float32)))
    surface.SetPolys(mesh.GetPolys())
    _copy_point_data(mesh.GetPointData(), surface.GetPointData())
    _copy_cell_data(mesh, surface.GetCellData())
    return surface


def _without_strips(mesh: vtkPolyData) -> vtkPolyData:
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter

    triangles = vtkTriangleFilter()
    triangles.SetInputData(mesh)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    return triangles.GetOutput()


def _copy_point_data(source: vtkDataSetAttributes, target: vtkDataSetAttributes) -> None:
    if source.GetNormals():
        target.SetNormals(source.GetNormals())
    if source.GetTCoords() and source.GetTCoords().GetNumberOfComponents() > 1:
        # The PLY writer crashes on doubles, and the OBJ writer on a third component. The OBJ writer
        # takes u = -1 for "none" and leaves it out, which shifts the numbers of all that follow.
        texture = vtk_to_numpy(source.GetTCoords())[:, :2].astype(np.float32)
        texture[texture[:, 0] == -1.0, 0] = np.nextafter(np.float32(-1.0), np.float32(0.0))
        target.SetTCoords(to_array(texture, "TCoords"))
    colours = _colours(source)
    if colours:
        target.AddArray(to_array(vtk_to_numpy(colours), COLOURS))


def _copy_cell_data(mesh: vtkPolyData, target: vtkDataSetAttributes) -> None:
    """Copies the values of the polygons; those of vertices and lines come before them."""
    first = mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
    cells = slice(first, first + mesh.GetNumberOfPolys())
    data = mesh.GetCellData()
    for array, name in ((_colours(data), COLOURS), (data.GetArray("MaterialIds"), "MaterialIds")):
        if array:
            target.AddArray(to_array(vtk_to_numpy(array)[cells], name))


def _colours(data: vtkDataSetAttributes) -> vtkDataArray | None:
    """The active scalars if they are colours, else the colours under the names of VTK's readers."""
    for array in (data.GetScalars(), data.GetArray("RGB"), data.GetArray("RGBA")):
        if isinstance(array, vtkUnsignedCharArray) and array.GetNumberOfComponents() in (3, 4):
            return array
    return None
