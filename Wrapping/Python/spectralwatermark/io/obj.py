# SPDX-License-Identifier: BSD-3-Clause
"""OBJ files.

VTK 9.1 crashes on faces that refer to something that is not there, and reads as 0 what is not a
number. So every line that it would use is checked before it reads the file.

meshio keeps double coordinates, is twice as fast and read 2 more of 69 real files, but it failed on
26 (normals or texture coordinates not numbered as the points), and it drops materials.
"""

from __future__ import annotations

import math
import os
import re
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .arrays import to_array, to_cells, to_points
from .checks import refuse_underscores
from .errors import NO_POLYGONS, MeshFileError
from .surface import surface_of
from .vtk_execution import INCOMPLETE, run_reader, run_writer

# See memory.py.
MEMORY_PER_BYTE = 3.5

# VTK has 100 bytes for the name of a material.
_LONGEST_NAME = 99
# v, v/vt, v//vn or v/vt/vn. A corner must not end with a slash: VTK would read on into the next.
_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d+)?(?:/(-?\d+))?)?(?<!/)")
_KINDS = {b"v": "point", b"vt": "texture coordinate", b"vn": "normal"}
# How many numbers VTK reads of each kind.
_SIZES = {b"v": 3, b"vt": 2, b"vn": 3}


# --- Reading -----------------------------------------------------------------------------------


