# SPDX-License-Identifier: BSD-3-Clause
"""PLY files: what programs write is read, with its attributes; damaged files are refused."""

import struct
import unittest

import numpy as np
from mesh_files import (
    PEBBLE,
    SQUARE_FACES,
    SQUARE_POINTS,
    InAnotherProcess,
    InFolder,
    faces_of,
    named,
    ply,
    triangle,
    values_of,
)
from spectralwatermark.io import read_mesh
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkIOPLY import vtkPLYWriter


class WritingTest(InFolder):
    def test_colours_with_and_without_alpha_by_any_name(self):
        for components in (3, 4):
            mesh = triangle()
            colours = np.arange(3 * components, dtype=np.uint8).reshape(3, components)
            mesh.GetPointData().SetScalars(named(colours, "Albedo"))
            copy = self.through(mesh, ".ply").GetPointData()
            np.testing.assert_array_equal(values_of(copy.GetScalars()), colours)
            # Another array may be active since the file was read.
            copy = self.through(mesh, ".ply")
            copy.GetPointData().AddArray(named(np.zeros(3), "Distance"))
            copy.GetPointData().SetActiveScalars("Distance")
            again = self.through(copy, ".ply").GetPointData()
            np.testing.assert_array_equal(values_of(again.GetScalars()), colours)

    def test_other_bytes_are_no_colours(self):
        mesh = triangle()
        mesh.GetPointData().SetScalars(named(np.zeros(3, np.uint8), "mask"))
        self.assertEqual(self.through(mesh, ".ply").GetPointData().GetNumberOfArrays(), 0)

    def test_colours_of_faces_are_those_behind_vertices_and_lines(self):
        mesh = triangle()
        mesh.SetLines(vtkCellArray())
        mesh.GetLines().InsertNextCell(2)
        mesh.GetLines().InsertCellPoint(0)
        mesh.GetLines().InsertCellPoint(1)
        mesh.GetCellData().SetScalars(named(np.array([[9, 9, 9], [1, 2, 3]], np.uint8), "RGB"))
        copy = self.through(mesh, ".ply").GetCellData()
        np.testing.assert_array_equal(values_of(copy.GetScalars()), [[1, 2, 3]])


