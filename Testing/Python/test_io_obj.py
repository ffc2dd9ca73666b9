# SPDX-License-Identifier: BSD-3-Clause
"""OBJ files: seams, materials and groups come through; damaged files are refused."""

import unittest

import numpy as np
from mesh_files import (
    SQUARE_OBJ,
    InAnotherProcess,
    InFolder,
    faces_of,
    named,
    points_of,
    strings,
    triangle,
    values_of,
)
from spectralwatermark.io import read_mesh, write_mesh


class WritingTest(InFolder):
    def test_text_itself_holds_the_float(self):
        write_mesh(triangle([[0, 0, 0], [1, 0, 0], [1 / 3, 1, 0]]), self.folder / "mesh.obj")
        written = [line.split() for line in (self.folder / "mesh.obj").read_text().splitlines()
                   if line.startswith("v ")]
        self.assertEqual(float(written[2][1]), float(np.float32(1 / 3)))

    def test_materials_in_any_order_lose_no_face(self):
        """VTK's own way of writing materials ends at the first face out of order."""
        mesh = triangle(faces=[(0, 1, 2)] * 5)
        mesh.GetCellData().AddArray(named(np.array([1, 0, 1, 0, 0], np.int32), "MaterialIds"))
        mesh.GetPointData().SetTCoords(named(np.eye(3, 2, dtype=np.float32), "t"))
        mesh.GetFieldData().AddArray(strings(["one", "two words"], "MaterialNames"))
        write_mesh(mesh, self.folder / "mesh.obj")
        lines = [line for line in (self.folder / "mesh.obj").read_text().splitlines()
                 if line.startswith(("usemtl", "f "))]
        face = "f 1/1 2/2 3/3"
        self.assertEqual(lines, ["usemtl two_words", face, "usemtl one", face, "usemtl two_words",
                                 face, "usemtl one", face, face])


