# SPDX-License-Identifier: BSD-3-Clause
"""The harmonics of meshes, and the component where the slots begin."""

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
# The first slot begins at component 21 (paper, 3.2.1), after the constant harmonic and 19 others.
# A mesh of several components has more constant harmonics, and its slots begin later by as many.
BELOW_FIRST_SLOT = 20


def harmonics_of(mesh: vtkPolyData, number: int) -> vtkPolyData:
    """The mesh with its first harmonics as point data."""
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
    """The mesh with its harmonics, and the component where its first slot begins.

    A connected mesh gets `number` harmonics, others one more for each further constant one.
    """
    result = harmonics_of(mesh, number)
    zeros = zero_eigenvalues(result)
    while zeros > 1 and result.GetPointData().GetArray("ManifoldHarmonics") \
            .GetNumberOfComponents() < number + zeros - 1:
        result = harmonics_of(mesh, number + zeros - 1)
        zeros = zero_eigenvalues(result)
    return result, zeros + BELOW_FIRST_SLOT


# A worker processes its tasks mesh by mesh, so that one cached basis is enough.
@lru_cache(maxsize=1)
def original_of(model: Model) -> tuple[vtkPolyData, int]:
    """A model with the harmonics for five bits, and the component where its first slot begins."""
    return with_enough_harmonics(read_mesh(model.path), BELOW_FIRST_SLOT + BITS * SLOT_SIZE)
