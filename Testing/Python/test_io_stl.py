# SPDX-License-Identifier: BSD-3-Clause
"""STL files: what no reader would keep is not written; damaged files are refused."""

import struct
import unittest

from mesh_files import PEBBLE, InAnotherProcess, InFolder, triangle
from spectralwatermark.io import read_mesh, write_mesh
from vtkmodules.vtkIOGeometry import vtkSTLWriter


class WritingTest(InFolder):
    def test_triangles_that_no_reader_would_keep(self):
        """Readers of STL join equal corners, and leave out what is no triangle then."""
        mesh = triangle([[0, 0, 0], [1e-9, 0, 0], [0, 1e-9, 0]])
        write_mesh(mesh, self.folder / "small.stl")
        self.assertEqual(read_mesh(self.folder / "small.stl").GetNumberOfPolys(), 1)
        far = triangle([[1, 0, 0], [1 + 1e-9, 0, 0], [1, 1e-9, 0]])
        self.assert_refused(lambda path: write_mesh(far, path), self.folder / "far.stl",
                            "not written", "same coordinates")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["small.stl"])


class DamageTest(InAnotherProcess):
    def test_damaged_files(self):
        writer = vtkSTLWriter()
        writer.SetInputData(read_mesh(PEBBLE))
        writer.SetFileName(str(self.folder / "whole.stl"))
        writer.Write()
        text = (self.folder / "whole.stl").read_bytes()
        write_mesh(read_mesh(PEBBLE), self.folder / "whole.stl")
        binary = (self.folder / "whole.stl").read_bytes()
        self.assert_all_refused(".stl", {
            **self.cuts("binary", binary, (
                10, 83, 84, 100, 84 + 50 * 7, len(binary) // 2, len(binary) - 50,
                len(binary) - 1)),
            **self.cuts("text", text, (
                3, 50, len(text) // 3, len(text) // 2, text.rindex(b"endsolid"))),
            "count": b"\0" * 80 + struct.pack("<I", 0x7fffffff) + binary[84:184],
            "long": binary + b"\0" * 60,
            "letters": b"solid \xc3\xa4\xc3\xb6\xc3\xbc " * 8 + text,
        })


class MessageTest(InFolder):
    def test_each_says_what_is_wrong(self):
        write_mesh(read_mesh(PEBBLE), self.folder / "pebble.stl")
        self.assert_each_refused(".stl", {
            "text, cut off": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 0\n",
                              "; is the file damaged?"),
            "binary, cut off": ((self.folder / "pebble.stl").read_bytes()[:-1],
                                "20480 triangles of binary STL take 1024084"),
        })


if __name__ == "__main__":
    unittest.main()