def read(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOGeometry import vtkOBJReader

    points = _check(path.read_bytes())
    reader = vtkOBJReader()
    reader.SetFileName(os.fsencode(path))
    mesh = run_reader(reader)
    if mesh.GetNumberOfPoints() == 0:
        raise MeshFileError(NO_POLYGONS)
    _merge_textures(mesh)
    normals = mesh.GetPointData().GetNormals()
    if normals:
        values = _fitted(vtk_to_numpy(normals), mesh.GetNumberOfPoints())
        mesh.GetPointData().SetNormals(to_array(values, "Normals"))
    if mesh.GetNumberOfPoints() != points:
        _join_corners(mesh)
    _number_lines(mesh)
    return mesh


def _merge_textures(mesh: vtkPolyData) -> None:
    """Makes one array of the texture coordinates of all materials.

    VTK gives each material an array. Its length is that of the file's list of texture coordinates,
    not the number of points, and (-1, -1) stands for none.
    """
    data = mesh.GetPointData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    textures = [array for array in arrays if array.GetNumberOfComponents() == 2]
    if not textures:
        return
    merged = np.zeros((mesh.GetNumberOfPoints(), 2), np.float32)
    for array in textures:
        values = _fitted(vtk_to_numpy(array), len(merged))
        given = (values != -1.0).any(axis=1)
        merged[given] = values[given]
        data.RemoveArray(array.GetName())
    data.SetTCoords(to_array(merged, "TCoords"))


def _fitted(values: np.ndarray, count: int) -> np.ndarray:
    """The first `count` values, with zeros where there are fewer."""
    fitted = np.zeros((count, *values.shape[1:]), values.dtype)
    fitted[:len(values)] = values[:count]
    return fitted


def _join_corners(mesh: vtkPolyData) -> None:
    """Makes one point of corners that are equal.

    As soon as one point has several texture coordinates or normals, VTK gives every corner of every
    face a point of its own.
    """
    data = mesh.GetPointData()
    columns = [array for array in (mesh.GetPoints().GetData(), data.GetTCoords(), data.GetNormals())
               if array]
    rows = np.ascontiguousarray(np.hstack([vtk_to_numpy(array) for array in columns]))
    _, first, which = np.unique(rows.view(np.dtype((np.void, rows[:1].nbytes))).ravel(),
                                return_index=True, return_inverse=True)
    # Points are numbered in the order in which the faces first use them.
    order = np.argsort(first)
    numbers = np.argsort(order)[which]
    polys = mesh.GetPolys()
    mesh.SetPolys(to_cells(vtk_to_numpy(polys.GetOffsetsArray()),
                           numbers[vtk_to_numpy(polys.GetConnectivityArray())]))
    mesh.SetPoints(to_points(vtk_to_numpy(columns[0])[first[order]]))
    for array in columns[1:]:
        joined = to_array(vtk_to_numpy(array)[first[order]], array.GetName())
        data.RemoveArray(array.GetName())
        if joined.GetNumberOfComponents() == 2:
            data.SetTCoords(joined)
        else:
            data.SetNormals(joined)


def _number_lines(mesh: vtkPolyData) -> None:
    """Gives the cells before the faces group and material -1: VTK stores those of faces only."""
    others = mesh.GetNumberOfCells() - mesh.GetNumberOfPolys()
    data = mesh.GetCellData()
    for name in ("GroupIds", "MaterialIds"):
        if others and data.GetArray(name):
            values = vtk_to_numpy(data.GetArray(name))
            padding = np.full(others, -1, values.dtype)
            data.AddArray(to_array(np.concatenate([padding, values]), name))


# --- Checks ------------------------------------------------------------------------------------


def _check(data: bytes) -> int:
    """Raises MeshFileError for what VTK would misread; returns the number of points."""
    found = dict.fromkeys(_KINDS, 0)
    largest = dict.fromkeys(_KINDS, 0)
    with_normals = set()
    for number, line in enumerate(data.replace(b"\\\n", b" ").split(b"\n"), 1):
        try:
            match line.split():
                case [b"f", *corners]:
                    with_normals.add(_check_face(corners, found, largest))
                case [b"v" | b"vt" | b"vn" as kind, *values]:
                    found[kind] += 1
                    _check_numbers(values, _SIZES[kind])
                case [b"usemtl", name, *_] if len(name) > _LONGEST_NAME:
                    raise MeshFileError(f"line {number}: VTK reads material names of at most "
                                        f"{_LONGEST_NAME} characters; shorten it")
        except (ValueError, IndexError):
            text = line.strip()[:40].decode("ascii", "replace")
            raise MeshFileError(f"line {number} is not valid OBJ: {text!r}; export it "
                                "again") from None
    for kind, what in _KINDS.items():
        if largest[kind] > found[kind]:
            raise MeshFileError(f"a face refers to {what} {largest[kind]}, but the file has "
                                f"{found[kind]}; was it cut off? copy or export it again")
    if len(with_normals) > 1:
        raise MeshFileError("some faces have normals and others have none, and VTK would skip "
                            "those; export it with normals for all faces or for none")
    return found[b"v"]


def _check_numbers(words: list[bytes], count: int) -> None:
    for i in range(count):
        if not math.isfinite(float(words[i])):
            raise ValueError
    refuse_underscores(words[:count])


def _check_face(corners: list[bytes], found: dict[bytes, int], largest: dict[bytes, int]) -> bool:
    """Updates the largest number of each kind; returns whether the face has normals."""
    if len(corners) < 3:
        raise ValueError
    normals = False
    for corner in corners:
        parts = _CORNER.fullmatch(corner)
        if not parts:
            raise ValueError
        for kind, part in zip(_KINDS, parts.groups()):
            if part:
                index = int(part)
                if index < 0:
                    index += found[kind] + 1
                if index < 1:
                    raise ValueError
                largest[kind] = max(largest[kind], index)
                normals = normals or kind == b"vn"
    return normals


# --- Writing -----------------------------------------------------------------------------------


def write(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOGeometry import vtkOBJWriter

    surface = surface_of(mesh)
    surface.SetLines(mesh.GetLines())
    libraries = mesh.GetFieldData().GetAbstractArray("MaterialLibraries")
    if libraries:
        surface.GetFieldData().AddArray(libraries)
    run_writer(vtkOBJWriter(), surface, path)
    # VTK's writer does not notice a full disk.
    written = path.read_bytes()
    if not written.endswith(b"\n") or written.count(b"\nf ") != surface.GetNumberOfPolys():
        raise MeshFileError(INCOMPLETE)
    if surface.GetCellData().GetArray("MaterialIds"):
        _name_materials(mesh, surface, path)


def _name_materials(mesh: vtkPolyData, surface: vtkPolyData, path: Path) -> None:
    """Puts the materials between the faces that VTK wrote.

    VTK 9.1 writes them itself when it has the names, but then it loses every normal, and faces
    unless they are sorted by material.
    """
    names = mesh.GetFieldData().GetAbstractArray("MaterialNames")
    if not isinstance(names, vtkStringArray):
        return
    ids = iter(vtk_to_numpy(surface.GetCellData().GetArray("MaterialIds")).astype(int).tolist())
    lines = []
    current = -1
    for line in path.read_bytes().split(b"\n"):
        if line.startswith(b"f "):
            material = next(ids)
            if material != current and 0 <= material < names.GetNumberOfValues():
                lines.append(b"usemtl " + _material_name(names, material))
                current = material
        lines.append(line)
    path.write_bytes(b"\n".join(lines))


def _material_name(names: vtkStringArray, material: int) -> bytes:
    name = names.GetValue(material)
    # VTK returns bytes when the name is not UTF-8.
    name = name.encode() if isinstance(name, str) else name
    return b"_".join(name.split())[:_LONGEST_NAME]