class ReadingTest(InFolder):
    def test_files_as_programs_write_them(self):
        big = struct.pack(">12f", *np.ravel(SQUARE_POINTS)) + b"".join(
            struct.pack(">B3i", 3, *face) for face in SQUARE_FACES)
        binary = ply(b"", big, form="binary_big_endian")
        camera = ply().replace(b"element vertex", b"element camera 1\nproperty float focus\n"
                               b"element vertex").replace(b"end_header\n", b"end_header\n50\n")
        faces_first = ply(b"3 0 1 2\n3 0 2 3\n", b"0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n")
        head, vertex, face = faces_first.partition(b"end_header")[0].split(b"element ")
        faces_first = faces_first.replace(
            head + b"element " + vertex + b"element " + face,
            head + b"element " + face + b"element " + vertex)
        for name, data in {
                "text": ply(),
                "no line break at the end": ply()[:-1],
                "empty lines": ply().replace(b"\n3 0", b"\n\n3 0"),
                "line breaks of Windows": ply().replace(b"\n", b"\r\n"),
                "line breaks of old Macs": ply().replace(b"\n", b"\r"),
                "big endian": binary,
                "a header of Windows": binary.replace(b"\n", b"\r\n", binary.count(
                    b"\n", 0, binary.index(b"end_header")) + 1),
                "vertex_index": ply(of_faces=("list uint8 int32 vertex_index",)),
                "a long comment": ply().replace(b"element v", b"comment " + b"x" * 9000
                                                + b"\nelement v"),
                "another element first": camera,
                "faces first": faces_first}.items():
            with self.subTest(name):
                self.assert_square(read_mesh(self.file("mesh.ply", data)))

    def test_lists_of_one_length_and_of_several(self):
        def binary(faces, extra):
            """A list of weights, a byte, the corners, for each face."""
            body = struct.pack("<12f", *np.ravel(SQUARE_POINTS)) + b"".join(
                struct.pack(f"<H{len(weights)}dBB{len(face)}i", len(weights), *weights, 7, len(face), *face)
                for face, weights in zip(faces, extra))
            of_faces = ("list ushort double weights", "uchar flags", "list uchar int vertex_indices")
            return ply(b"", body, of_faces=of_faces, numbers=(4, len(faces)),
                       form="binary_little_endian")

        one, two = SQUARE_FACES
        for faces, extra in (
                ([one, two, one], ((1, 2), (3, 4), (5, 6))),
                ([one, two, one], ((1, 2), (3, 4), (5,))),
                ([one, two, one], ((1, 2), (), (5, 6, 7))),
                ([one, two, [0, 1, 2, 3]], ((1, 2), (3, 4), (5, 6))),
                ([[0, 1, 2, 3]] * 3, ((), (), ()))):
            with self.subTest(faces=faces, extra=extra):
                self.assertEqual(faces_of(read_mesh(self.file("mesh.ply", binary(faces, extra)))), faces)
        for faces in ([one, two, [0, 1, 4]], [one, two, [0, 1, 2, -1]]):
            with self.subTest(faces=faces):
                self.assert_refused(read_mesh, self.file("mesh.ply", binary(faces, ((),) * 3)),
                                    f"refers to point {faces[-1][-1]}")

    def test_texture_coordinates_of_other_names(self):
        rows = b"0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0.5 0 1\n"
        for names in ("uv", "st", ("texture_u", "texture_v")):
            mesh = read_mesh(self.file("mesh.ply", ply(
                rows, of_points=[f"float {name}" for name in names])))
            np.testing.assert_array_equal(values_of(mesh.GetPointData().GetTCoords()),
                                          [[0, 0], [1, 0], [1, 1], [0, 1]])

    def test_normals_come_in(self):
        mesh = read_mesh(self.file("mesh.ply", ply(
            b"0 0 0 0 0 1\n1 0 0 0 1 0\n1 1 0 1 0 0\n0 1 0.5 0 0 -1\n",
            of_points=("float nx", "float ny", "float nz"))))
        np.testing.assert_array_equal(values_of(mesh.GetPointData().GetNormals()),
                                      [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0, -1]])

    def test_texture_coordinates_of_corners_join_no_points(self):
        """VTK's reader, given these, puts points together that share a texture coordinate."""
        data = ply(b"0 0 0\n1 0 0\n0 1 0\n0 0 5\n1 0 5\n0 1 5\n",
                   b"3 0 1 2 6 .1 .1 1 0 0 1\n3 3 4 5 6 .2 .2 .5 0 0 .5\n"
                   b"3 3 4 5 6 .1 .1 1 0 0 1\n",
                   of_faces=("list uchar int vertex_indices", "list uchar float texcoord"),
                   numbers=(6, 3))
        mesh = read_mesh(self.file("mesh.ply", data))
        self.assertEqual(faces_of(mesh), [[0, 1, 2], [3, 4, 5], [3, 4, 5]])
        self.assertIsNone(mesh.GetPointData().GetTCoords())

    def test_colours_that_are_no_bytes_are_left_out(self):
        mesh = read_mesh(self.file("mesh.ply", ply(
            b"0 0 0 .1 .2 .3\n1 0 0 .1 .2 .3\n1 1 0 .1 .2 .3\n0 1 0.5 .1 .2 .3\n",
            of_points=("float red", "float green", "float blue"))))
        self.assert_square(mesh)
        self.assertIsNone(mesh.GetPointData().GetScalars())


