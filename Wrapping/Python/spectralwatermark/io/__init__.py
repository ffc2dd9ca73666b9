# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes mesh files; what goes wrong is one line, the text of a MeshFileError.

    from spectralwatermark import vtkSpectralWatermarkEmbed
    from spectralwatermark.io import read_mesh, stores_float, write_mesh

    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(read_mesh("model.obj"))
    if stores_float("marked.ply"):  # then verify the mark on what the file will hold
        embed.SetOutputPointsPrecision(embed.SINGLE_PRECISION)
    embed.Update()
    write_mesh(embed.GetOutput(), "marked.ply")

The suffix decides the format, in capitals or not. VTK 9.1 does the reading and writing, and this is
what it carries:

    format  in   out  coordinates      normals  colours        texture coords  names
    ------  ---  ---  ---------------  -------  -------------  --------------  -----------------
    .ply    yes  yes  float32          in only  points, faces  points          comments
    .obj    yes  yes  float32          points   no             points          materials
    .stl    yes  yes  float32          no       no             no              no
    .vtp    yes  yes  as in the mesh   yes      yes            yes             yes: every array
    .off    yes  no   read as float64  points   points         points          no

PLY   Binary or text in, binary out. VTK has no way to write normals into it. Colours are of 8 bits,
      RGB or RGBA: the arrays RGB or RGBA, or active 8-bit scalars of 3 or 4 components. Texture
      coordinates are those of points (u, v; texture_u, texture_v; s, t); those of face corners
      (`texcoord` lists) are left out, since VTK joins different points that share one. Comments,
      which name the texture's picture, travel as the field data array PLYComments.
OBJ   Coordinates are written in full: a float32 comes back as the same float32. A point of several
      texture coordinates or normals, as at a seam, becomes several points, numbered as the faces
      come to them, and is written so. The texture coordinates of all materials become one array,
      TCoords. `usemtl` and `mtllib` are kept (MaterialIds, MaterialNames, MaterialLibraries), but
      VTK may read the first material of faces without texture coordinates as NO_MATERIAL; the names
      of groups and objects, and colours after coordinates, it does not read.
STL   Binary or text in, binary out, in triangles. Points are the corners that have the same
      coordinates: their numbers change, triangles without area go.
VTP   Everything, in its own data type, compressed.
OFF   OFF, COFF, NOFF, STOFF and their combinations, as text; the colours of faces are left out.

PLY, OBJ and STL hold polygons (OBJ lines, too); strips are written as triangles.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import struct
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import (
    vtkDataArray,
    vtkLogger,
    vtkOutputWindow,
    vtkPoints,
    vtkStringArray,
    vtkStringOutputWindow,
    vtkUnsignedCharArray,
)
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

__all__ = ["MeshFileError", "check_writable", "read_mesh", "stores_float", "write_file", "write_mesh"]

_INCOMPLETE = "VTK left it incomplete; is the disk full?"
_COLOURS = "colours"  # the array's name, as the PLY writer is told it


class MeshFileError(Exception):
    """A file that cannot be read or written; its text is one line: what is wrong, what to do."""


def read_mesh(path: str | os.PathLike) -> vtkPolyData:
    """The mesh in a PLY, OBJ, STL, VTP or OFF file; raises MeshFileError."""
    path = Path(path)
    with _system_errors(path, "read"):
        if path.is_dir():
            raise MeshFileError(f"{path}: this is a folder; name a file in it")
        if not path.exists():
            raise MeshFileError(f"{path}: no such file; look at its name and folder")
        read = _READERS[_suffix(path, _READERS, "read")]
        try:
            size = path.stat().st_size
            if size == 0:
                raise MeshFileError("the file is empty; save or copy it again")
            _require_memory(size * _MEMORY_OF_BYTE[path.suffix.lower()])
            mesh = read(path)
            if mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
                raise MeshFileError("no polygons in it; is it a surface mesh?")
            _check_cells(mesh)
        except MeshFileError as error:
            raise MeshFileError(f"{path}: {error}") from None
        except MemoryError:
            raise MeshFileError(f"{path}: not enough memory to read it; {_FREE_MEMORY}") from None
    return mesh


def write_mesh(mesh: vtkPolyData, path: str | os.PathLike, replace: bool = True) -> None:
    """Writes a PLY, OBJ, STL or VTP file, whole or not at all; raises MeshFileError.

    A file that is there already keeps its permissions, and stays as it is when writing fails, when it is
    read-only, or when it is not to be replaced.
    """
    path = Path(path)
    check_writable(path)
    suffix = _suffix(path, _WRITERS, "write")
    if mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips() == 0:
        raise MeshFileError(f"{path}: not written: no polygons in the mesh")

    def write(partial: Path) -> None:
        _check_cells(mesh)
        _WRITERS[suffix](mesh, partial)

    write_file(path, write, replace)


