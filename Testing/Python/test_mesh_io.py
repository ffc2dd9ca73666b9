# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files: marks and attributes come through them, and what is no mesh is said in one line."""

import os
import re
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from spectralwatermark.io import MeshFileError, read_mesh, stores_float, write_file, write_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
WRITTEN = (".ply", ".obj", ".stl", ".vtp")
MESSAGE = "10110"

# Four points, two triangles: as each format's text.
SQUARE_OFF = b"OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n"
SQUARE_OBJ = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n"
SQUARE_POINTS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]]
SQUARE_FACES = [[0, 1, 2], [0, 2, 3]]


def ply(points=b"0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n", faces=b"3 0 1 2\n3 0 2 3\n",
        of_points=(), of_faces=("list uchar int vertex_indices",), numbers=(4, 2), form="ascii"):
    """A text PLY file; of_... are its properties besides x, y and z."""
    lines = ["ply", f"format {form} 1.0", f"element vertex {numbers[0]}"]
    lines += [f"property {item}" for item in ("float x", "float y", "float z", *of_points)]
    lines += [f"element face {numbers[1]}", *(f"property {item}" for item in of_faces)]
    return "\n".join([*lines, "end_header", ""]).encode() + points + faces


def points_of(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def faces_of(mesh):
    """The corners of each face, as lists."""
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
    offsets = vtk_to_numpy(mesh.GetPolys().GetOffsetsArray())
    return [face.tolist() for face in np.split(corners, offsets[1:-1])]


def named(values, name):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    return array


def strings(values, name):
    array = vtkStringArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array


def texts_of(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def values_of(array):
    return vtk_to_numpy(array) if array else None


def decorate(mesh):
    """Everything that a file could carry."""
    random = np.random.default_rng(1)
    points, faces = mesh.GetNumberOfPoints(), mesh.GetNumberOfPolys()
    data = mesh.GetPointData()
    data.SetNormals(named(random.normal(size=(points, 3)).astype(np.float32), "n"))
    data.SetTCoords(named(random.random((points, 2)).astype(np.float32), "where"))
    data.SetScalars(named(random.integers(0, 256, (points, 4), np.uint8), "paint"))
    data.AddArray(named(random.random(points), "Thickness"))
    mesh.GetCellData().SetScalars(named(random.integers(0, 256, (faces, 3), np.uint8), "RGB"))
    mesh.GetCellData().AddArray(named(np.arange(faces, dtype=np.int32) % 3, "MaterialIds"))
    fields = mesh.GetFieldData()
    fields.AddArray(strings(["clay", "moss", "stone"], "MaterialNames"))
    fields.AddArray(strings(["pebble.mtl"], "MaterialLibraries"))
    fields.AddArray(strings(["TextureFile pebble.png"], "PLYComments"))


def triangle(points=((0, 0, 0), (1, 0, 0), (0, 1, 0)), faces=((0, 1, 2),)):
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    mesh.GetPoints().SetData(named(np.array(points, float), "Points"))
    mesh.SetPolys(vtkCellArray())
    for face in faces:
        mesh.GetPolys().InsertNextCell(len(face))
        for corner in face:
            mesh.GetPolys().InsertCellPoint(corner)
    return mesh


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def file(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def through(self, mesh, suffix):
        write_mesh(mesh, self.folder / f"mesh{suffix}")
        return read_mesh(self.folder / f"mesh{suffix}")

    def assert_square(self, mesh):
        np.testing.assert_array_equal(points_of(mesh), SQUARE_POINTS)
        self.assertEqual(faces_of(mesh), SQUARE_FACES)

    def assert_refused(self, call, path, *texts):
        with self.assertRaises(MeshFileError) as caught:
            call(path)
        text = str(caught.exception)
        self.assertEqual(text.splitlines(), [text])
        self.assertTrue(text.startswith(f"{path}: "), text)
        for part in texts:
            self.assertIn(part, text)


class RoundTripTest(InFolder):
    @classmethod
    def setUpClass(cls):
        original = read_mesh(PEBBLE)
        decorate(original)
        cls.marked = {}
        for single in (True, False):
            embed = vtkSpectralWatermarkEmbed()
            embed.SetInputData(original)
            embed.SetSchemeToPaperSlots()
            embed.SetMessage(MESSAGE)
            embed.SetOutputPointsPrecision(
                embed.SINGLE_PRECISION if single else embed.DOUBLE_PRECISION)
            embed.Update()
            cls.marked[single] = embed.GetOutput()

    def test_every_format_brings_the_mark_and_the_points_back(self):
        for suffix in WRITTEN:
            with self.subTest(suffix):
                marked = self.marked[stores_float(f"mesh{suffix}")]
                copy = self.through(marked, suffix)
                detect = vtkSpectralWatermarkDetect()
                detect.SetInputData(copy)
                detect.SetSchemeToPaperSlots()
                detect.SetNumberOfBits(len(MESSAGE))
                detect.Update()
                self.assertEqual(detect.GetExtractedMessage(), MESSAGE)
                if suffix == ".stl":  # other numbers, but the same corners in the same order
                    self.assertEqual(copy.GetNumberOfPoints(), marked.GetNumberOfPoints())
                    np.testing.assert_array_equal(points_of(copy)[faces_of(copy)],
                                                  points_of(marked)[faces_of(marked)])
                else:
                    np.testing.assert_array_equal(points_of(copy), points_of(marked))
                    self.assertEqual(faces_of(copy), faces_of(marked))

    def test_stores_float_tells_what_a_double_becomes(self):
        third = triangle(np.array([[0, 0, 0], [1, 0, 0], [1 / 3, 1, 0]]))
        for suffix in WRITTEN:
            with self.subTest(suffix):
                path = self.folder / f"mesh{suffix.upper()}"
                write_mesh(third, path)
                x = points_of(read_mesh(path))[2, 0]
                self.assertEqual(stores_float(path), x != 1 / 3)
                self.assertEqual(x, np.float32(1 / 3) if stores_float(path) else 1 / 3)

    def test_obj_text_itself_holds_the_float(self):
        write_mesh(triangle([[0, 0, 0], [1, 0, 0], [1 / 3, 1, 0]]), self.folder / "mesh.obj")
        written = [line.split() for line in (self.folder / "mesh.obj").read_text().splitlines()
                   if line.startswith("v ")]
        self.assertEqual(float(written[2][1]), float(np.float32(1 / 3)))

    def test_attributes_come_through_as_the_table_says(self):
        marked = self.marked[True]
        points, cells = marked.GetPointData(), marked.GetCellData()
        self.assertIsNotNone(points.GetArray("GeometricDistortion"))
        carried = {
            ".ply": {"colours", "texture", "cell colours", "comments"},
            ".obj": {"normals", "texture", "materials"},
            ".stl": set(),
            ".vtp": {"normals", "colours", "texture", "cell colours", "comments", "materials",
                     "Thickness", "GeometricDistortion"},
        }
        for suffix in WRITTEN:
            with self.subTest(suffix):
                copy = self.through(marked, suffix)
                data = copy.GetPointData()
                pairs = {
                    "normals": (data.GetNormals(), points.GetNormals()),
                    "colours": (data.GetScalars(), points.GetScalars()),
                    "texture": (data.GetTCoords(), points.GetTCoords()),
                    "cell colours": (copy.GetCellData().GetScalars(), cells.GetScalars()),
                    "Thickness": (data.GetArray("Thickness"), points.GetArray("Thickness")),
                    "GeometricDistortion": (data.GetArray("GeometricDistortion"),
                                            points.GetArray("GeometricDistortion")),
                    "materials": (copy.GetCellData().GetArray("MaterialIds"),
                                  cells.GetArray("MaterialIds")),
                }
                found = {what for what, (array, _) in pairs.items() if array}
                for what in found:
                    np.testing.assert_array_equal(*map(values_of, pairs[what]), what)
                for field, what in (("PLYComments", "comments"), ("MaterialNames", "materials"),
                                    ("MaterialLibraries", "materials")):
                    array = copy.GetFieldData().GetAbstractArray(field)
                    if array:
                        before = marked.GetFieldData().GetAbstractArray(field)
                        self.assertEqual(texts_of(array), texts_of(before))
                        found.add(what)
                self.assertEqual(found, carried[suffix])

    def test_writing_leaves_the_mesh_as_it_is(self):
        marked = self.marked[False]
        before = vtkPolyData()
        before.DeepCopy(marked)
        for suffix in WRITTEN:
            write_mesh(marked, self.folder / f"mesh{suffix}")
        np.testing.assert_array_equal(points_of(marked), points_of(before))
        self.assertEqual(marked.GetPointData().GetNumberOfArrays(),
                         before.GetPointData().GetNumberOfArrays())
        self.assertEqual(marked.GetPointData().GetTCoords().GetName(), "where")


class WritingTest(InFolder):
    def test_texture_coordinates_that_vtk_would_stumble_over(self):
        """Doubles crash the PLY writer, a third component the OBJ writer; u = -1 is left out."""
        mesh = triangle()
        texture = np.array([[0.25, 0.5, 9.0], [-1.0, 0.75, 9.0], [0.5, 1.0, 9.0]])
        mesh.GetPointData().SetTCoords(named(texture, "uvw"))
        for suffix in (".ply", ".obj"):
            with self.subTest(suffix):
                copy = self.through(mesh, suffix)
                np.testing.assert_allclose(values_of(copy.GetPointData().GetTCoords()),
                                           texture[:, :2], rtol=1e-7)

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

    def test_strips_are_written_as_triangles(self):
        mesh = triangle([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], faces=())
        mesh.SetStrips(vtkCellArray())
        mesh.GetStrips().InsertNextCell(4)
        for corner in range(4):
            mesh.GetStrips().InsertCellPoint(corner)
        for suffix in (".ply", ".obj", ".stl"):
            self.assertEqual(self.through(mesh, suffix).GetNumberOfPolys(), 2, suffix)
        self.assertEqual(self.through(mesh, ".vtp").GetNumberOfStrips(), 1)

    def test_polygons_stay_polygons(self):
        angles = np.linspace(0.0, 2.0 * np.pi, 256, endpoint=False)
        circle = np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=1)
        for corners in (4, 255, 256):
            mesh = triangle(circle[:corners], faces=(range(corners),))
            for suffix in (".ply", ".obj", ".vtp"):
                with self.subTest(f"{corners} in {suffix}"):
                    if corners > 255 and suffix == ".ply":
                        self.assert_refused(lambda path, mesh=mesh: write_mesh(mesh, path),
                                            self.folder / "other.ply", "256 corners")
                    else:
                        self.assertEqual(faces_of(self.through(mesh, suffix)),
                                         [list(range(corners))])

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

    def test_what_is_no_surface_is_not_written(self):
        for suffix in WRITTEN:
            for mesh, text in ((vtkPolyData(), "no polygons"),
                               (triangle(faces=[(0, 1, 7)]), "point 7"),
                               (triangle(faces=[(0, 1, 2), (0, 1)]), "fewer than 3")):
                self.assert_refused(lambda path, mesh=mesh: write_mesh(mesh, path),
                                    self.folder / f"mesh{suffix}", "not written", text)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_stl_of_triangles_that_no_reader_would_keep(self):
        """Readers of STL join equal corners, and leave out what is no triangle then."""
        mesh = triangle([[0, 0, 0], [1e-9, 0, 0], [0, 1e-9, 0]])
        write_mesh(mesh, self.folder / "small.stl")
        self.assertEqual(read_mesh(self.folder / "small.stl").GetNumberOfPolys(), 1)
        far = triangle([[1, 0, 0], [1 + 1e-9, 0, 0], [1, 1e-9, 0]])
        self.assert_refused(lambda path: write_mesh(far, path), self.folder / "far.stl",
                            "not written", "same coordinates")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["small.stl"])

    def test_a_file_that_is_not_to_be_replaced(self):
        old = self.file("mesh.ply", b"old")
        self.assert_refused(lambda path: write_mesh(triangle(), path, replace=False), old,
                            "is there already; not replaced")
        self.assertEqual(old.read_bytes(), b"old")

    def test_targets_that_cannot_be(self):
        def write(path):
            write_mesh(triangle(), path)

        (self.folder / "folder.ply").mkdir()
        for suffix in WRITTEN:
            self.assert_refused(write, self.folder / "missing" / f"mesh{suffix}", "no folder")
        self.assert_refused(write, self.folder / "folder.ply", "is a folder")
        self.assert_refused(write, self.folder / "mesh.off", ".off", ".vtp")
        self.assert_refused(write, self.folder / "mesh", "without a suffix")
        self.assert_refused(stores_float, Path("mesh.xyz"), ".xyz")
        self.assert_refused(write, self.folder / ("x" * 300 + ".ply"), "cannot be written: File name too long")
        self.assert_refused(lambda path: write_file(path, lambda partial: None), self.folder / ("x." + "y" * 300),
                            "cannot be written: File name too long")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["folder.ply"])

    def test_a_full_disk_leaves_the_old_file_and_nothing_else(self):
        child = """
import sys
from spectralwatermark.io import MeshFileError, read_mesh, write_mesh
mesh = read_mesh(sys.argv[1])
for path in sys.argv[2:]:
    try:
        write_mesh(mesh, path)
        print("written")
    except MeshFileError as error:
        print(error)
"""

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))

        old = [self.file(f"mesh{suffix}", b"old") for suffix in WRITTEN]
        result = subprocess.run([sys.executable, "-c", child, PEBBLE, *old], capture_output=True,
                                text=True, check=False, preexec_fn=limit)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        said = result.stdout.splitlines()
        self.assertEqual(len(said), len(old), said)
        for path, line in zip(old, said):
            self.assertTrue(line.startswith(f"{path}: not written: "), line)
            self.assertIn("is the disk full?", line)
            self.assertEqual(path.read_bytes(), b"old")
        self.assertEqual(sorted(self.folder.iterdir()), sorted(old))

    def test_a_file_that_is_replaced_keeps_its_permissions_and_its_links(self):
        real = self.file("real.ply", b"old")
        real.chmod(0o640)
        link = self.folder / "link.ply"
        link.symlink_to("real.ply")
        write_mesh(triangle(), link)
        self.assertTrue(link.is_symlink())
        self.assertEqual(real.stat().st_mode & 0o777, 0o640)
        self.assertEqual(read_mesh(real).GetNumberOfPoints(), 3)


