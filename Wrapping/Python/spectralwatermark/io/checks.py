# SPDX-License-Identifier: BSD-3-Clause
"""Checks that several formats share."""

from __future__ import annotations

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .errors import MeshFileError


def check_cells(mesh: vtkPolyData) -> None:
    """Raises MeshFileError for cells on which VTK's filters and writers would crash."""
    for cells, what, least in ((mesh.GetVerts(), "vertex", 1), (mesh.GetLines(), "line", 2),
                               (mesh.GetPolys(), "polygon", 3), (mesh.GetStrips(), "strip", 3)):
        corners = vtk_to_numpy(cells.GetConnectivityArray())
        if corners.size:
            check_corners(corners.min(), corners.max(), mesh.GetNumberOfPoints())
        if (np.diff(vtk_to_numpy(cells.GetOffsetsArray())) < least).any():
            raise MeshFileError(f"a {what} has fewer than {least} points; remove it from the mesh")


def check_corners(lowest: int, highest: int, points: int) -> None:
    """Raises MeshFileError when a face refers to a point that does not exist."""
    for corner in (lowest, highest):
        if not 0 <= corner < points:
            raise MeshFileError(f"a face refers to point {corner}, but the mesh has {points} "
                                "points, numbered from 0; export it again")


def refuse_underscores(words: list[bytes]) -> None:
    """Raises ValueError for numbers such as 1_0, which is 10 to Python and 1 to VTK."""
    if b"_" in b"".join(words):
        raise ValueError
