# SPDX-License-Identifier: BSD-3-Clause
"""VTK's arrays, points and cells from those of NumPy."""

from __future__ import annotations

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkDataArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray


def to_points(coordinates: np.ndarray) -> vtkPoints:
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(coordinates), deep=True))
    return points


def to_cells(offsets: np.ndarray, corners: np.ndarray) -> vtkCellArray:
    cells = vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(array.astype(np.int64), deep=True)
                    for array in (offsets, corners)))
    return cells


def to_array(values: np.ndarray, name: str) -> vtkDataArray:
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array
