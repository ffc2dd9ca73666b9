# SPDX-License-Identifier: BSD-3-Clause
"""VTP files.

VTK 9.1 trusts the numbers of points and cells, and the places and lengths of arrays, in the file's
XML. It aborts when they ask for more memory than there is, and reads beyond the end of shorter
arrays. So the file is compared with its XML before VTK reads it.

meshio has no reader for VTP.
"""

from __future__ import annotations

import base64
import binascii
import os
import re
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .errors import MeshFileError
from .vtk_execution import run_reader, run_writer

# See memory.py.
MEMORY_PER_BYTE = 4.0

_NOT_WHOLE = "its binary part was cut off or copied as text; copy or export it again"

_TYPES = {"Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4",
          "Int64": "i8", "UInt64": "u8", "Float32": "f4", "Float64": "f8"}
_CELLS = ("Verts", "Lines", "Strips", "Polys")
# zlib compresses at most this many bytes into one.
_ZLIB_RATIO = 1032


def read(path: Path) -> vtkPolyData:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    check(path.read_bytes())
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.fsencode(path))
    return run_reader(reader)


def write(mesh: vtkPolyData, path: Path) -> None:
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToZLib()
    run_writer(writer, mesh, path)


@dataclass
class _File:
    # The appended arrays, which follow an underscore.
    appended: bytes
    appended_is_text: bool
    # The byte order: < or >.
    order: str
    # The type of the numbers in front of an array.
    header: np.dtype
    is_compressed: bool


def check(data: bytes) -> None:
    """Raises MeshFileError when an array is not what the XML says."""
    raw = re.search(rb"<AppendedData[^>]*>\s*(.)", data, re.DOTALL)
    text = data[:raw.start()] + b"</VTKFile>" if raw else data
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise MeshFileError(f"its XML cannot be read: {error}; copy or export it again") from None
    if raw and raw[1] != b"_":
        raise MeshFileError(_NOT_WHOLE)
    file = _file_of(root, data, raw)
    for piece in root.iter("Piece"):
        _check_piece(piece, file, len(data))
    # Each array of the whole file states its own length.
    for array in root.iterfind(".//FieldData/*"):
        _check_array(array, _count(array.get("NumberOfTuples", "1"), len(data)), file)


def _file_of(root: ElementTree.Element, data: bytes, raw: re.Match | None) -> _File:
    order = ">" if root.get("byte_order") == "BigEndian" else "<"
    size = "u8" if root.get("header_type") == "UInt64" else "u4"
    compressor = root.get("compressor", "")
    if compressor not in ("", "vtkZLibDataCompressor"):
        raise MeshFileError(f"its compressor {compressor[:40]} is not supported; "
                            "save it with zlib compression")
    is_text = bool(raw) and b'"raw"' not in raw[0] and b"'raw'" not in raw[0]
    return _File(data[raw.end():] if raw else b"", is_text, order, np.dtype(order + size),
                 bool(compressor))


def _count(text: str, file_size: int) -> int:
    if not re.fullmatch("[0-9]{1,15}", text) or int(text) > _ZLIB_RATIO * file_size:
        raise MeshFileError(f"it claims a count of {text[:30]!r}, which a file of this size cannot "
                            "have; copy or export it again")
    return int(text)


def _check_piece(piece: ElementTree.Element, file: _File, file_size: int) -> None:
    counts = {name: _count(piece.get(f"NumberOf{name}", "0"), file_size)
              for name in ("Points", *_CELLS)}
    for section, length in (("PointData", counts["Points"]), ("Points", counts["Points"]),
                            ("CellData", sum(counts[name] for name in _CELLS))):
        for array in piece.iterfind(f"{section}/*"):
            _check_array(array, length, file)
    for section in _CELLS:
        arrays = {array.get("Name"): array for array in piece.iterfind(f"{section}/DataArray")}
        if not arrays and not counts[section]:
            continue
        if not {"connectivity", "offsets"} <= arrays.keys():
            raise MeshFileError(f"its cell arrays {section} are incomplete; export it again")
        _check_cells(arrays, counts[section], file)


