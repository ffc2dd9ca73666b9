# SPDX-License-Identifier: BSD-3-Clause
"""OFF files: every variant of the text format is read; others are refused."""

import unittest

import numpy as np
from mesh_files import SQUARE_OFF, InFolder, faces_of, points_of, values_of
from spectralwatermark.io import read_mesh


class ReadingTest(InFolder):
    def test_variants(self):
        counts_beside = SQUARE_OFF.replace(b"OFF\n", b"OFF ")
        commented = b"# made by hand\n" + SQUARE_OFF.replace(
            b"1 1 0\n", b"\n  1 1 0 # a corner\n") + b"# the end"
        for name, data in {
                "plain": SQUARE_OFF, "counts beside": counts_beside,
                "counts glued on": counts_beside.replace(b"OFF ", b"OFF"),
                "comments and empty lines": commented,
                "no line break at the end": SQUARE_OFF[:-1],
                "no number of edges": SQUARE_OFF.replace(b"4 2 5", b"4 2"),
                "line breaks of Windows": SQUARE_OFF.replace(b"\n", b"\r\n"),
                "colours of faces": SQUARE_OFF.replace(b"0 2 3", b"0 2 3 255 0 0")}.items():
            with self.subTest(name):
                mesh = read_mesh(self.file("mesh.off", data))
                self.assert_square(mesh)
                self.assertEqual(points_of(mesh).dtype, np.float64)

    def test_faces_of_any_size(self):
        mesh = read_mesh(self.file("mesh.OFF", SQUARE_OFF.replace(b"3 0 1 2", b"4 0 1 2 3")))
        self.assertEqual(faces_of(mesh), [[0, 1, 2, 3], [0, 2, 3]])

    def test_attributes(self):
        def with_columns(word, columns):
            data = SQUARE_OFF.replace(b"OFF", word + b"OFF")
            for point in (b"0 0 0\n", b"1 0 0\n", b"1 1 0\n", b"0 1 0.5\n"):
                data = data.replace(b"\n" + point, b"\n" + point[:-1] + b" " + columns + b"\n")
            mesh = read_mesh(self.file("mesh.off", data))
            self.assert_square(mesh)
            return mesh.GetPointData()

        for columns, colour in ((b"255 128 0 64", [255, 128, 0, 64]), (b"255 128 0", [255, 128, 0]),
                                (b"1.0 0.5 0 0.25", [255, 128, 0, 64])):
            data = with_columns(b"C", columns)
            np.testing.assert_array_equal(values_of(data.GetScalars()), [colour] * 4)
        data = with_columns(b"N", b"0 0 1")
        np.testing.assert_array_equal(values_of(data.GetNormals()), [[0, 0, 1]] * 4)
        data = with_columns(b"STCN", b"0 1 0 10 20 30 40 0.25 0.75")
        np.testing.assert_array_equal(values_of(data.GetNormals()), [[0, 1, 0]] * 4)
        np.testing.assert_array_equal(values_of(data.GetScalars()), [[10, 20, 30, 40]] * 4)
        np.testing.assert_array_equal(values_of(data.GetTCoords()), [[0.25, 0.75]] * 4)

    def test_each_says_what_is_wrong(self):
        self.assert_each_refused(".off", {
            "other file": (b"solid pebble\n", "does not start with OFF, COFF or NOFF; is it an OFF file?"),
            "only comments": (b"# OFF\n", "OFF"),
            "binary": (b"OFF BINARY\n\0\0\0\4", "binary"),
            "four dimensions": (SQUARE_OFF.replace(b"OFF", b"4OFF"), "three dimensions"),
            "no counts": (b"OFF\n", "numbers of points"),
            "words for counts": (SQUARE_OFF.replace(b"4 2 5", b"four two"), "numbers of"),
            "negative counts": (SQUARE_OFF.replace(b"4 2 5", b"4 -2 5"), "-2 faces"),
            "cut off": (SQUARE_OFF[:-8], "4 points and 2 faces, but 5 lines follow", "cut off"),
            "unannounced colours": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1 0 9 9 9\n"),
                                    "line 5"),
            "a missing coordinate": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1\n"), "line 5"),
            "no number": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1 z\n"), "line 5"),
            "not finite": (
                SQUARE_OFF.replace(b"1 1 0\n", b"1 1 nan\n"),
                "line 5 is not a point of 3 finite numbers; the first line must be COFF for "
                "colours, NOFF for normals"),
            "a point too far": (SQUARE_OFF.replace(b"0 2 3", b"0 2 4"),
                                "line 8 is not a face of three or more of the 4 points"),
            "a negative point": (SQUARE_OFF.replace(b"0 2 3", b"0 2 -1"), "line 8"),
            "a missing corner": (SQUARE_OFF.replace(b"0 2 3", b"0 2"), "line 8"),
            "two corners": (SQUARE_OFF.replace(b"3 0 2 3", b"2 0 2"), "line 8"),
        })


if __name__ == "__main__":
    unittest.main()
