#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Describes shapes by their harmonics: ShapeDNA for the whole shape, heat kernel signatures for each point.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/shape_descriptors.py \
        MESH... [--output FOLDER]

ShapeDNA (Reuter, Wolter and Peinecke, 2006) consists of the first eigenvalues, here multiplied by the area so that
the size does not count. It does not change when a shape bends without stretching. The heat kernel signature (Sun,
Ovsjanikov and Guibas, 2009) is the heat that remains at a point after a time t: the sum over k of
exp(-t lambda_k) H_k(point)^2. With --output, each mesh is written with its signatures at eight times in the array
HeatKernelSignature, for example to colour it in ParaView.
"""

import argparse
from pathlib import Path

import numpy as np
from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import read_mesh, write_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

HARMONICS = 100
OF_THE_DNA = 20
TIMES = 8


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="+", type=Path, metavar="MESH")
    parser.add_argument("--output", type=Path)
    arguments = parser.parse_args()
    dna = []
    for path in arguments.meshes:
        mesh = harmonics_of(read_mesh(path))
        dna.append(shape_dna(mesh))
        signature = heat_kernel_signature(mesh)
        print(f"{path.stem:<20} ShapeDNA {np.array2string(dna[-1][:5], precision=1)} ...; signatures from "
              f"{signature.min():.3g} to {signature.max():.3g}")
        if arguments.output is not None:
            arguments.output.mkdir(parents=True, exist_ok=True)
            array = numpy_to_vtk(signature, deep=True)
            array.SetName("HeatKernelSignature")
            mesh.GetPointData().AddArray(array)
            write_mesh(mesh, arguments.output / f"{path.stem}.vtp")
    for i, one in enumerate(dna):
        distances = [np.linalg.norm(one - other) / np.linalg.norm(one) for other in dna]
        print(f"{arguments.meshes[i].stem:<20}" + "".join(f"{distance:>9.3f}" for distance in distances))


def harmonics_of(mesh: vtkPolyData) -> vtkPolyData:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(min(HARMONICS, mesh.GetNumberOfPoints() // 2))
    harmonics.Update()
    return harmonics.GetOutput()


def shape_dna(mesh: vtkPolyData) -> np.ndarray:
    """The eigenvalues after the 0, made independent of the unit of length."""
    eigenvalues = vtk_to_numpy(mesh.GetFieldData().GetArray("Eigenvalues"))
    area = vtk_to_numpy(mesh.GetPointData().GetArray("VertexMass")).sum()
    return area * eigenvalues[1:OF_THE_DNA + 1]


def heat_kernel_signature(mesh: vtkPolyData) -> np.ndarray:
    """A row for each point and a column for each time, evenly spaced in logarithms.

    Each column has the mean 1 over the surface, so that times compare.
    """
    eigenvalues = vtk_to_numpy(mesh.GetFieldData().GetArray("Eigenvalues"))
    basis = vtk_to_numpy(mesh.GetPointData().GetArray("ManifoldHarmonics"))
    mass = vtk_to_numpy(mesh.GetPointData().GetArray("VertexMass"))
    longest, shortest = 4.0 * np.log(10.0) / eigenvalues[[1, -1]]  # the range that the authors choose
    times = np.geomspace(shortest, longest, TIMES)
    signature = basis**2 @ np.exp(-np.outer(eigenvalues, times))
    return signature * mass.sum() / (mass @ signature)


if __name__ == "__main__":
    main()
