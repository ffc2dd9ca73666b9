# SPDX-License-Identifier: BSD-3-Clause
"""VTP files: every encoding is read; files that are not what their XML says are refused."""

import re
import struct
import unittest

import numpy as np
from mesh_files import PEBBLE, InAnotherProcess, InFolder, decorate, faces_of, points_of, triangle
from spectralwatermark.io import read_mesh, write_mesh
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


class ReadingTest(InFolder):
    def test_every_encoding(self):
        mesh = read_mesh(PEBBLE)
        decorate(mesh)
        for mode in ("Ascii", "Binary", "Appended"):
            for encoded in (False, True):
                for compressor in ("None", "ZLib"):
                    for header in ("UInt32", "UInt64"):
                        with self.subTest(mode=mode, encoded=encoded, compressor=compressor, header=header):
                            writer = vtkXMLPolyDataWriter()
                            getattr(writer, f"SetDataModeTo{mode}")()
                            writer.SetEncodeAppendedData(encoded)
                            getattr(writer, f"SetCompressorTypeTo{compressor}")()
                            getattr(writer, f"SetHeaderTypeTo{header}")()
                            writer.SetInputData(mesh)
                            writer.SetFileName(str(self.folder / "mesh.vtp"))
                            writer.Write()
                            again = read_mesh(self.folder / "mesh.vtp")
                            np.testing.assert_array_equal(points_of(again), points_of(mesh))
                            self.assertEqual(faces_of(again), faces_of(mesh))


class DamageTest(InAnotherProcess):
    def test_damaged_files(self):
        write_mesh(read_mesh(PEBBLE), self.folder / "whole.vtp")
        data = (self.folder / "whole.vtp").read_bytes()
        head = data.index(b"<AppendedData")
        self.assert_all_refused(".vtp", {
            **self.cuts("cut", data, (
                5, head // 2, head, head + 40, (head + len(data)) // 2, len(data) - 200)),
            "as-text": data.replace(b"\n", b"\r\n"),
            "points": data.replace(b'Points="10242"', b'Points="99999999999999"'),
            "negative": data.replace(b'Points="10242"', b'Points="-5"'),
            "other": data.replace(b"PolyData", b"ImageData"),
            "lzma": data.replace(b"vtkZLibDataCompressor", b"vtkLZMADataCompressor"),
            "no-offsets": data.replace(b'Name="offsets"', b'Name="other"'),
            **{f"shifted-{shift}": self.shifted(data, shift) for shift in (-5, -1, 1, 4, 9999)},
            **{f"byte-{at}": data[:at] + bytes([data[at] ^ 0xff]) + data[at + 1:]
               for at in (data.index(b"_", head) + k for k in (1, 5, 9, 13, 300))},
        })

    @staticmethod
    def shifted(data, shift):
        """The file with one of its arrays said to be elsewhere."""
        last = list(re.finditer(rb'offset="(\d+)"', data))[-1]
        return data[:last.start(1)] + str(int(last[1]) + shift).encode() + data[last.end(1):]


class MessageTest(InFolder):
    TEXT = (
        b'<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt32"><PolyData><Piece '
        b'NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32" '
        b'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>'
        b'<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>'
        b'<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece>'
        b'</PolyData></VTKFile>')

    def test_the_text_itself_is_read(self):
        self.assertEqual(read_mesh(self.file("sound.vtp", self.TEXT)).GetNumberOfPolys(), 1)

    def test_each_text_says_what_is_wrong(self):
        self.assert_each_refused(".vtp", {
            "no connectivity": (self.TEXT.replace(b"connectivity", b"other"),
                                "its cell arrays Polys are incomplete"),
            "no end": (self.TEXT.replace(b"</Piece>", b"").replace(b"</PolyData>", b""),
                       "its XML cannot be read"),
            "a negative offset": (self.TEXT.replace(b">3<", b">-3<"),
                                  "the offsets of its cells do not increase"),
            "a missing corner": (self.TEXT.replace(b"0 1 2<", b"0 1<"),
                                 "an array has too few numbers"),
            "a word": (self.TEXT.replace(b"0 1 2<", b"0 1 z<"), "an array holds something that is not a number"),
            "an unknown format": (self.TEXT.replace(b'format="ascii">3', b'format="braille">3'),
                                  "an array has the unknown format 'braille'"),
            "another compressor": (
                self.TEXT.replace(b'"UInt32"', b'"UInt32" compressor="vtkLZ4DataCompressor"'),
                "its compressor vtkLZ4DataCompressor is not supported"),
            "many points": (self.TEXT.replace(b'Points="3"', b'Points="99999999999"'),
                            "it claims a count of '99999999999', which a file of this size cannot have"),
        })

    def test_each_binary_part_says_what_is_wrong(self):
        write_mesh(triangle(), self.folder / "whole.vtp")
        appended = (self.folder / "whole.vtp").read_bytes()
        end = appended.rindex(b"</AppendedData>")
        one_block = struct.pack("<II", 1, 32768)
        text = "its binary part was cut off or copied as text"
        self.assert_each_refused(".vtp", {
            "cut off": (appended[:end - 20] + appended[end:], text),
            "blocks of no bytes": (appended.replace(one_block, struct.pack("<II", 1, 0)), text),
            "a last block larger than the others": (
                appended.replace(one_block, struct.pack("<II", 1, 8)), text),
        })


if __name__ == "__main__":
    unittest.main()
