# SPDX-License-Identifier: BSD-3-Clause
"""The header of a PLY file: what it says, and how it must read for VTK."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from .errors import NO_POLYGONS, MeshFileError

TYPES = {
    "char": "i1", "short": "i2", "int": "i4", "uchar": "u1", "ushort": "u2", "uint": "u4",
    "int8": "i1", "int16": "i2", "int32": "i4", "uint8": "u1", "uint16": "u2", "uint32": "u4",
    "float": "f4", "double": "f8", "float32": "f4", "float64": "f8",
}
BYTE_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
# VTK stops reading at a line of 4095 bytes.
LONGEST_LINE = 4000
_COLOURS = ("red", "green", "blue", "alpha")


@dataclass
class Property:
    name: str
    type: str
    # The type of a list's length; empty for a single value.
    count_type: str = ""

    @property
    def size(self) -> int:
        """The bytes of one value."""
        return int(TYPES[self.type][1])

    @property
    def is_corner_list(self) -> bool:
        return bool(self.count_type) and self.name in ("vertex_indices", "vertex_index")


@dataclass
class Element:
    name: str
    count: int
    properties: list[Property] = field(default_factory=list)


@dataclass
class Header:
    lines: list[str]
    # Where the body begins in the file.
    end: int
    format: str
    elements: list[Element]
    vertex: Element
    face: Element

    def for_vtk(self) -> bytes:
        """A header of the vertices and faces alone, with names that VTK 9.1 reads correctly."""
        lines = ["ply", f"format {self.format} 1.0"]
        lines += [line for line in self.lines
                  if line.startswith("comment ") and len(line) < LONGEST_LINE]
        for element in (self.vertex, self.face):
            lines.append(f"element {element.name} {element.count}")
            for item in element.properties:
                types = f"list {item.count_type} {item.type}" if item.count_type else item.type
                lines.append(f"property {types} {_name_for_vtk(element, item)}")
        return "\n".join([*lines, "end_header", ""]).encode("latin-1")


def read_header(data: bytes) -> Header:
    """The header of a PLY file; raises MeshFileError for one that VTK would not understand."""
    lines, end = _split(data)
    form, elements = _parse(lines)
    return Header(lines, end, form, elements, *_surface(elements))


def _split(data: bytes) -> tuple[list[str], int]:
    """The lines of the header, and where the body begins."""
    first = re.match(rb"ply[ \t]*(\r\n|\n|\r)", data)
    if not first:
        raise MeshFileError("does not start with the line 'ply'; is it a PLY file?")
    last = re.search(first[1] + rb"end_header[ \t]*" + first[1], data)
    if not last:
        raise MeshFileError("the PLY header has no end; the file was cut off: copy or export it "
                            "again")
    lines = data[first.end():last.start()].decode("latin-1").split(first[1].decode())
    return [line.strip() for line in lines], last.end()


def _parse(lines: list[str]) -> tuple[str, list[Element]]:
    """The format and the elements; raises MeshFileError for any line that is not known."""
    form = ""
    elements: list[Element] = []
    for line in lines:
        match line.split():
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", name, _] if name in BYTE_ORDERS:
                form = name
            case ["element", name, count] if re.fullmatch("[0-9]{1,10}", count):
                elements.append(Element(name, int(count)))
            case ["property", "list", count_type, type_, name] if (
                    elements and type_ in TYPES and TYPES.get(count_type, "f")[0] != "f"):
                elements[-1].properties.append(Property(name, type_, count_type))
            case ["property", type_, name] if elements and type_ in TYPES:
                elements[-1].properties.append(Property(name, type_))
            case _:
                raise MeshFileError(f"its PLY header has an invalid line: {line[:60]!r}; export it "
                                    "again")
    if not form:
        raise MeshFileError("the PLY header does not say which format it is; export it again")
    return form, elements


def _surface(elements: list[Element]) -> tuple[Element, Element]:
    """The vertices and the faces; raises MeshFileError unless VTK can read their properties."""
    names = [element.name for element in elements]
    if names.count("vertex") != 1 or names.count("face") > 1:
        raise MeshFileError("the PLY header must declare vertices and faces once; export it again")
    vertex = elements[names.index("vertex")]
    singles = {item.name for item in vertex.properties if not item.count_type}
    if not {"x", "y", "z"} <= singles or len(singles) < len(vertex.properties):
        raise MeshFileError("its vertices must have x, y and z, and single values only; export it "
                            "again")
    if "face" not in names or elements[names.index("face")].count == 0:
        raise MeshFileError(NO_POLYGONS)
    face = elements[names.index("face")]
    if sum(item.is_corner_list for item in face.properties) != 1:
        raise MeshFileError("its faces must have one list vertex_indices; export it again")
    return vertex, face


def _name_for_vtk(element: Element, item: Property) -> str:
    """The name by which VTK 9.1 knows a property; one that it would misread gets another."""
    if element.name == "vertex" and item.name in ("s", "t"):
        return {"s": "u", "t": "v"}[item.name]
    if element.name == "face" and item.is_corner_list:
        return "vertex_indices"
    is_colour = item.name.removeprefix("diffuse_") in _COLOURS
    if item.count_type or item.name in ("texcoord", "vertex_indices", "vertex_index") or (
            is_colour and TYPES[item.type] != "u1"):
        return f"unread_{item.name}"
    return item.name