def write_file(
    path: str | os.PathLike, write: Callable[[Path], object], replace: bool = True
) -> None:
    """Has write() fill a file beside `path`, then renames it: whole or not at all."""
    path = Path(path)
    target = Path(os.path.realpath(path))  # a link goes on pointing
    partial = target.with_name(f".{os.urandom(8).hex()}.partial{target.suffix.lower()}")
    with _system_errors(path, "written"):
        try:
            partial.touch()  # says why, where VTK would only say that it cannot
            write(partial)
            if not replace:
                os.link(partial, target)  # fails when there is one by now; a rename would not
                return
            if target.exists():
                shutil.copymode(target, partial)
            partial.replace(target)
        except FileExistsError:
            raise MeshFileError(f"{path}: is there already; not replaced") from None
        except MeshFileError as error:
            raise MeshFileError(f"{path}: not written: {error}") from None
        finally:
            with suppress(OSError):  # it is there no longer, or could not be made
                partial.unlink()


def check_writable(path: str | os.PathLike) -> None:
    """Raises MeshFileError when no file of this name can be made: before the work, not after it."""
    path = Path(path)
    with _system_errors(path, "written"):
        if path.is_dir():
            raise MeshFileError(f"{path}: this is a folder; name a file in it")
        folder = Path(os.path.realpath(path)).parent
        if not folder.is_dir():
            raise MeshFileError(f"{path}: there is no folder {path.parent}; make it first")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise MeshFileError(f"{path}: cannot be written: no permission to write into {path.parent}")
        if path.exists() and not os.access(path, os.W_OK):
            raise MeshFileError(f"{path}: is not replaced: it is read-only")


@contextmanager
def _system_errors(path: Path, done: str) -> Iterator[None]:
    """What the system refuses, as a MeshFileError: to enter the folder, say, or a name so long."""
    try:
        yield
    except OSError as error:
        raise MeshFileError(f"{path}: cannot be {done}: {error.strerror}") from error


def stores_float(path: str | os.PathLike) -> bool:
    """Whether write_mesh puts float32 coordinates into a file of this name, whatever the mesh has.

    A mark to be read from such a file must hold on float32 coordinates: embed with
    OutputPointsPrecision SINGLE_PRECISION, and it is verified on them.
    """
    return _suffix(Path(path), _WRITERS, "write") != ".vtp"


def _suffix(path: Path, formats: dict, verb: str) -> str:
    suffix = path.suffix.lower()
    if suffix not in formats:
        what = f"{path.suffix} files" if suffix else "a file without a suffix"
        raise MeshFileError(f"{path}: cannot {verb} {what}; use one of {', '.join(formats)}")
    return suffix


# --- Memory ------------------------------------------------------------------------------------

# What reading takes at the peak for each byte of a file: the least that was measured, of a mesh of a
# million triangles. Text, and compressed files, take up to four times as much.
_MEMORY_OF_BYTE = {".ply": 5.0, ".obj": 3.5, ".stl": 1.1, ".vtp": 4.0, ".off": 20.0}
_LITTLE_MEMORY = 50e6  # not worth asking
_FREE_MEMORY = "close other programs, or simplify the mesh elsewhere first"


def _require_memory(needed: float) -> None:
    """Linux grants what is not there, and kills the process that uses it."""
    if needed <= _LITTLE_MEMORY:
        return
    from .. import vtkSpectralWatermarkAlgorithm

    free = vtkSpectralWatermarkAlgorithm.GetAvailableMemory()
    if needed > free:
        raise MeshFileError(f"to read it needs at least {needed / 1e9:.1f} GB of memory, and "
                            f"{free / 1e9:.1f} GB are free; {_FREE_MEMORY}")


# --- VTK's readers and writers -----------------------------------------------------------------
# Each is imported where it is used: to load them all takes longer than to read a mesh of 50,000 points.


def _run_reader(reader: vtkAlgorithm) -> vtkPolyData:
    with _vtk_messages() as messages:
        reader.Update()
    error = _first_error(messages)
    if error:
        raise MeshFileError(f"{error}; is the file damaged?")
    return reader.GetOutput()


def _run_writer(writer: vtkAlgorithm, mesh: vtkPolyData, path: Path) -> None:
    writer.SetInputData(mesh)
    writer.SetFileName(os.fsencode(path))
    with _vtk_messages() as messages:
        writer.Write()
    # Each writer has its own way of telling, a message, a code, or no file, and no way of saying why.
    if _first_error(messages) or writer.GetErrorCode() or not path.exists():
        raise MeshFileError(_INCOMPLETE)


@contextmanager
def _vtk_messages() -> Iterator[vtkStringOutputWindow]:
    """Gathers what VTK says, all of VTK, and keeps it off the terminal.

    Observers would not do: the parser inside the XML reader is out of their reach.
    """
    messages = vtkStringOutputWindow()
    window = vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(messages)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    if vtkLogger.GetCurrentVerbosityCutoff() == verbosity:  # a log file's, which lets more through
        verbosity = min(verbosity, vtkLogger.VERBOSITY_INFO)  # the terminal's default
    try:
        yield messages
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)
        vtkOutputWindow.SetInstance(window)


