# SPDX-License-Identifier: BSD-3-Clause
"""PLY files.

VTK 9.1 crashes when the file is shorter than its header says, when a face names a point that is
not there, has more than 255 corners or no list of them, and when text has an empty line or no line
break at its end. It reads wrong data after an element that it does not know, and when faces come
before vertices. So the vertices and faces are checked, and VTK is given these alone.

meshio keeps double coordinates and is a little faster, but it failed on 2 of 9 real files (the list
vertex_index, other properties of faces), and it did not return from 4 of 60 damaged ones.
"""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .checks import check_corners, refuse_underscores
from .errors import CUT_OFF, MeshFileError
from .ply_header import BYTE_ORDERS, LONGEST_LINE, TYPES, Element, read_header
from .surface import COLOURS, surface_of
from .vtk_execution import expect_whole, run_reader, run_writer

# See memory.py.
MEMORY_PER_BYTE = 5.0

_COMMENTS = "PLYComments"
# VTK keeps the number of a face's corners in a byte.
_MOST_CORNERS = 255


def read(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOPLY import vtkPLYReader

    reader = vtkPLYReader()
    reader.SetReadFromInputString(True)
    reader.SetInputString(_checked(path.read_bytes()))
    mesh = run_reader(reader)
    comments = vtkStringArray()
    comments.SetName(_COMMENTS)
    for i in range(reader.GetComments().GetNumberOfValues()):
        # VTK's writer adds this comment to every file.
        if reader.GetComments().GetValue(i) != "VTK generated PLY File":
            comments.InsertNextValue(reader.GetComments().GetValue(i))
    if comments.GetNumberOfValues():
        mesh.GetFieldData().AddArray(comments)
    return mesh


def write(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOPLY import vtkPLYWriter

    surface = surface_of(mesh)
    sizes = np.diff(vtk_to_numpy(surface.GetPolys().GetOffsetsArray()))
    if sizes.max(initial=0) > _MOST_CORNERS:
        raise MeshFileError(f"a face has {sizes.max()} corners, but VTK writes at most "
                            f"{_MOST_CORNERS} to PLY; triangulate it, or use another format")
    writer = vtkPLYWriter()
    writer.SetArrayName(COLOURS)
    writer.EnableAlphaOn()
    comments = mesh.GetFieldData().GetAbstractArray(_COMMENTS)
    for i in range(comments.GetNumberOfValues() if isinstance(comments, vtkStringArray) else 0):
        writer.AddComment(comments.GetValue(i))
    run_writer(writer, surface, path)
    expect_whole(path, _checked)


def _checked(data: bytes) -> bytes:
    """A PLY file of the same vertices and faces, which VTK reads correctly."""
    header = read_header(data)
    points = header.vertex.count
    if header.format == "ascii":
        parts = _text_parts(data[header.end:], header.elements, points)
    else:
        order = BYTE_ORDERS[header.format]
        parts = _binary_parts(data, header.end, header.elements, order, points)
    return header.for_vtk() + parts["vertex"] + parts["face"]


# --- Text --------------------------------------------------------------------------------------


def _text_parts(body: bytes, elements: list[Element], points: int) -> dict[str, bytes]:
    """The bytes of each element, by its name."""
    rows = [row for line in body.splitlines() if (row := line.split())]
    parts = {}
    for element in elements:
        mine, rows = rows[:element.count], rows[element.count:]
        if len(mine) < element.count:
            raise MeshFileError(CUT_OFF)
        if element.name in ("vertex", "face"):
            for number, row in enumerate(mine, 1):
                _check_row(element, number, row, points)
        parts[element.name] = b"".join(b" ".join(row) + b"\n" for row in mine)
    return parts


def _check_row(element: Element, number: int, row: list[bytes], points: int) -> None:
    try:
        refuse_underscores(row)
        _check_values(element, row, points)
    except (ValueError, IndexError, OverflowError):
        raise MeshFileError(f"{element.name} {number} of {element.count} does not match the "
                            "header; was it cut off? copy or export it again") from None
    if sum(map(len, row)) + len(row) >= LONGEST_LINE:
        raise MeshFileError(f"the line of {element.name} {number} of {element.count} is too long "
                            "for VTK; save it as binary PLY")


def _check_values(element: Element, row: list[bytes], points: int) -> None:
    """Raises ValueError, IndexError or OverflowError when the row is not as the header says."""
    at = 0
    for item in element.properties:
        if not item.count_type:
            float(row[at])
            at += 1
            continue
        length = int(row[at])
        values = [int(word) if item.is_corner_list else float(word)
                  for word in row[at + 1:at + 1 + length]]
        if not 0 <= length <= _MOST_CORNERS or len(values) < length:
            raise ValueError
        if item.is_corner_list and values:
            check_corners(min(values), max(values), points)
        at += 1 + length


# --- Binary ------------------------------------------------------------------------------------


def _binary_parts(data: bytes, position: int, elements: list[Element], order: str,
                  points: int) -> dict[str, bytes]:
    """The bytes of each element, by its name."""
    parts = {}
    for element in elements:
        start = position
        if any(item.count_type for item in element.properties):
            position = _check_lists(element, data, start, order, points)
        else:
            position += element.count * sum(item.size for item in element.properties)
        if position > len(data):
            raise MeshFileError(CUT_OFF)
        parts[element.name] = data[start:position]
    return parts


def _check_lists(element: Element, data: bytes, position: int, order: str, points: int) -> int:
    """Checks the corners of an element with lists; returns where its records end."""
    found = (_places_of_equal_lists(element, data, position, order)
             or _places_of_lists(element, data, position, order))
    starts, lengths, end = found
    if lengths.max(initial=0) > _MOST_CORNERS:
        raise MeshFileError(f"a face has {lengths.max()} corners, but VTK reads at most "
                            f"{_MOST_CORNERS} from PLY; triangulate it, or use another format")
    if end <= len(data):
        for item in element.properties:
            if item.is_corner_list:
                _check_corners(data, starts, lengths, np.dtype(order + TYPES[item.type]), points)
    return end


def _places_of_lists(element: Element, data: bytes, position: int, order: str
                     ) -> tuple[np.ndarray, np.ndarray, int]:
    """Where the corners of each record are, how many there are, and where the records end."""
    steps = []
    for item in element.properties:
        count = np.dtype(TYPES[item.count_type or "char"])
        steps.append((item.size, struct.Struct(order + count.char) if item.count_type else None,
                      element.name == "face" and item.is_corner_list))
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
        raise MeshFileError(CUT_OFF) from None
    return np.array(starts, int), np.array(lengths, int), position


def _places_of_equal_lists(element: Element, data: bytes, position: int, order: str
                           ) -> tuple[np.ndarray, np.ndarray, int] | None:
    """The same without a loop, if every list is as long as the first record's, as for triangles."""
    first = Element(element.name, min(1, element.count), element.properties)
    starts, lengths, end = _places_of_lists(first, data, position, order)
    size = end - position
    if not size or position + element.count * size > len(data):
        return None
    records = np.frombuffer(data, np.uint8, element.count * size, position).reshape(-1, size)
    if not _have_equal_lists(element, records, order):
        return None
    steps = size * np.arange(element.count)
    return (starts + steps if starts.size else starts, np.repeat(lengths, element.count),
            position + element.count * size)


def _have_equal_lists(element: Element, records: np.ndarray, order: str) -> bool:
    """Whether each list is as long in every record as in the first; a record is a row of bytes."""
    at = 0
    for item in element.properties:
        length = 1
        if item.count_type:
            kind = np.dtype(order + TYPES[item.count_type])
            counts = np.ascontiguousarray(records[:, at:at + kind.itemsize]).view(kind)
            length = int(counts[0, 0])
            if (counts != length).any():
                return False
            at += kind.itemsize
        at += length * item.size
    return True


def _check_corners(data: bytes, starts: np.ndarray, lengths: np.ndarray, kind: np.dtype,
                   points: int) -> None:
    raw = np.frombuffer(data, np.uint8)
    for k in range(lengths.max(initial=0)):
        places = starts[lengths > k] + k * kind.itemsize
        corners = np.ascontiguousarray(raw[places[:, None] + np.arange(kind.itemsize)]).view(kind)
        check_corners(corners.min(), corners.max(), points)
