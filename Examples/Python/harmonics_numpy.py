#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Uses the basis as a numpy array: smooths a mesh by hand and compares the result with the filter.

    harmonics_numpy.py [MESH.ply]
"""

import sys
from pathlib import Path

import numpy as np
from spectralwatermark import vtkManifoldHarmonics, vtkManifoldHarmonicsReconstruction
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

DEFAULT_MESH = Path(__file__).resolve().parents[2] / "Data" / "pebble.ply"


def main() -> None:
    reader = vtkPLYReader()
    reader.SetFileName(sys.argv[1] if len(sys.argv) > 1 else str(DEFAULT_MESH))
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputConnection(reader.GetOutputPort())
    harmonics.SetNumberOfHarmonics(100)
    harmonics.Update()
    mesh = harmonics.GetOutput()

    basis = vtk_to_numpy(mesh.GetPointData().GetArray("ManifoldHarmonics"))  # (n, 100)
    mass = vtk_to_numpy(mesh.GetPointData().GetArray("VertexMass"))  # (n,)
    eigenvalues = vtk_to_numpy(mesh.GetFieldData().GetArray("Eigenvalues"))  # (100,)
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)  # (n, 3)

    spectrum = basis.T @ (mass[:, None] * points)  # equation 6
    smooth = basis @ spectrum  # equation 7: the shape in the first 100 harmonics
    print(f"{len(points)} vertices; wavelength of harmonic 100: "
          f"{2.0 * np.pi / np.sqrt(eigenvalues[-1]):.3g} model units")

    reconstruction = vtkManifoldHarmonicsReconstruction()
    reconstruction.SetInputConnection(harmonics.GetOutputPort())  # uses the same basis
    reconstruction.SetOutputPointsPrecision(vtkManifoldHarmonicsReconstruction.DOUBLE_PRECISION)
    reconstruction.Update()
    filtered = vtk_to_numpy(reconstruction.GetOutput().GetPoints().GetData())
    difference = np.abs(filtered - smooth).max()
    print(f"largest difference between numpy and the filter: {difference:.1e}")
    sys.exit(0 if difference < 1e-8 * np.ptp(points) else 1)


if __name__ == "__main__":
    main()
