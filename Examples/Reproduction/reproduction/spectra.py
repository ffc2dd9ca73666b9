# SPDX-License-Identifier: BSD-3-Clause
"""Harmonics of meshes, and where the slots begin."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import read_mesh
from spectralwatermark.execution import update
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .models import Model

SLOT_SIZE = 10
BITS = 5
# The first slot begins at component 21 (paper, 3.2.1): above the constant one and 19 others. A
# mesh of several components has more constant ones, and its slots begin as many later.
BELOW_FIRST_SLOT = 20


def harmonics_of(mesh: vtkPolyData, number: int) -> vtkPolyData:
    """The mesh with its first harmonics on it."""
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(number)
    update(harmonics)
    return harmonics.GetOutput()


def zero_eigenvalues(mesh: vtkPolyData) -> int:
    return int((vtk_to_numpy(mesh.GetFieldData().GetArray("Eigenvalues")) == 0.0).sum())


def magnitudes_of(mesh: vtkPolyData) -> np.ndarray:
    return vtk_to_numpy(mesh.GetFieldData().GetArray("SpectrumMagnitude")).copy()


def with_enough_harmonics(mesh: vtkPolyData, number: int) -> tuple[vtkPolyData, int]:
    """The mesh with its harmonics, `number` for a connected one and as many more as it has
    further constant ones; and the component where its first slot begins."""
    result = harmonics_of(mesh, number)
    zeros = zero_eigenvalues(result)
    while zeros > 1 and result.GetPointData().GetArray("ManifoldHarmonics") \
            .GetNumberOfComponents() < number + zeros - 1:
        result = harmonics_of(mesh, number + zeros - 1)
        zeros = zero_eigenvalues(result)
    return result, zeros + BELOW_FIRST_SLOT


# A worker's tasks come mesh by mesh: the basis of the last one serves the next.
@lru_cache(maxsize=1)
def original_of(model: Model) -> tuple[vtkPolyData, int]:
    """A model with the harmonics that its five bits need, and where its first slot begins."""
    return with_enough_harmonics(read_mesh(model.path), BELOW_FIRST_SLOT + BITS * SLOT_SIZE)