class ReadingTest(InFolder):
    def test_seams_repeat_points_and_nothing_else_does(self):
        """VTK's reader makes points of all corners as soon as one point has two of something."""
        points = SQUARE_OBJ.split(b"f")[0]
        texture = b"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt .5 .5\n"
        mesh = read_mesh(self.file("mesh.obj", points + texture + (
            b"f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n")))
        np.testing.assert_array_equal(points_of(mesh), [
            [0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [0, 1, .5]])
        np.testing.assert_array_equal(values_of(mesh.GetPointData().GetTCoords()), [
            [0, 0], [1, 0], [1, 1], [.5, .5], [0, 1]])
        self.assertEqual(faces_of(mesh), [[0, 1, 2], [3, 2, 4]])

        mesh = read_mesh(self.file("mesh.obj", points + texture + (
            b"vn 0 0 1\nvn 0 1 0\nf 3/1/1 2/2/1 1/3/1\nf 4/4/2 3/1/1 1/3/1\n")))
        self.assertEqual(faces_of(mesh), [[0, 1, 2], [3, 0, 2]])
        np.testing.assert_array_equal(values_of(mesh.GetPointData().GetNormals()), [
            [0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 1, 0]])

    def test_materials_share_one_array_of_texture_coordinates(self):
        mesh = read_mesh(self.file("mesh.obj", b"mtllib a.mtl\n" + SQUARE_OBJ.split(b"f")[0] + (
            b"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 7 7\nusemtl red\nf 1/1 2/2 3/3\n"
            b"usemtl blue\nf 1/1 3/3 4/4\n")))
        self.assert_square(mesh)
        data = mesh.GetPointData()
        self.assertEqual([data.GetArrayName(i) for i in range(data.GetNumberOfArrays())],
                         ["TCoords"])
        np.testing.assert_array_equal(values_of(data.GetTCoords()),
                                      [[0, 0], [1, 0], [1, 1], [0, 1]])
        np.testing.assert_array_equal(values_of(mesh.GetCellData().GetArray("MaterialIds")),
                                      [0, 1])

    def test_arrays_fit_when_lines_are_there_too(self):
        mesh = read_mesh(self.file("mesh.obj", b"g a\n" + SQUARE_OBJ + b"l 1 2\n"))
        self.assertEqual(mesh.GetNumberOfLines(), 1)
        np.testing.assert_array_equal(values_of(mesh.GetCellData().GetArray("GroupIds")),
                                      [-1, 0, 0])


class DamageTest(InAnotherProcess):
    def test_damaged_files(self):
        two = SQUARE_OBJ.split(b"f")[0]
        self.assert_all_refused(".obj", {
            "far": two + b"f 1 2 300000000\n",
            "one-too-far": two + b"f 1 2 5\n",
            "zero": two + b"f 0 1 2\n",
            "far-back": two + b"f -1 -2 -5\n",
            "texture": two + b"vt 0 0\nf 1/1 2/1 3/3000000000\n",
            "texture-back": two + b"vt 0 0\nf 1/1 2/1 3/-2\n",
            "normal": two + b"vn 0 0 1\nf 1//1 2//1 3//300000000\n",
            "half-the-normals": two + b"vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n",
            "material": two + b"vt 0 0\nusemtl " + b"m" * 5000 + b"\nf 1/1 2/1 3/1\n",
            "nameless": two + b"usemtl\nf 1 2 3\n",
            "face-of-two": SQUARE_OBJ + b"f 1 2\n",
            "comma": SQUARE_OBJ.replace(b"0.5", b"0,5"),
            "two-coordinates": SQUARE_OBJ.replace(b"v 1 1 0", b"v 1 1"),
            "two-corners": two + b"f 1 2\n",
            "words": two + b"f one two three\n",
            "cut-off": SQUARE_OBJ.replace(b"v 0 1 0.5\n", b""),
        })


class MessageTest(InFolder):
    def test_each_says_what_is_wrong(self):
        corners = b"f 1 2 3\n"
        points = SQUARE_OBJ.split(b"f")[0]
        self.assert_each_refused(".obj", {
            "a long name": (points + b"usemtl " + b"m" * 200 + b"\n" + corners,
                            "line 5: VTK reads material names of at most 99 characters"),
            "a point too far": (points + b"f 1 2 5\n", "a face refers to point 5, but the file has 4"),
            "a texture coordinate too far": (points + b"vt 0 0\nf 1/1 2/3 3/1\n",
                                             "a face refers to texture coordinate 3, but the file has 1"),
            "a normal too far": (points + b"vn 0 0 1\nf 1//1 2//3 3//1\n",
                                 "a face refers to normal 3, but the file has 1"),
            "half the normals": (points + b"vn 0 0 1\nf 1//1 2//1 3//1\n" + corners,
                                 "some faces have normals and others have none"),
        })

    def test_each_quotes_the_line_that_is_wrong(self):
        corners = b"f 1 2 3\n"
        points = SQUARE_OBJ.split(b"f")[0]
        self.assert_each_refused(".obj", {
            "a word": (points + b"f 1 2 x\n", "line 5 is not valid OBJ: 'f 1 2 x'"),
            "a slash at the end": (points + b"vt 0 0\nf 1/1 2/ 3/1\n",
                                   "line 6 is not valid OBJ: 'f 1/1 2/ 3/1'"),
            "two slashes at the end": (points + b"f 1// 2// 3//\n",
                                       "line 5 is not valid OBJ: 'f 1// 2// 3//'"),
            "a slash in front": (points + b"f 1 2 /3\n", "line 5 is not valid OBJ: 'f 1 2 /3'"),
            "an underscore": (points + b"v 1_0 0 0\n" + corners,
                              "line 5 is not valid OBJ: 'v 1_0 0 0'"),
            "not finite": (points + b"v nan 0 0\n" + corners,
                           "line 5 is not valid OBJ: 'v nan 0 0'"),
        })


if __name__ == "__main__":
    unittest.main()
