# SPDX-License-Identifier: BSD-3-Clause
"""OFF files, Geomview's text format: one vertex and one face a line. VTK has no reader for it.

meshio is three times as fast, but reads triangles alone, without normals and colours (COFF, NOFF),
and never returns from a file that ends after the word OFF.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .arrays import to_array, to_cells, to_points
from .errors import MeshFileError

# See memory.py.
MEMORY_PER_BYTE = 20.0

# The number of a line in the file, and its words.
_Line = tuple[int, list[bytes]]


def read(path: Path) -> vtkPolyData:
    lines = [(number, words)
             for number, line in enumerate(path.read_bytes().splitlines(), 1)
             if (words := line.split(b"#")[0].split())]
    header = _header(lines)
    # Some files have the counts in the first line, even without a space after OFF.
    counts, rest = (header[5].split(), lines[1:]) if header[5].strip() else (
        lines[1][1] if len(lines) > 1 else [], lines[2:])
    try:
        points, faces = int(counts[0]), int(counts[1])
    except (ValueError, IndexError):
        raise MeshFileError("the numbers of points and faces after OFF are missing; export it "
                            "again") from None
    if min(points, faces) < 0 or len(rest) < points + faces:
        raise MeshFileError(f"its header declares {points} points and {faces} faces, but "
                            f"{len(rest)} lines follow; was it cut off? copy or export it again")
    mesh = vtkPolyData()
    _set_points(mesh, rest[:points], *(bool(header[i]) for i in (1, 2, 3)))
    mesh.SetPolys(_faces(rest[points:points + faces], points))
    return mesh


def _header(lines: list[_Line]) -> re.Match[bytes]:
    """The groups ST, C, N, a prefix of other dimensions, and the rest of the line."""
    header = re.match(rb"(ST)?(C)?(N)?(4?n?)OFF(?![A-Za-z])(.*)", b" ".join(lines[0][1])
                      if lines else b"")
    if not header:
        raise MeshFileError("does not start with OFF, COFF or NOFF; is it an OFF file?")
    if b"BINARY" in header[5]:
        raise MeshFileError("binary OFF is not supported; export it as text OFF, or as PLY")
    if header[4]:
        raise MeshFileError("only OFF in three dimensions is supported; export it as plain OFF")
    return header


def _set_points(mesh: vtkPolyData, lines: list[_Line], textures: bool, colours: bool,
                normals: bool) -> None:
    columns = 3 + 3 * normals + 2 * textures
    if colours:
        # A colour has three or four numbers, as many as in the first line.
        columns = max(columns + 3, min(columns + 4, len(lines[0][1]) if lines else 0))
    values = _table(lines, columns)
    mesh.SetPoints(to_points(values[:, :3]))
    data = mesh.GetPointData()
    if normals:
        data.SetNormals(to_array(values[:, 3:6].astype(np.float32), "Normals"))
    if colours:
        # Colours are fractions of 1 or bytes, and the file does not say which.
        rgba = values[:, 3 + 3 * normals:columns - 2 * textures]
        rgba = np.clip(np.rint(rgba * (255.0 if rgba.max(initial=0.0) <= 1.0 else 1.0)), 0, 255)
        data.SetScalars(to_array(rgba.astype(np.uint8), "RGB" if rgba.shape[1] == 3 else "RGBA"))
    if textures:
        data.SetTCoords(to_array(values[:, columns - 2:].astype(np.float32), "TCoords"))


def _table(lines: list[_Line], columns: int) -> np.ndarray:
    """The numbers of the lines, one row for each."""
    values = np.zeros((len(lines), columns))
    for i, (number, words) in enumerate(lines):
        try:
            if len(words) != columns:
                raise ValueError
            values[i] = words
            if not np.isfinite(values[i]).all():
                raise ValueError
        except ValueError:
            raise MeshFileError(f"line {number} is not a point of {columns} finite numbers; the "
                                "first line must be COFF for colours, NOFF for normals") from None
    return values


def _faces(lines: list[_Line], points: int) -> vtkCellArray:
    corners: list[int] = []
    offsets = [0]
    for number, words in lines:
        try:
            face = [int(word) for word in words[1:1 + int(words[0])]]
        except ValueError:
            face = []
        if len(face) < 3 or len(face) != int(words[0]) or not (
                0 <= min(face) and max(face) < points):
            raise MeshFileError(f"line {number} is not a face of three or more of the {points} "
                                "points; export it again")
        corners += face
        offsets.append(len(corners))
    return to_cells(np.array(offsets), np.array(corners))