def _first_error(messages: vtkStringOutputWindow) -> str:
    """The first error, on one line, or nothing."""
    # "ERROR: In file, line n\nvtkClass (0x...): what matters\n\n"; bytes when it quotes no UTF-8.
    text = messages.GetOutput()
    text = text if isinstance(text, str) else text.decode("ascii", "replace")
    found = re.search(r"^ERROR: In .*, line \d+\n(?:\w+ \(\w+\): )?(.*)", text, re.MULTILINE)
    return " ".join(found[1].split())[:400].rstrip(".") if found else ""


def _check_cells(mesh: vtkPolyData) -> None:
    """VTK's readers pass on what they find, and its filters and writers crash on it."""
    for cells, what, least in ((mesh.GetVerts(), "vertex", 1), (mesh.GetLines(), "line", 2),
                               (mesh.GetPolys(), "polygon", 3), (mesh.GetStrips(), "strip", 3)):
        corners = vtk_to_numpy(cells.GetConnectivityArray())
        if corners.size:
            _check_corners(corners.min(), corners.max(), mesh.GetNumberOfPoints())
        if (np.diff(vtk_to_numpy(cells.GetOffsetsArray())) < least).any():
            raise MeshFileError(f"a {what} has fewer than {least} points; remove it")


def _refuse_underscores(words: list[bytes]) -> None:
    """1_0 is 10 to Python, and 1 to VTK."""
    if b"_" in b"".join(words):
        raise ValueError


def _check_corners(lowest: int, highest: int, points: int) -> None:
    for corner in (lowest, highest):
        if not 0 <= corner < points:
            raise MeshFileError(f"a face names point {corner}, counted from 0, of {points}; "
                                "export it again")


# --- PLY ---------------------------------------------------------------------------------------

_PLY_TYPES = {
    "char": "i1", "short": "i2", "int": "i4", "uchar": "u1", "ushort": "u2", "uint": "u4",
    "int8": "i1", "int16": "i2", "int32": "i4", "uint8": "u1", "uint16": "u2", "uint32": "u4",
    "float": "f4", "double": "f8", "float32": "f4", "float64": "f8",
}
_PLY_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_PLY_COLOURS = ("red", "green", "blue", "alpha")
_PLY_COMMENTS = "PLYComments"
_PLY_CORNERS = 255  # VTK counts them in a byte
_PLY_LINE = 4000  # VTK stops reading at a line of 4095
_CUT_OFF = "the file ends before its last face; it was cut off: copy or export it again"


@dataclass
class _PlyProperty:
    name: str
    type: str
    count_type: str = ""  # of a list; empty: a single value


@dataclass
class _PlyElement:
    name: str
    count: int
    properties: list[_PlyProperty] = field(default_factory=list)