class ReadingTest(InFolder):
    def test_no_file_to_read(self):
        self.assert_refused(read_mesh, self.folder / "missing.ply", "no such file")
        self.assert_refused(read_mesh, self.folder, "is a folder")
        self.assert_refused(read_mesh, self.folder / ("x" * 300 + ".ply"), "cannot be read: File name too long")
        self.assert_refused(read_mesh, self.file("mesh.xyz", b"0 0 0"), ".xyz", ".ply", ".off")
        self.assert_refused(read_mesh, self.file("mesh", b"0 0 0"), "without a suffix")
        for suffix in (*WRITTEN, ".off"):
            self.assert_refused(read_mesh, self.file(f"none{suffix}", b""), "the file is empty")

    def test_less_memory_than_reading_takes(self):
        """Small files are not asked about beforehand."""
        rows = 40_000
        path = self.file("model.off", b"OFF\n%d %d 0\n" % (rows, rows) + rows * b"1 2 3\n" + rows * b"3 0 1 2\n")
        child = """
import resource
import sys
from spectralwatermark.io import MeshFileError, read_mesh
with open("/proc/self/statm") as file:
    limit = int(file.read().split()[0]) * resource.getpagesize() + 2_000_000
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
try:
    read_mesh(sys.argv[1])
except MeshFileError as error:
    print(error)
"""
        done = subprocess.run([sys.executable, "-c", child, path], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, f"{path}: not enough memory to read it; close other programs, or simplify "
                                      "the mesh elsewhere first\n")

    def test_no_polygons(self):
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(triangle(faces=()))
        writer.SetFileName(str(self.folder / "points.vtp"))
        writer.Write()
        points_only = (self.folder / "points.vtp").read_bytes()
        for name, data in (
                ("points.ply", ply(faces=b"", numbers=(4, 0))),
                ("points.obj", b"v 0 0 0\nv 1 0 0\n"),
                ("points.off", b"OFF\n2 0 0\n0 0 0\n1 0 0\n"),
                ("nothing.stl", b"\0" * 84),
                ("points.vtp", points_only)):
            with self.subTest(name):
                self.assert_refused(read_mesh, self.file(name, data), "no polygons")

    def test_ply_as_programs_write_it(self):
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

    def test_ply_lists_of_one_length_and_of_several(self):
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
                                    f"names point {faces[-1][-1]}")

    def test_vtp_in_every_encoding(self):
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

    def test_ply_texture_coordinates_of_other_names(self):
        rows = b"0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0.5 0 1\n"
        for names in ("uv", "st", ("texture_u", "texture_v")):
            mesh = read_mesh(self.file("mesh.ply", ply(
                rows, of_points=[f"float {name}" for name in names])))
            np.testing.assert_array_equal(values_of(mesh.GetPointData().GetTCoords()),
                                          [[0, 0], [1, 0], [1, 1], [0, 1]])

    def test_ply_normals_come_in(self):
        mesh = read_mesh(self.file("mesh.ply", ply(
            b"0 0 0 0 0 1\n1 0 0 0 1 0\n1 1 0 1 0 0\n0 1 0.5 0 0 -1\n",
            of_points=("float nx", "float ny", "float nz"))))
        np.testing.assert_array_equal(values_of(mesh.GetPointData().GetNormals()),
                                      [[0, 0, 1], [0, 1, 0], [1, 0, 0], [0, 0, -1]])

    def test_ply_texture_coordinates_of_corners_join_no_points(self):
        """VTK's reader, given these, puts points together that share a texture coordinate."""
        data = ply(b"0 0 0\n1 0 0\n0 1 0\n0 0 5\n1 0 5\n0 1 5\n",
                   b"3 0 1 2 6 .1 .1 1 0 0 1\n3 3 4 5 6 .2 .2 .5 0 0 .5\n"
                   b"3 3 4 5 6 .1 .1 1 0 0 1\n",
                   of_faces=("list uchar int vertex_indices", "list uchar float texcoord"),
                   numbers=(6, 3))
        mesh = read_mesh(self.file("mesh.ply", data))
        self.assertEqual(faces_of(mesh), [[0, 1, 2], [3, 4, 5], [3, 4, 5]])
        self.assertIsNone(mesh.GetPointData().GetTCoords())

    def test_ply_colours_that_are_no_bytes_are_left_out(self):
        mesh = read_mesh(self.file("mesh.ply", ply(
            b"0 0 0 .1 .2 .3\n1 0 0 .1 .2 .3\n1 1 0 .1 .2 .3\n0 1 0.5 .1 .2 .3\n",
            of_points=("float red", "float green", "float blue"))))
        self.assert_square(mesh)
        self.assertIsNone(mesh.GetPointData().GetScalars())

    def test_obj_seams_repeat_points_and_nothing_else_does(self):
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

    def test_obj_materials_share_one_array_of_texture_coordinates(self):
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

    def test_obj_arrays_fit_when_lines_are_there_too(self):
        mesh = read_mesh(self.file("mesh.obj", b"g a\n" + SQUARE_OBJ + b"l 1 2\n"))
        self.assertEqual(mesh.GetNumberOfLines(), 1)
        np.testing.assert_array_equal(values_of(mesh.GetCellData().GetArray("GroupIds")),
                                      [-1, 0, 0])

    def test_off_variants(self):
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

    def test_off_faces_of_any_size(self):
        mesh = read_mesh(self.file("mesh.OFF", SQUARE_OFF.replace(b"3 0 1 2", b"4 0 1 2 3")))
        self.assertEqual(faces_of(mesh), [[0, 1, 2, 3], [0, 2, 3]])

    def test_off_attributes(self):
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

    def test_off_that_is_none(self):
        for name, (data, text) in {
                "other file": (b"solid pebble\n", "OFF"),
                "only comments": (b"# OFF\n", "OFF"),
                "binary": (b"OFF BINARY\n\0\0\0\4", "binary"),
                "four dimensions": (SQUARE_OFF.replace(b"OFF", b"4OFF"), "three dimensions"),
                "no counts": (b"OFF\n", "numbers of points"),
                "words for counts": (SQUARE_OFF.replace(b"4 2 5", b"four two"), "numbers of"),
                "negative counts": (SQUARE_OFF.replace(b"4 2 5", b"4 -2 5"), "-2 faces"),
                "cut off": (SQUARE_OFF[:-8], "cut off"),
                "unannounced colours": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1 0 9 9 9\n"),
                                        "line 5"),
                "a missing coordinate": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1\n"), "line 5"),
                "no number": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1 z\n"), "line 5"),
                "not finite": (SQUARE_OFF.replace(b"1 1 0\n", b"1 1 nan\n"), "line 5"),
                "a point too far": (SQUARE_OFF.replace(b"0 2 3", b"0 2 4"), "line 8"),
                "a negative point": (SQUARE_OFF.replace(b"0 2 3", b"0 2 -1"), "line 8"),
                "a missing corner": (SQUARE_OFF.replace(b"0 2 3", b"0 2"), "line 8"),
                "two corners": (SQUARE_OFF.replace(b"3 0 2 3", b"2 0 2"), "line 8")}.items():
            with self.subTest(name):
                self.assert_refused(read_mesh, self.file("mesh.off", data), text)

    def test_vtk_says_its_errors_as_before_afterwards(self):
        window = vtkOutputWindow.GetInstance()
        self.assert_refused(read_mesh, self.file("mesh.vtp", b"<VTKFile>"), "XML")
        self.assertIs(vtkOutputWindow.GetInstance(), window)

    def test_vtk_logs_on_the_terminal_as_before_afterwards(self):
        before = vtkLogger.GetCurrentVerbosityCutoff()
        self.addCleanup(vtkLogger.SetStderrVerbosity, before)
        for verbosity in (vtkLogger.VERBOSITY_OFF, vtkLogger.VERBOSITY_WARNING, vtkLogger.VERBOSITY_TRACE):
            vtkLogger.SetStderrVerbosity(verbosity)
            read_mesh(PEBBLE)
            self.assertEqual(vtkLogger.GetCurrentVerbosityCutoff(), verbosity)

    def test_the_log_file_of_all_details_does_not_bring_them_to_the_terminal(self):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # says that a log file is begun
        self.addCleanup(vtkLogger.SetStderrVerbosity, vtkLogger.VERBOSITY_INFO)
        log = str(self.folder / "all.log")
        vtkLogger.LogToFile(log, vtkLogger.TRUNCATE, vtkLogger.VERBOSITY_TRACE)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
        read_mesh(PEBBLE)
        vtkLogger.EndLogToFile(log)
        self.assertEqual(vtkLogger.GetCurrentVerbosityCutoff(), vtkLogger.VERBOSITY_INFO)