class DamageTest(InAnotherProcess):
    def test_files_cut_off(self):
        binary = PEBBLE.read_bytes()
        body = binary.index(b"end_header\n") + 11
        faces = body + 12 * 10_242
        writer = vtkPLYWriter()
        writer.SetInputData(read_mesh(PEBBLE))
        writer.SetFileTypeToASCII()
        writer.SetFileName(str(self.folder / "whole.ply"))
        writer.Write()
        text = (self.folder / "whole.ply").read_bytes()
        last_face = text.rindex(b"\n", 0, -2) + 1
        self.assert_all_refused(".ply", {
            **self.cuts("binary", binary, (
                2, 60, body - 5, body, body + 6, faces - 1, faces, faces + 1, faces + 9,
                (faces + len(binary)) // 2, len(binary) - 13, len(binary) - 1)),
            **self.cuts("text", text, (
                3, 150, text.index(b"end_header") + 11, len(text) // 3, len(text) // 2,
                last_face, last_face + 2, text.rindex(b" ", 0, -2))),
        })

    def test_files_that_are_not_what_they_say(self):
        count = struct.pack("<12f", *np.ravel(SQUARE_POINTS)) + struct.pack(
            "<B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)
        binary = ply(b"", count, form="binary_little_endian")
        many = (b"300 " + b"0 " * 300 + b"\n") * 2
        self.assert_all_refused(".ply", {
            "far": ply(faces=b"3 0 1 2\n3 0 2 400000000\n"),
            "one-too-far": ply(faces=b"3 0 1 2\n3 0 2 4\n"),
            "negative": ply(faces=b"3 0 1 2\n3 0 2 -1\n"),
            "missing-corner": ply(faces=b"3 0 1 2\n3 0 2\n"),
            "negative-size": ply(faces=b"3 0 1 2\n-3 0 2 3\n"),
            "two-corners": ply(faces=b"3 0 1 2\n2 0 2\n"),
            "many-corners": ply(faces=many, of_faces=("list int int vertex_indices",)),
            "no-number": ply(points=b"0 0 0\n1 0 0\n1,5 1 0\n0 1 0.5\n"),
            "missing-coordinate": ply(points=b"0 0 0\n1 0 0\n1 1\n0 1 0.5\n"),
            "no-list": ply(faces=b"3\n3\n", of_faces=("uchar quality",)),
            "no-list-of-points": ply(faces=b"3\n3\n", of_faces=("int vertex_indices",)),
            "no-z": ply().replace(b"float z", b"float height"),
            "list-of-x": ply().replace(b"property float x", b"property list uchar float x"),
            "unknown-type": ply().replace(b"float z", b"real z"),
            "unknown-format": ply().replace(b"ascii", b"gzip"),
            "no-format": ply().replace(b"format ascii 1.0\n", b""),
            "no-count": ply().replace(b"vertex 4", b"vertex"),
            "negative-count": ply().replace(b"vertex 4", b"vertex -4"),
            "property-first": ply().replace(b"format ascii 1.0\n",
                                            b"format ascii 1.0\nproperty float w\n"),
            "two-of-them": ply().replace(b"element face", b"element vertex 4\nelement face"),
            "no-header": b"solid pebble\n",
            "binary-far": binary[:-4] + struct.pack("<i", 400_000_000),
            "binary-one-too-far": binary[:-4] + struct.pack("<i", 4),
            "binary-negative": binary[:-4] + struct.pack("<i", -7),
            "binary-big-face": binary[:-13] + b"\xff" + binary[-12:],
            "binary-big-count": binary.replace(b"face 2", b"face 2000000000"),
            "binary-many-points": binary.replace(b"vertex 4", b"vertex 2000000000"),
        })

    def test_names_that_vtk_takes_for_something_else(self):
        corners = "list uchar int vertex_indices"
        files = {
            "list-of-colours": ply(
                faces=b"3 0 1 2 1 7 8 9\n3 0 2 3 1 7 8 9\n",
                of_faces=(corners, "list uchar uchar red", "uchar green", "uchar blue")),
            "one-texture-coordinate": ply(
                faces=b"3 0 1 2 0.5\n3 0 2 3 0.5\n", of_faces=(corners, "float texcoord")),
        }
        for path, line in self.said_of(".ply", files):
            self.assertEqual(line, "read 2", path.name)


class MessageTest(InFolder):
    SQUARE = struct.pack("<12f", *np.ravel(SQUARE_POINTS))
    FACES = struct.pack("<B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)

    def binary(self, faces, **more):
        return ply(b"", self.SQUARE + faces, form="binary_little_endian", **more)

    def test_each_header_says_what_is_wrong(self):
        self.assert_each_refused(".ply", {
            "cut off": (ply()[:60], "the PLY header has no end"),
            "unknown type": (ply().replace(b"float z", b"real z"),
                             "its PLY header has an invalid line"),
            "no format": (ply().replace(b"format ascii 1.0\n", b""),
                          "the PLY header does not say which format it is"),
            "vertices twice": (ply().replace(b"element face", b"element vertex 4\nelement face"),
                               "must declare vertices and faces once"),
            "no z": (ply().replace(b"float z", b"float height"), "its vertices must have x, y and z"),
            "no list": (ply(faces=b"3\n3\n", of_faces=("uchar quality",)),
                        "its faces must have one list vertex_indices"),
        })

    def test_each_body_says_what_is_wrong(self):
        many = struct.pack("<i300i", 300, *range(3), *[0] * 297) * 2
        self.assert_each_refused(".ply", {
            "a missing corner": (ply(faces=b"3 0 1 2\n3 0 2\n"),
                                 "face 2 of 2 does not match the header"),
            "an underscore": (ply(faces=b"3 0 1 2\n3 0 2 0_3\n"),
                              "face 2 of 2 does not match the header"),
            "a long line": (ply(points=b"0 0 0." + b"0" * 5000 + b"\n1 0 0\n1 1 0\n0 1 0\n"),
                            "the line of vertex 1 of 4 is too long for VTK"),
            "a point too far": (ply(faces=b"3 0 1 2\n3 0 2 4\n"),
                                "a face refers to point 4, but the mesh has 4 points, numbered from 0"),
            "a negative length": (
                self.binary(b"\xfd" + self.FACES[1:], of_faces=("list char int vertex_indices",)),
                "a face has a list of -3 values"),
            "binary, cut off": (self.binary(self.FACES[:-4]), "the file ends before its last face"),
            "many corners": (self.binary(many, of_faces=("list int int vertex_indices",)),
                             "a face has 300 corners, but VTK reads at most 255"),
        })


if __name__ == "__main__":
    unittest.main()