def _read_ply(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = vtkPLYReader()
    reader.SetReadFromInputString(True)
    reader.SetInputString(_checked_ply(path.read_bytes()))
    mesh = _run_reader(reader)
    comments = vtkStringArray()
    comments.SetName(_PLY_COMMENTS)
    for i in range(reader.GetComments().GetNumberOfValues()):
        if reader.GetComments().GetValue(i) != "VTK generated PLY File":  # the writer says it again
            comments.InsertNextValue(reader.GetComments().GetValue(i))
    if comments.GetNumberOfValues():
        mesh.GetFieldData().AddArray(comments)
    return mesh


def _checked_ply(data: bytes) -> bytes:
    """The vertices and faces of a PLY file, checked, as a PLY file that VTK can be trusted with.

    VTK 9.1 crashes when the file is shorter than its header says, when a face names a point that is
    not there, has more than 255 corners or no list of them, and when text has an empty line or no
    line break at its end. It reads wrong data after an element that it does not know, or when faces
    come before vertices.
    """
    header, start = _ply_header(data)
    form, elements = _ply_elements(header)
    vertex, face = _ply_surface(elements)
    if form == "ascii":
        parts = _ply_text_parts(data[start:], elements, vertex.count)
    else:
        parts = _ply_binary_parts(data, start, elements, _PLY_ORDERS[form], vertex.count)
    lines = ["ply", f"format {form} 1.0"]
    lines += [line for line in header if line.startswith("comment ") and len(line) < _PLY_LINE]
    for element in (vertex, face):
        lines.append(f"element {element.name} {element.count}")
        for item in element.properties:
            types = f"list {item.count_type} {item.type}" if item.count_type else item.type
            lines.append(f"property {types} {_ply_name_for_vtk(element, item)}")
    lines += ["end_header", ""]
    return "\n".join(lines).encode("latin-1") + parts["vertex"] + parts["face"]


def _ply_header(data: bytes) -> tuple[list[str], int]:
    """The lines of the header, and where the body begins."""
    first = re.match(rb"ply[ \t]*(\r\n|\n|\r)", data)
    if not first:
        raise MeshFileError("does not begin as a PLY file; is it one?")
    last = re.search(first[1] + rb"end_header[ \t]*" + first[1], data)
    if not last:
        raise MeshFileError("the PLY header has no end; it was cut off: copy or export it again")
    lines = data[first.end():last.start()].decode("latin-1").split(first[1].decode())
    return [line.strip() for line in lines], last.end()


def _ply_elements(header: list[str]) -> tuple[str, list[_PlyElement]]:
    """The format and the elements, of a header in which everything is understood."""
    form = ""
    elements: list[_PlyElement] = []
    for line in header:
        match line.split():
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", name, _] if name in _PLY_ORDERS:
                form = name
            case ["element", name, count] if re.fullmatch("[0-9]{1,10}", count):
                elements.append(_PlyElement(name, int(count)))
            case ["property", "list", count_type, type_, name] if (
                    elements and type_ in _PLY_TYPES
                    and _PLY_TYPES.get(count_type, "f")[0] != "f"):
                elements[-1].properties.append(_PlyProperty(name, type_, count_type))
            case ["property", type_, name] if elements and type_ in _PLY_TYPES:
                elements[-1].properties.append(_PlyProperty(name, type_))
            case _:
                raise MeshFileError(f"no such line belongs into a PLY header: {line[:60]!r}")
    if not form:
        raise MeshFileError("the PLY header names no format; export it again")
    return form, elements


def _ply_surface(elements: list[_PlyElement]) -> tuple[_PlyElement, _PlyElement]:
    """The vertices and faces, as VTK needs them to be described."""
    names = [element.name for element in elements]
    if names.count("vertex") != 1 or names.count("face") > 1:
        raise MeshFileError("the PLY header must name vertices and faces once; export it again")
    vertex = elements[names.index("vertex")]
    singles = {item.name for item in vertex.properties if not item.count_type}
    if not {"x", "y", "z"} <= singles or len(singles) < len(vertex.properties):
        raise MeshFileError("its vertices are not described by x, y, z and single values; export "
                            "it again")
    if "face" not in names or elements[names.index("face")].count == 0:
        raise MeshFileError("no polygons in it; is it a surface mesh?")
    face = elements[names.index("face")]
    if sum(_is_corner_list(item) for item in face.properties) != 1:
        raise MeshFileError("its faces have no list vertex_indices; export it again")
    return vertex, face


def _is_corner_list(item: _PlyProperty) -> bool:
    return bool(item.count_type) and item.name in ("vertex_indices", "vertex_index")


def _ply_name_for_vtk(element: _PlyElement, item: _PlyProperty) -> str:
    """The name that VTK 9.1 knows a property by; one that it would misread gets another."""
    if element.name == "vertex" and item.name in ("s", "t"):
        return {"s": "u", "t": "v"}[item.name]
    if element.name == "face" and _is_corner_list(item):
        return "vertex_indices"
    is_colour = item.name.removeprefix("diffuse_") in _PLY_COLOURS
    if item.count_type or item.name in ("texcoord", "vertex_indices", "vertex_index") or (
            is_colour and _PLY_TYPES[item.type] != "u1"):
        return f"unread_{item.name}"
    return item.name


def _ply_text_parts(body: bytes, elements: list[_PlyElement], points: int) -> dict[str, bytes]:
    rows = [row for line in body.splitlines() if (row := line.split())]
    parts = {}
    for element in elements:
        mine, rows = rows[:element.count], rows[element.count:]
        if len(mine) < element.count:
            raise MeshFileError(_CUT_OFF)
        if element.name in ("vertex", "face"):
            for number, row in enumerate(mine, 1):
                _check_ply_row(element, number, row, points)
        parts[element.name] = b"".join(b" ".join(row) + b"\n" for row in mine)
    return parts


def _check_ply_row(element: _PlyElement, number: int, row: list[bytes], points: int) -> None:
    at = 0
    try:
        _refuse_underscores(row)
        for item in element.properties:
            if item.count_type:
                length = int(row[at])
                values = [int(word) if _is_corner_list(item) else float(word)
                          for word in row[at + 1:at + 1 + length]]
                if not 0 <= length <= _PLY_CORNERS or len(values) < length:
                    raise ValueError
                if _is_corner_list(item) and values:
                    _check_corners(min(values), max(values), points)
                at += 1 + length
            else:
                float(row[at])
                at += 1
    except (ValueError, IndexError, OverflowError):
        raise MeshFileError(f"{element.name} {number} of {element.count} is not what its header "
                            "says; was it cut off? copy or export it again") from None
    if sum(map(len, row)) + len(row) >= _PLY_LINE:
        raise MeshFileError(f"{element.name} {number} of {element.count} is a line too long for "
                            "VTK; write it as binary PLY")


def _ply_binary_parts(data: bytes, position: int, elements: list[_PlyElement], order: str,
                      points: int) -> dict[str, bytes]:
    parts = {}
    for element in elements:
        start = position
        if any(item.count_type for item in element.properties):
            position = _check_ply_lists(element, data, start, order, points)
        else:
            position += element.count * sum(int(_PLY_TYPES[item.type][1])
                                            for item in element.properties)
        if position > len(data):
            raise MeshFileError(_CUT_OFF)
        parts[element.name] = data[start:position]
    return parts


def _check_ply_lists(element: _PlyElement, data: bytes, position: int, order: str,
                     points: int) -> int:
    """Where the records of an element with lists end; their corners are checked."""
    found = (_places_of_equal_lists(element, data, position, order)
             or _places_of_lists(element, data, position, order))
    starts, lengths, end = found
    if lengths.max(initial=0) > _PLY_CORNERS:
        raise MeshFileError(f"a face has {lengths.max()} corners, and VTK reads no more than "
                            f"{_PLY_CORNERS} from PLY; triangulate it, or use another format")
    if end <= len(data):
        for item in filter(_is_corner_list, element.properties):
            _check_ply_corners(data, starts, lengths, np.dtype(order + _PLY_TYPES[item.type]), points)
    return end


def _places_of_lists(element: _PlyElement, data: bytes, position: int, order: str
                     ) -> tuple[np.ndarray, np.ndarray, int]:
    """Where the corners of each record are, how many, and where the records end."""
    steps = []
    for item in element.properties:
        count = np.dtype(_PLY_TYPES[item.count_type or "char"])
        steps.append((int(_PLY_TYPES[item.type][1]),
                      struct.Struct(order + count.char) if item.count_type else None,
                      element.name == "face" and _is_corner_list(item)))
    starts, lengths = [], []
    try:
        for _ in range(element.count):
            for size, count, is_corners in steps:
                length = 1
                if count:
                    (length,) = count.unpack_from(data, position)
                    if length < 0:
                        raise MeshFileError(f"a {element.name} has a list of {length} values; "
                                            "export it again")
                    position += count.size
                if is_corners:
                    starts.append(position)
                    lengths.append(length)
                position += size * length
    except struct.error:
        raise MeshFileError(_CUT_OFF) from None
    return np.array(starts, int), np.array(lengths, int), position


def _places_of_equal_lists(element: _PlyElement, data: bytes, position: int, order: str
                           ) -> tuple[np.ndarray, np.ndarray, int] | None:
    """The same at once, where all lists are as long as the first record's: a mesh of triangles."""
    first = _PlyElement(element.name, min(1, element.count), element.properties)
    starts, lengths, end = _places_of_lists(first, data, position, order)
    size = end - position
    if not size or position + element.count * size > len(data):
        return None
    records = np.frombuffer(data, np.uint8, element.count * size, position).reshape(-1, size)
    at = 0
    for item in element.properties:
        length = 1
        if item.count_type:
            kind = np.dtype(order + _PLY_TYPES[item.count_type])
            counts = np.ascontiguousarray(records[:, at:at + kind.itemsize]).view(kind)
            length = int(counts[0, 0])
            if (counts != length).any():
                return None
            at += kind.itemsize
        at += length * int(_PLY_TYPES[item.type][1])
    steps = size * np.arange(element.count)
    return (starts + steps if starts.size else starts, np.repeat(lengths, element.count),
            position + element.count * size)


def _check_ply_corners(data: bytes, starts: np.ndarray, lengths: np.ndarray, kind: np.dtype,
                       points: int) -> None:
    raw = np.frombuffer(data, np.uint8)
    for k in range(lengths.max(initial=0)):
        places = starts[lengths > k] + k * kind.itemsize
        corners = np.ascontiguousarray(raw[places[:, None] + np.arange(kind.itemsize)]).view(kind)
        _check_corners(corners.min(), corners.max(), points)


def _write_ply(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOPLY import vtkPLYWriter

    surface = _surface(mesh)
    sizes = np.diff(vtk_to_numpy(surface.GetPolys().GetOffsetsArray()))
    if sizes.max(initial=0) > _PLY_CORNERS:
        raise MeshFileError(f"a face has {sizes.max()} corners, and VTK writes no more than "
                            f"{_PLY_CORNERS} into PLY; triangulate it, or use another format")
    writer = vtkPLYWriter()
    writer.SetArrayName(_COLOURS)
    writer.EnableAlphaOn()
    comments = mesh.GetFieldData().GetAbstractArray(_PLY_COMMENTS)
    for i in range(comments.GetNumberOfValues() if isinstance(comments, vtkStringArray) else 0):
        writer.AddComment(comments.GetValue(i))
    _run_writer(writer, surface, path)
    _expect_whole(path, _checked_ply)


# --- OBJ ---------------------------------------------------------------------------------------

_OBJ_NAME = 99  # VTK's buffer for the name of a material
# v, v/vt, v//vn or v/vt/vn. After a slash at the end of a corner VTK takes the next corner's number.
_OBJ_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d+)?(?:/(-?\d+))?)?(?<!/)")