def _check_cells(arrays: dict, count: int, file: _File) -> None:
    offsets = _check_array(arrays["offsets"], count, file)
    ends = offsets.astype(np.int64) if offsets is not None else np.zeros(0, np.int64)
    if (np.diff(ends, prepend=0) < 0).any():
        raise MeshFileError("the offsets of its cells do not increase; copy or export it again")
    _check_array(arrays["connectivity"], int(ends[-1]) if len(ends) else 0, file)


def _check_array(array: ElementTree.Element, tuples: int, file: _File) -> np.ndarray | None:
    """Checks the array's length; returns its values if they are binary or text numbers."""
    form = array.get("format")
    wanted = tuples * _count(array.get("NumberOfComponents", "1"), 1 << 20)
    kind = _TYPES.get(array.get("type"))
    if form == "ascii":
        return _check_text(array, wanted, kind)
    if form == "appended":
        start = _count(array.get("offset", "-"), len(file.appended) + 1)
        content = _content(file.appended[start:], file.appended_is_text, file)
    elif form == "binary":
        content = _content("".join(array.itertext()).strip().encode(), True, file)
    else:
        raise MeshFileError(f"an array has the unknown format {str(form)[:20]!r}; export it again")
    # The length of text and bits is not known.
    if kind is None:
        return None
    if len(content) != wanted * np.dtype(kind).itemsize:
        raise MeshFileError(_NOT_WHOLE)
    return np.frombuffer(content, np.dtype(file.order + kind))


def _check_text(array: ElementTree.Element, wanted: int, kind: str | None) -> np.ndarray | None:
    words = "".join(array.itertext()).split()
    if kind is None:
        return None
    if len(words) < wanted:
        raise MeshFileError("an array has too few numbers; was it cut off? copy or export it again")
    try:
        return np.array([float(word) for word in words[:wanted]]).astype(kind)
    except (ValueError, OverflowError):
        raise MeshFileError("an array holds something that is not a number; export it "
                            "again") from None


def _content(source: bytes, is_text: bool, file: _File) -> bytes:
    """The bytes of an array whose header is at the front of `source`."""
    size = file.header.itemsize
    (count,) = _numbers(source, is_text, 0, 1, file)
    if not file.is_compressed:
        return _bytes(source, is_text, 0, size + count)[size:]
    if count == 0:
        return b""
    # The header holds the number of blocks, the size of a block, the size of the last block (0: as
    # large as the others), and the compressed size of every block.
    head = _numbers(source, is_text, 0, 3 + count, file)
    block, last, sizes = head[1], head[2], head[3:]
    # VTK would divide by a size of 0, and look for blocks that do not exist.
    if last > block:
        raise MeshFileError(_NOT_WHOLE)
    lengths = [block] * (count - 1) + [last or block]
    start = (3 + count) * size
    # The header is encoded on its own.
    if is_text:
        source, start = source[-(-start // 3) * 4:], 0
    packed = _bytes(source, is_text, start, sum(sizes))
    starts = np.cumsum([0, *sizes]).tolist()
    return b"".join(_inflated(packed, *place) for place in zip(starts, sizes, lengths))


def _numbers(source: bytes, is_text: bool, start: int, count: int, file: _File) -> list[int]:
    size = file.header.itemsize
    if count * size > len(source):
        raise MeshFileError(_NOT_WHOLE)
    return np.frombuffer(_bytes(source, is_text, start, count * size), file.header).tolist()


def _bytes(source: bytes, is_text: bool, start: int, count: int) -> bytes:
    end = start + count
    if not is_text:
        found = source[start:end]
    else:
        try:
            found = base64.b64decode(source[:-(-end // 3) * 4], validate=True)[start:end]
        except binascii.Error:
            raise MeshFileError(_NOT_WHOLE) from None
    if len(found) != count:
        raise MeshFileError(_NOT_WHOLE)
    return found


def _inflated(packed: bytes, at: int, packed_size: int, length: int) -> bytes:
    try:
        inflating = zlib.decompressobj()
        block = inflating.decompress(packed[at:at + packed_size], length + 1)
    except zlib.error:
        raise MeshFileError(_NOT_WHOLE) from None
    if len(block) != length:
        raise MeshFileError(_NOT_WHOLE)
    return block
