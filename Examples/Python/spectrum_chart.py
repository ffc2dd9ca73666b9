#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plots the spectrum of a mesh with matplotlib, in a window or into a file.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/spectrum_chart.py \
        MESH [OUTPUT.png]
"""

import sys

import matplotlib.pyplot as plt
from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import read_mesh
from vtkmodules.util.numpy_support import vtk_to_numpy

if len(sys.argv) < 2:
    sys.exit(__doc__)

mesh = read_mesh(sys.argv[1])
harmonics = vtkManifoldHarmonics()
harmonics.SetInputData(mesh)
harmonics.SetNumberOfHarmonics(min(200, mesh.GetNumberOfPoints() // 2))
harmonics.Update()
spectrum = harmonics.GetOutputDataObject(1)
# The first harmonic is constant: its component is the position of the mesh, not a part of its shape.
component, magnitude = (vtk_to_numpy(spectrum.GetColumnByName(name))[1:]
                        for name in ("Component", "Magnitude"))

figure, axes = plt.subplots(figsize=(10, 5), layout="constrained")
axes.semilogy(component, magnitude)
axes.set(title="Spectrum", xlabel="component", ylabel="magnitude")
axes.grid(color="0.9")
if len(sys.argv) > 2:
    figure.savefig(sys.argv[2])
else:
    plt.show()
