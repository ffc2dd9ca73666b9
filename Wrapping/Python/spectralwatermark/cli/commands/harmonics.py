# SPDX-License-Identifier: BSD-3-Clause
"""Computes manifold harmonics, and writes the basis or the spectrum."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TypedDict

from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import check_writable, read_mesh, write_file, write_mesh
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable

from ..tasks import Harmonics
from .filters import FilterRunner


class Result(TypedDict):
    output: str
    number: int
    largest_eigenvalue: float
    seconds: float


def run(task: Harmonics, filters: FilterRunner) -> Result:
    check_writable(task.output)
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(read_mesh(task.input))
    harmonics.SetNumberOfHarmonics(task.number)
    seconds = filters.update(harmonics, f"{task.number} harmonics")
    mesh = harmonics.GetOutput()
    if Path(task.output).suffix.lower() == ".csv":
        write_file(task.output, lambda path: _write_table(harmonics.GetOutputDataObject(1), path), task.force)
    else:
        write_mesh(mesh, task.output, task.force)
    values = mesh.GetFieldData().GetArray("Eigenvalues")
    return {"output": task.output, "number": values.GetNumberOfTuples(),
            "largest_eigenvalue": values.GetValue(values.GetNumberOfTuples() - 1), "seconds": round(seconds, 3)}


def _write_table(table: vtkTable, path: Path) -> None:
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow([column.GetName().lower() for column in columns])
        rows.writerows([[int(row[0]), *row[1:]] for row in zip(*map(vtk_to_numpy, columns))])