class DamageTest(InFolder):
    """Files that crash VTK's readers: read in another process, which has to live on, in silence."""

    CHILD = """
import sys
from spectralwatermark.io import MeshFileError, read_mesh
for path in sys.argv[1:]:
    try:
        print("read", read_mesh(path).GetNumberOfPolys(), flush=True)
    except MeshFileError as error:
        print("refused", error, flush=True)
"""

    def said_of(self, files):
        """The child's line for each of the files."""
        paths = [self.file(f"{name}{suffix}", data) for (name, suffix), data in files.items()]
        result = subprocess.run([sys.executable, "-c", self.CHILD, *paths], capture_output=True,
                                text=True, check=False)
        said = result.stdout.splitlines()
        self.assertEqual(len(said), len(paths), f"after {said[-1:]}: {result.stderr}")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return zip(paths, said)

    def assert_all_refused(self, files):
        for path, line in self.said_of(files):
            with self.subTest(path.name):
                self.assertTrue(line.startswith(f"refused {path}: "), line)

    def cuts(self, name, suffix, data, places):
        return {(f"{name}-{place}", suffix): data[:place] for place in places}

    def test_ply_cut_off(self):
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
        self.assert_all_refused({
            **self.cuts("binary", ".ply", binary, (
                2, 60, body - 5, body, body + 6, faces - 1, faces, faces + 1, faces + 9,
                (faces + len(binary)) // 2, len(binary) - 13, len(binary) - 1)),
            **self.cuts("text", ".ply", text, (
                3, 150, text.index(b"end_header") + 11, len(text) // 3, len(text) // 2,
                last_face, last_face + 2, text.rindex(b" ", 0, -2))),
        })

    def test_ply_that_is_not_what_it_says(self):
        count = struct.pack("<12f", *np.ravel(SQUARE_POINTS)) + struct.pack(
            "<B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)
        binary = ply(b"", count, form="binary_little_endian")
        many = (b"300 " + b"0 " * 300 + b"\n") * 2
        self.assert_all_refused({(name, ".ply"): data for name, data in {
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
        }.items()})

    def test_ply_with_names_that_vtk_takes_for_something_else(self):
        corners = "list uchar int vertex_indices"
        files = {
            ("list-of-colours", ".ply"): ply(
                faces=b"3 0 1 2 1 7 8 9\n3 0 2 3 1 7 8 9\n",
                of_faces=(corners, "list uchar uchar red", "uchar green", "uchar blue")),
            ("one-texture-coordinate", ".ply"): ply(
                faces=b"3 0 1 2 0.5\n3 0 2 3 0.5\n", of_faces=(corners, "float texcoord")),
        }
        for path, line in self.said_of(files):
            self.assertEqual(line, "read 2", path.name)

    def test_stl(self):
        writer = vtkSTLWriter()
        writer.SetInputData(read_mesh(PEBBLE))
        writer.SetFileName(str(self.folder / "whole.stl"))
        writer.Write()
        text = (self.folder / "whole.stl").read_bytes()
        write_mesh(read_mesh(PEBBLE), self.folder / "whole.stl")
        binary = (self.folder / "whole.stl").read_bytes()
        self.assert_all_refused({
            **self.cuts("binary", ".stl", binary, (
                10, 83, 84, 100, 84 + 50 * 7, len(binary) // 2, len(binary) - 50,
                len(binary) - 1)),
            **self.cuts("text", ".stl", text, (
                3, 50, len(text) // 3, len(text) // 2, text.rindex(b"endsolid"))),
            ("count", ".stl"): b"\0" * 80 + struct.pack("<I", 0x7fffffff) + binary[84:184],
            ("long", ".stl"): binary + b"\0" * 60,
            ("letters", ".stl"): b"solid \xc3\xa4\xc3\xb6\xc3\xbc " * 8 + text,
        })

    def test_vtp(self):
        write_mesh(read_mesh(PEBBLE), self.folder / "whole.vtp")
        data = (self.folder / "whole.vtp").read_bytes()
        head = data.index(b"<AppendedData")
        self.assert_all_refused({
            **self.cuts("cut", ".vtp", data, (
                5, head // 2, head, head + 40, (head + len(data)) // 2, len(data) - 200)),
            ("as-text", ".vtp"): data.replace(b"\n", b"\r\n"),
            ("points", ".vtp"): data.replace(b'Points="10242"', b'Points="99999999999999"'),
            ("negative", ".vtp"): data.replace(b'Points="10242"', b'Points="-5"'),
            ("other", ".vtp"): data.replace(b"PolyData", b"ImageData"),
            ("lzma", ".vtp"): data.replace(b"vtkZLibDataCompressor", b"vtkLZMADataCompressor"),
            ("no-offsets", ".vtp"): data.replace(b'Name="offsets"', b'Name="other"'),
            **{(f"shifted-{shift}", ".vtp"): self.shifted(data, shift) for shift in (-5, -1, 1, 4, 9999)},
            **{(f"byte-{at}", ".vtp"): data[:at] + bytes([data[at] ^ 0xff]) + data[at + 1:]
               for at in (data.index(b"_", head) + k for k in (1, 5, 9, 13, 300))},
        })

    @staticmethod
    def shifted(data, shift):
        """The file with one of its arrays said to be elsewhere."""
        last = list(re.finditer(rb'offset="(\d+)"', data))[-1]
        return data[:last.start(1)] + str(int(last[1]) + shift).encode() + data[last.end(1):]

    def test_obj(self):
        two = SQUARE_OBJ.split(b"f")[0]
        self.assert_all_refused({(name, ".obj"): data for name, data in {
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
        }.items()})

    def test_each_says_what_is_wrong(self):
        corners = b"f 1 2 3\n"
        points = SQUARE_OBJ.split(b"f")[0]
        square = struct.pack("<12f", *np.ravel(SQUARE_POINTS))
        faces = struct.pack("<B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)
        many = struct.pack("<i300i", 300, *range(3), *[0] * 297) * 2
        write_mesh(read_mesh(PEBBLE), self.folder / "pebble.stl")
        write_mesh(triangle(), self.folder / "whole.vtp")
        appended = (self.folder / "whole.vtp").read_bytes()
        end = appended.rindex(b"</AppendedData>")
        vtp = (b'<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt32"><PolyData><Piece '
               b'NumberOfPoints="3" NumberOfPolys="1"><Points><DataArray type="Float32" '
               b'NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>'
               b'<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>'
               b'<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray></Polys></Piece>'
               b'</PolyData></VTKFile>')
        self.assertEqual(read_mesh(self.file("sound.vtp", vtp)).GetNumberOfPolys(), 1)

        def binary(body, **more):
            return ply(b"", square + body, form="binary_little_endian", **more)

        for name, data, text in (
                ("1.ply", ply()[:60], "the PLY header has no end"),
                ("2.ply", ply().replace(b"float z", b"real z"), "no such line belongs into a PLY header"),
                ("3.ply", ply().replace(b"format ascii 1.0\n", b""), "the PLY header names no format"),
                ("4.ply", ply().replace(b"element face", b"element vertex 4\nelement face"),
                 "must name vertices and faces once"),
                ("5.ply", ply().replace(b"float z", b"float height"), "not described by x, y, z"),
                ("6.ply", ply(faces=b"3\n3\n", of_faces=("uchar quality",)),
                 "its faces have no list vertex_indices"),
                ("7.ply", ply(faces=b"3 0 1 2\n3 0 2\n"), "face 2 of 2 is not what its header says"),
                ("8.ply", ply(points=b"0 0 0." + b"0" * 5000 + b"\n1 0 0\n1 1 0\n0 1 0\n"),
                 "vertex 1 of 4 is a line too long for VTK"),
                ("9.ply", binary(b"\xfd" + faces[1:], of_faces=("list char int vertex_indices",)),
                 "a face has a list of -3 values"),
                ("10.ply", binary(faces[:-4]), "the file ends before its last face"),
                ("11.ply", binary(many, of_faces=("list int int vertex_indices",)),
                 "a face has 300 corners, and VTK reads no more than 255"),
                ("12.ply", ply(faces=b"3 0 1 2\n3 0 2 4\n"), "a face names point 4, counted from 0, of 4"),
                ("13.ply", ply(faces=b"3 0 1 2\n3 0 2 0_3\n"), "face 2 of 2 is not what its header says"),
                ("1.obj", points + b"usemtl " + b"m" * 200 + b"\n" + corners,
                 "line 5: VTK reads no more than 99 letters"),
                ("2.obj", points + b"f 1 2 5\n", "a face names number 5 of 4 points"),
                ("3.obj", points + b"vn 0 0 1\nf 1//1 2//1 3//1\n" + corners,
                 "some faces have normals and some none"),
                ("4.obj", points + b"f 1 2 x\n", "line 5 cannot be understood: 'f 1 2 x'"),
                ("5.obj", points + b"vt 0 0\nf 1/1 2/ 3/1\n", "line 6 cannot be understood: 'f 1/1 2/ 3/1'"),
                ("6.obj", points + b"f 1// 2// 3//\n", "line 5 cannot be understood: 'f 1// 2// 3//'"),
                ("7.obj", points + b"f 1 2 /3\n", "line 5 cannot be understood: 'f 1 2 /3'"),
                ("8.obj", points + b"v 1_0 0 0\n" + corners, "line 5 cannot be understood: 'v 1_0 0 0'"),
                ("9.obj", points + b"v nan 0 0\n" + corners, "line 5 cannot be understood: 'v nan 0 0'"),
                ("10.obj", points + b"vt 0 0\nf 1/1 2/3 3/1\n", "a face names number 3 of 1 texture coordinates"),
                ("11.obj", points + b"vn 0 0 1\nf 1//1 2//3 3//1\n", "a face names number 3 of 1 normals"),
                ("2.stl", b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 0\n", "; is the file damaged?"),
                ("1.stl", (self.folder / "pebble.stl").read_bytes()[:-1],
                 "20480 triangles of binary STL take 1024084"),
                ("1.off", SQUARE_OFF[:-8], "4 points and 2 faces announced, 5 lines there"),
                ("2.off", SQUARE_OFF.replace(b"0 2 3", b"0 2 4"), "line 8 is not a face of three or more of 4"),
                ("3.off", SQUARE_OFF.replace(b"1 1 0\n", b"1 1 nan\n"),
                 "line 5 is not a point of 3 finite numbers; colours need COFF in the first line, normals NOFF"),
                ("4.off", b"solid pebble\n", "does not begin with OFF, COFF or NOFF; is it an OFF file?"),
                ("9.vtp", appended[:end - 20] + appended[end:], "its binary part is cut off or was copied as text"),
                *((f"{name}.vtp", appended.replace(struct.pack("<II", 1, 32768), struct.pack("<II", 1, block)),
                   "its binary part is cut off or was copied as text") for name, block in (("10", 0), ("11", 8))),
                ("1.vtp", vtp.replace(b"connectivity", b"other"), "its Polys are incomplete"),
                ("2.vtp", vtp.replace(b"</Piece>", b"").replace(b"</PolyData>", b""),
                 "its XML cannot be read"),
                ("3.vtp", vtp.replace(b">3<", b">-3<"), "its cells do not follow each other"),
                ("4.vtp", vtp.replace(b"0 1 2<", b"0 1<"), "an array has fewer numbers than it should"),
                ("5.vtp", vtp.replace(b"0 1 2<", b"0 1 z<"), "an array holds what is no number"),
                ("6.vtp", vtp.replace(b'format="ascii">3', b'format="braille">3'),
                 "in the format 'braille', which is unknown"),
                ("7.vtp", vtp.replace(b'"UInt32"', b'"UInt32" compressor="vtkLZ4DataCompressor"'),
                 "compressed by vtkLZ4DataCompressor, which is not supported"),
                ("8.vtp", vtp.replace(b'Points="3"', b'Points="99999999999"'),
                 "a file of this size cannot have")):
            with self.subTest(name, text=text):
                self.assert_refused(read_mesh, self.file(name, data), text)

    def test_the_demo_says_it_in_one_line(self):
        path = self.file("cut.ply", PEBBLE.read_bytes()[:200_000])
        result = subprocess.run(
            [sys.executable, ROOT / "Examples" / "Demo" / "watermark_demo.py", path,
             "--no-pictures", "--output", self.folder / "out"],
            capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, rf"\Aerror: {path}: .*cut off.*\n\Z")


if __name__ == "__main__":
    unittest.main()