def _read_obj(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOGeometry import vtkOBJReader

    points = _check_obj(path.read_bytes())
    reader = vtkOBJReader()
    reader.SetFileName(os.fsencode(path))
    mesh = _run_reader(reader)
    if mesh.GetNumberOfPoints() == 0:
        raise MeshFileError("no polygons in it; is it a surface mesh?")
    data = mesh.GetPointData()
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    # VTK gives each material an array, as long as the file's list and not as the points are many;
    # (-1, -1) stands for none.
    textures = [array for array in arrays if array.GetNumberOfComponents() == 2]
    if textures:
        merged = np.zeros((mesh.GetNumberOfPoints(), 2), np.float32)
        for array in textures:
            values = _fitted(vtk_to_numpy(array), len(merged))
            given = (values != -1.0).any(axis=1)
            merged[given] = values[given]
            data.RemoveArray(array.GetName())
        data.SetTCoords(_named(merged, "TCoords"))
    if data.GetNormals():
        data.SetNormals(
            _named(_fitted(vtk_to_numpy(data.GetNormals()), mesh.GetNumberOfPoints()), "Normals"))
    if mesh.GetNumberOfPoints() != points:
        _join_corners(mesh)
    _number_lines(mesh)
    return mesh


def _fitted(values: np.ndarray, count: int) -> np.ndarray:
    fitted = np.zeros((count, *values.shape[1:]), values.dtype)
    fitted[:len(values)] = values[:count]
    return fitted


def _join_corners(mesh: vtkPolyData) -> None:
    """Makes one point of the corners that are alike.

    Where one point has several texture coordinates or normals, VTK gives every corner of every face
    a point of its own.
    """
    data = mesh.GetPointData()
    columns = [array for array in (mesh.GetPoints().GetData(), data.GetTCoords(), data.GetNormals())
               if array]
    rows = np.ascontiguousarray(np.hstack([vtk_to_numpy(array) for array in columns]))
    _, first, which = np.unique(rows.view(np.dtype((np.void, rows[:1].nbytes))).ravel(),
                                return_index=True, return_inverse=True)
    order = np.argsort(first)  # as the faces come to them
    numbers = np.argsort(order)[which]
    polys = mesh.GetPolys()
    mesh.SetPolys(_cells(vtk_to_numpy(polys.GetOffsetsArray()),
                         numbers[vtk_to_numpy(polys.GetConnectivityArray())]))
    mesh.SetPoints(_points(vtk_to_numpy(columns[0])[first[order]]))
    for array in columns[1:]:
        joined = _named(vtk_to_numpy(array)[first[order]], array.GetName())
        data.RemoveArray(array.GetName())
        if joined.GetNumberOfComponents() == 2:
            data.SetTCoords(joined)
        else:
            data.SetNormals(joined)


def _number_lines(mesh: vtkPolyData) -> None:
    """VTK numbers the groups and materials of faces only: what comes before the faces gets -1."""
    others = mesh.GetNumberOfCells() - mesh.GetNumberOfPolys()
    data = mesh.GetCellData()
    for name in ("GroupIds", "MaterialIds"):
        if others and data.GetArray(name):
            values = vtk_to_numpy(data.GetArray(name))
            data.AddArray(_named(np.concatenate([np.full(others, -1, values.dtype), values]), name))


def _check_obj(data: bytes) -> int:
    """VTK 9.1 crashes on names of what is not there, and reads as 0 what is no number.

    Returns how many points the file has.
    """
    sizes = {b"v": 3, b"vt": 2, b"vn": 3}
    found = dict.fromkeys(sizes, 0)
    largest = dict.fromkeys(sizes, 0)
    with_normals = set()
    for number, line in enumerate(data.replace(b"\\\n", b" ").split(b"\n"), 1):
        try:
            match line.split():
                case [b"f", *corners]:
                    with_normals.add(_check_obj_face(corners, found, largest))
                case [b"v" | b"vt" | b"vn" as kind, *values]:
                    found[kind] += 1
                    for i in range(sizes[kind]):
                        if not math.isfinite(float(values[i])):
                            raise ValueError
                    _refuse_underscores(values[:sizes[kind]])
                case [b"usemtl", name, *_] if len(name) > _OBJ_NAME:
                    raise MeshFileError(f"line {number}: VTK reads no more than {_OBJ_NAME} "
                                        "letters as the name of a material; shorten it")
        except (ValueError, IndexError):
            text = line.strip()[:40].decode("ascii", "replace")
            raise MeshFileError(f"line {number} cannot be understood: {text!r}; export it "
                                "again") from None
    for kind, what in ((b"v", "points"), (b"vt", "texture coordinates"), (b"vn", "normals")):
        if largest[kind] > found[kind]:
            raise MeshFileError(f"a face names number {largest[kind]} of {found[kind]} {what}; was "
                                "it cut off? copy or export it again")
    if len(with_normals) > 1:
        raise MeshFileError("some faces have normals and some none, and VTK would leave those out; "
                            "export it with normals for all or for none")
    return found[b"v"]


def _check_obj_face(corners: list[bytes], found: dict[bytes, int],
                    largest: dict[bytes, int]) -> bool:
    """Keeps the largest numbers; returns whether there are normals."""
    if len(corners) < 3:
        raise ValueError
    normals = False
    for corner in corners:
        parts = _OBJ_CORNER.fullmatch(corner)
        if not parts:
            raise ValueError
        for kind, part in zip((b"v", b"vt", b"vn"), parts.groups()):
            if part:
                index = int(part)
                if index < 0:
                    index += found[kind] + 1
                if index < 1:
                    raise ValueError
                largest[kind] = max(largest[kind], index)
                normals = normals or kind == b"vn"
    return normals


def _write_obj(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOGeometry import vtkOBJWriter

    surface = _surface(mesh)
    surface.SetLines(mesh.GetLines())
    libraries = mesh.GetFieldData().GetAbstractArray("MaterialLibraries")
    if libraries:
        surface.GetFieldData().AddArray(libraries)
    _run_writer(vtkOBJWriter(), surface, path)

    def check(data: bytes) -> None:
        if not data.endswith(b"\n") or data.count(b"\nf ") != surface.GetNumberOfPolys():
            raise MeshFileError(_CUT_OFF)

    _expect_whole(path, check)
    if surface.GetCellData().GetArray("MaterialIds"):
        _name_materials(mesh, surface, path)


def _name_materials(mesh: vtkPolyData, surface: vtkPolyData, path: Path) -> None:
    """Puts the materials between the faces that VTK wrote.

    VTK 9.1 writes them itself when it is given the names, but loses faces then, unless they are
    sorted by material, and every normal.
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
                name = names.GetValue(material)
                name = name.encode() if isinstance(name, str) else name  # bytes: not UTF-8
                lines.append(b"usemtl " + b"_".join(name.split())[:_OBJ_NAME])
                current = material
        lines.append(line)
    path.write_bytes(b"\n".join(lines))


# --- STL ---------------------------------------------------------------------------------------


def _read_stl(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    _check_stl(path.read_bytes())
    reader = vtkSTLReader()
    reader.SetFileName(os.fsencode(path))
    return _run_reader(reader)


def _check_stl(data: bytes) -> None:
    """VTK 9.1 allocates what a binary file claims to hold, and passes over what is missing."""
    head = data[:256]
    text = sum(0x20 <= byte <= 0x7f or byte in b"\n\r\t" for byte in head)
    if len(head) - text < 0.05 * len(head):
        return  # VTK, by the same rule, reads it as text, and says what is wrong with that
    triangles = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * triangles:
        raise MeshFileError(f"{len(data)} bytes, where {triangles} triangles of binary STL take "
                            f"{84 + 50 * triangles}; was it cut off? copy or export it again")


def _write_stl(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    writer = vtkSTLWriter()
    writer.SetFileTypeToBinary()
    _run_writer(writer, _surface(mesh), path)
    _expect_whole(path, _check_stl)
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    a, b, c = np.frombuffer(path.read_bytes(), record, offset=84)["corners"].swapaxes(0, 1)
    if not ((a != b).any(axis=1) & (b != c).any(axis=1) & (c != a).any(axis=1)).any():
        raise MeshFileError("in every triangle two corners have the same coordinates, and a reader "
                            "of STL leaves such triangles out; use another format, or scale it up")


# --- VTP ---------------------------------------------------------------------------------------


def _read_vtp(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    from . import vtp

    try:
        vtp.check(path.read_bytes())
    except vtp.Damaged as error:
        raise MeshFileError(str(error)) from None
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.fsencode(path))
    return _run_reader(reader)


def _write_vtp(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToZLib()
    _run_writer(writer, mesh, path)


# --- OFF ---------------------------------------------------------------------------------------


def _read_off(path: Path) -> vtkPolyData:
    """Geomview's text format, one vertex and one face a line."""
    lines = [(number, words)
             for number, line in enumerate(path.read_bytes().splitlines(), 1)
             if (words := line.split(b"#")[0].split())]
    # Some files have the counts behind the word, even without a space.
    header = re.match(rb"(ST)?(C)?(N)?(4?n?)OFF(?![A-Za-z])(.*)", b" ".join(lines[0][1])
                      if lines else b"")
    if not header:
        raise MeshFileError("does not begin with OFF, COFF or NOFF; is it an OFF file?")
    if b"BINARY" in header[5]:
        raise MeshFileError("binary OFF cannot be read; export it as text, or as PLY")
    if header[4]:
        raise MeshFileError("OFF in other than three dimensions cannot be read; export it as OFF")
    counts, rest = (header[5].split(), lines[1:]) if header[5].strip() else (
        lines[1][1] if len(lines) > 1 else [], lines[2:])
    try:
        points, faces = int(counts[0]), int(counts[1])
    except (ValueError, IndexError):
        raise MeshFileError("no numbers of points and faces after OFF; export it again") from None
    if min(points, faces) < 0 or len(rest) < points + faces:
        raise MeshFileError(f"{points} points and {faces} faces announced, {len(rest)} lines "
                            "there; was it cut off? copy or export it again")
    mesh = vtkPolyData()
    _set_off_points(mesh, rest[:points], *(bool(header[i]) for i in (1, 2, 3)))
    mesh.SetPolys(_off_faces(rest[points:points + faces], points))
    return mesh


def _set_off_points(mesh: vtkPolyData, lines: list[tuple[int, list[bytes]]], textures: bool,
                    colours: bool, normals: bool) -> None:
    columns = 3 + 3 * normals + 2 * textures
    if colours:  # three or four numbers: the first line tells
        columns = max(columns + 3, min(columns + 4, len(lines[0][1]) if lines else 0))
    values = np.zeros((len(lines), columns))
    for i, (number, words) in enumerate(lines):
        try:
            if len(words) != columns:
                raise ValueError
            values[i] = words
            if not np.isfinite(values[i]).all():
                raise ValueError
        except ValueError:
            raise MeshFileError(f"line {number} is not a point of {columns} finite numbers; "
                                "colours need COFF in the first line, normals NOFF") from None
    mesh.SetPoints(_points(values[:, :3]))
    data = mesh.GetPointData()
    if normals:
        data.SetNormals(_named(values[:, 3:6].astype(np.float32), "Normals"))
    if colours:
        # Fractions of 1, or bytes: no file says which.
        rgba = values[:, 3 + 3 * normals:columns - 2 * textures]
        rgba = np.clip(np.rint(rgba * (255.0 if rgba.max(initial=0.0) <= 1.0 else 1.0)), 0, 255)
        data.SetScalars(_named(rgba.astype(np.uint8), "RGB" if rgba.shape[1] == 3 else "RGBA"))
    if textures:
        data.SetTCoords(_named(values[:, columns - 2:].astype(np.float32), "TCoords"))


def _off_faces(lines: list[tuple[int, list[bytes]]], points: int) -> vtkCellArray:
    corners: list[int] = []
    offsets = [0]
    for number, words in lines:
        try:
            face = [int(word) for word in words[1:1 + int(words[0])]]
        except ValueError:
            face = []
        if len(face) < 3 or len(face) != int(words[0]) or not (
                0 <= min(face) and max(face) < points):
            raise MeshFileError(f"line {number} is not a face of three or more of {points} points; "
                                "export it again")
        corners += face
        offsets.append(len(corners))
    return _cells(np.array(offsets), np.array(corners))


# --- Parts of meshes ---------------------------------------------------------------------------


def _surface(mesh: vtkPolyData) -> vtkPolyData:
    """What a PLY, OBJ or STL file can hold of a mesh, in the form that VTK's writers need."""
    if mesh.GetNumberOfStrips():
        from vtkmodules.vtkFiltersCore import vtkTriangleFilter

        triangles = vtkTriangleFilter()
        triangles.SetInputData(mesh)
        triangles.PassVertsOff()
        triangles.PassLinesOff()
        triangles.Update()
        mesh = triangles.GetOutput()
    surface = vtkPolyData()
    surface.SetPoints(_points(vtk_to_numpy(mesh.GetPoints().GetData()).astype(np.float32)))
    surface.SetPolys(mesh.GetPolys())
    data = mesh.GetPointData()
    if data.GetNormals():
        surface.GetPointData().SetNormals(data.GetNormals())
    if data.GetTCoords() and data.GetTCoords().GetNumberOfComponents() > 1:
        # The PLY writer crashes on doubles, the OBJ writer on a third component; it also leaves out
        # where u is -1, its sign for none, and the numbers of all that follow are wrong.
        texture = vtk_to_numpy(data.GetTCoords())[:, :2].astype(np.float32)
        texture[texture[:, 0] == -1.0, 0] = np.nextafter(np.float32(-1.0), np.float32(0.0))
        surface.GetPointData().SetTCoords(_named(texture, "TCoords"))
    colours = _colours(data)
    if colours:
        surface.GetPointData().AddArray(_named(vtk_to_numpy(colours), _COLOURS))

    # Cell data is of vertices and lines first.
    first = mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
    cells = slice(first, first + mesh.GetNumberOfPolys())
    for array, name in ((_colours(mesh.GetCellData()), _COLOURS),
                        (mesh.GetCellData().GetArray("MaterialIds"), "MaterialIds")):
        if array:
            surface.GetCellData().AddArray(_named(vtk_to_numpy(array)[cells], name))
    return surface


def _colours(data: vtkDataSetAttributes) -> vtkDataArray | None:
    """Active scalars that are colours, else the colours by the names that VTK's readers give."""
    for array in (data.GetScalars(), data.GetArray("RGB"), data.GetArray("RGBA")):
        if isinstance(array, vtkUnsignedCharArray) and array.GetNumberOfComponents() in (3, 4):
            return array
    return None


def _points(coordinates: np.ndarray) -> vtkPoints:
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(coordinates), deep=True))
    return points


def _cells(offsets: np.ndarray, corners: np.ndarray) -> vtkCellArray:
    cells = vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(array.astype(np.int64), deep=True)
                    for array in (offsets, corners)))
    return cells


def _named(values: np.ndarray, name: str) -> vtkDataArray:
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def _expect_whole(path: Path, check: Callable[[bytes], object]) -> None:
    """The writers of PLY and OBJ do not notice a full disk: what they wrote is looked at."""
    try:
        check(path.read_bytes())
    except MeshFileError:
        raise MeshFileError(_INCOMPLETE) from None


_READERS = {".ply": _read_ply, ".obj": _read_obj, ".stl": _read_stl, ".vtp": _read_vtp,
            ".off": _read_off}
_WRITERS = {".ply": _write_ply, ".obj": _write_obj, ".stl": _write_stl, ".vtp": _write_vtp}
