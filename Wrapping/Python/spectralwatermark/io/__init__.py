# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes mesh files. Every failure is a MeshFileError, whose text is one line.

    from spectralwatermark import vtkSpectralWatermarkEmbed
    from spectralwatermark.io import read_mesh, stores_float, write_mesh

    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(read_mesh("model.obj"))
    if stores_float("marked.ply"):  # then verify the mark on what the file will hold
        embed.SetOutputPointsPrecision(embed.SINGLE_PRECISION)
    embed.Update()
    write_mesh(embed.GetOutput(), "marked.ply")

The suffix decides the format, in capitals or not. VTK 9.1 reads and writes every format but OFF,
which it does not know. Each file is checked before VTK reads it. The formats carry:

    format  in   out  coordinates      normals  colours        texture coords  names
    ------  ---  ---  ---------------  -------  -------------  --------------  -----------------
    .ply    yes  yes  float32          in only  points, faces  points          comments
    .obj    yes  yes  float32          points   no             points          materials
    .stl    yes  yes  float32          no       no             no              no
    .vtp    yes  yes  as in the mesh   yes      yes            yes             yes: every array
    .off    yes  no   read as float64  points   points         points          no

PLY   Text or binary is read, binary is written. VTK cannot write normals to PLY. Colours have 8
      bits, RGB or RGBA: the arrays RGB or RGBA, or active 8-bit scalars of 3 or 4 components.
      Texture coordinates belong to points (u, v; texture_u, texture_v; s, t). Those of face corners
      (`texcoord` lists) are left out, because VTK merges different points that share one. Comments,
      which name the texture's picture, become the field data array PLYComments.
OBJ   Coordinates are written in full: a float32 is read back as the same float32. A point that has
      several texture coordinates or normals, as at a seam, becomes several points, numbered in the
      order of the faces, and is written so. The texture coordinates of all materials become one
      array, TCoords. `usemtl` and `mtllib` are kept (MaterialIds, MaterialNames,
      MaterialLibraries), but VTK may read the first material as NO_MATERIAL where its faces have no
      texture coordinates. VTK does not read the names of groups and objects, nor colours that
      follow coordinates.
STL   Text or binary is read, binary is written, in triangles. Corners with the same coordinates
      become one point, so points get other numbers. Triangles without area are left out.
VTP   Everything is kept, in its own data type, and compressed.
OFF   OFF, COFF, NOFF, STOFF and their combinations are read, as text. Colours of faces are left
      out.

PLY, OBJ and STL hold polygons, and OBJ lines too. Strips are written as triangles.

meshio replaces none of the readers: the docstring of each format's module says why.
"""

from __future__ import annotations

import os
from pathlib import Path
from types import ModuleType

from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import obj, off, ply, stl, vtp
from .atomic_write import check_writable, write_file
from .checks import check_cells
from .errors import NO_POLYGONS, MeshFileError, system_errors
from .memory import FREE_MEMORY, require_memory

__all__ = [
    "MeshFileError", "check_writable", "read_mesh", "stores_float", "write_file", "write_mesh"
]

# Each module has read(path) and MEMORY_PER_BYTE, and also write(mesh, path) if VTK can write it.
_READ = {".ply": ply, ".obj": obj, ".stl": stl, ".vtp": vtp, ".off": off}
_WRITTEN = {suffix: module for suffix, module in _READ.items() if hasattr(module, "write")}


def read_mesh(path: str | os.PathLike) -> vtkPolyData:
    """The mesh in a PLY, OBJ, STL, VTP or OFF file; raises MeshFileError."""
    path = Path(path)
    with system_errors(path, "read"):
        if path.is_dir():
            raise MeshFileError(f"{path}: this is a folder; name a file in it")
        if not path.exists():
            raise MeshFileError(f"{path}: file not found; check its name and folder")
        module = _READ[_suffix(path, _READ, "read")]
        try:
            return _read(module, path)
        except MeshFileError as error:
            raise MeshFileError(f"{path}: {error}") from None
        except MemoryError:
            raise MeshFileError(f"{path}: not enough memory to read it; {FREE_MEMORY}") from None


def _read(module: ModuleType, path: Path) -> vtkPolyData:
    size = path.stat().st_size
    if size == 0:
        raise MeshFileError("the file is empty; copy or export it again")
    require_memory(size * module.MEMORY_PER_BYTE)
    mesh = module.read(path)
    if not _has_surface(mesh):
        raise MeshFileError(NO_POLYGONS)
    check_cells(mesh)
    return mesh


def write_mesh(mesh: vtkPolyData, path: str | os.PathLike, replace: bool = True) -> None:
    """Writes a PLY, OBJ, STL or VTP file, whole or not at all; raises MeshFileError.

    A file that already exists keeps its permissions. It stays unchanged when writing fails, when it
    is read-only, and when `replace` is false.
    """
    path = Path(path)
    check_writable(path)
    module = _WRITTEN[_suffix(path, _WRITTEN, "write")]
    if not _has_surface(mesh):
        raise MeshFileError(f"{path}: not written: the mesh has no polygons; a surface is needed")

    def write(partial: Path) -> None:
        check_cells(mesh)
        module.write(mesh, partial)

    write_file(path, write, replace)


def stores_float(path: str | os.PathLike) -> bool:
    """Whether write_mesh rounds coordinates to float32 in a file of this name.

    A mark in such a file must survive the rounding: embed with OutputPointsPrecision
    SINGLE_PRECISION, which verifies the mark on the rounded coordinates.
    """
    return _suffix(Path(path), _WRITTEN, "write") != ".vtp"


def _suffix(path: Path, formats: dict[str, ModuleType], verb: str) -> str:
    suffix = path.suffix.lower()
    if suffix not in formats:
        what = f"{path.suffix} files" if suffix else "a file without a suffix"
        raise MeshFileError(f"{path}: cannot {verb} {what}; use one of {', '.join(formats)}")
    return suffix


def _has_surface(mesh: vtkPolyData) -> bool:
    return mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() > 0
