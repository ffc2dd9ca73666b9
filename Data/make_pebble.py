#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes pebble.ply, the model that the examples and tests start from.

A sphere, dented by waves of every direction whose height falls with their frequency as it does
on scanned surfaces. Nothing about it is symmetric: symmetric models have repeated eigenvalues,
whose harmonics are not determined one by one.
"""

import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource
from vtkmodules.vtkIOPLY import vtkPLYWriter

SUBDIVISIONS = 5
WAVES_PER_OCTAVE = 24
SEED = 2026


def sphere() -> vtkPolyData:
    """An icosahedron, each triangle split into 4^SUBDIVISIONS."""
    icosahedron = vtkPlatonicSolidSource()
    icosahedron.SetSolidTypeToIcosahedron()
    clean = vtkCleanPolyData()
    clean.SetInputConnection(icosahedron.GetOutputPort())
    subdivide = vtkLinearSubdivisionFilter()
    subdivide.SetInputConnection(clean.GetOutputPort())
    subdivide.SetNumberOfSubdivisions(SUBDIVISIONS)
    subdivide.Update()
    return subdivide.GetOutput()


def height(directions: np.ndarray) -> np.ndarray:
    """Sum of waves with frequencies from 1.5 to 24, amplitudes falling with their power 1.3."""
    random = np.random.default_rng(SEED)
    total = np.zeros(len(directions))
    for frequency in 1.5 * 2.0 ** np.arange(0.0, 4.5, 0.5):
        for _ in range(WAVES_PER_OCTAVE):
            wave = random.normal(size=3)
            wave *= frequency / np.linalg.norm(wave)
            phase = random.uniform(0.0, 2.0 * np.pi)
            total += frequency**-1.3 * np.cos(directions @ wave + phase) / WAVES_PER_OCTAVE**0.5
    return total


def main() -> None:
    mesh = sphere()
    directions = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    points = directions * (1.0 + 0.2 * height(directions))[:, None] * [1.0, 0.8, 0.65]

    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(points.astype(np.float32), deep=True))
    pebble = vtkPolyData()
    pebble.SetPoints(coordinates)
    pebble.SetPolys(mesh.GetPolys())
    writer = vtkPLYWriter()
    writer.SetInputData(pebble)
    writer.SetFileName(str(Path(__file__).with_name("pebble.ply")))
    sys.exit(0 if writer.Write() else 1)


if __name__ == "__main__":
    main()
