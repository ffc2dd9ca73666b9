# SPDX-License-Identifier: BSD-3-Clause
"""STL files.

VTK 9.1 allocates memory for what a binary file claims to hold, and passes over what is missing. So
the size of a binary file is compared with its number of triangles.

meshio reads the same triangles, but took five times as long for 86,000 of them and accepted 23 of
60 damaged files that are refused here.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .errors import MeshFileError
from .surface import surface_of
from .vtk_execution import expect_whole, run_reader, run_writer

# See memory.py.
MEMORY_PER_BYTE = 1.1

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    _check(path.read_bytes())
    reader = vtkSTLReader()
    reader.SetFileName(os.fsencode(path))
    return run_reader(reader)


def _check(data: bytes) -> None:
    head = data[:256]
    text = sum(0x20 <= byte <= 0x7f or byte in b"\n\r\t" for byte in head)
    if len(head) - text < 0.05 * len(head):
        # VTK takes the file for text by the same rule, and reports what is wrong with it itself.
        return
    triangles = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * triangles:
        raise MeshFileError(f"it has {len(data)} bytes, but {triangles} triangles of binary STL "
                            f"take {84 + 50 * triangles}; was it cut off? copy or export it again")


def write(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    writer = vtkSTLWriter()
    writer.SetFileTypeToBinary()
    run_writer(writer, surface_of(mesh), path)
    expect_whole(path, _check)
    a, b, c = np.frombuffer(path.read_bytes(), _RECORD, offset=84)["corners"].swapaxes(0, 1)
    if not ((a != b).any(axis=1) & (b != c).any(axis=1) & (c != a).any(axis=1)).any():
        raise MeshFileError("every triangle has two corners with the same coordinates in float32, "
                            "and STL readers skip such triangles; use another format, or scale it "
                            "up")
