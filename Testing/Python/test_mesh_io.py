# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files of all formats: marks and attributes come through them; other files get one line."""

import resource
import signal
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from mesh_files import (
    PEBBLE,
    ROOT,
    WRITTEN,
    InFolder,
    decorate,
    faces_of,
    named,
    ply,
    points_of,
    texts_of,
    triangle,
    values_of,
)
from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from spectralwatermark.io import read_mesh, stores_float, write_file, write_mesh
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

MESSAGE = "10110"


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

    def test_what_is_no_surface_is_not_written(self):
        for suffix in WRITTEN:
            for mesh, text in ((vtkPolyData(), "no polygons"),
                               (triangle(faces=[(0, 1, 7)]), "point 7"),
                               (triangle(faces=[(0, 1, 2), (0, 1)]), "fewer than 3")):
                self.assert_refused(lambda path, mesh=mesh: write_mesh(mesh, path),
                                    self.folder / f"mesh{suffix}", "not written", text)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_file_that_is_not_to_be_replaced(self):
        old = self.file("mesh.ply", b"old")
        self.assert_refused(lambda path: write_mesh(triangle(), path, replace=False), old,
                            "already exists; not overwritten")
        self.assertEqual(old.read_bytes(), b"old")

    def test_targets_that_cannot_be(self):
        def write(path):
            write_mesh(triangle(), path)

        (self.folder / "folder.ply").mkdir()
        for suffix in WRITTEN:
            self.assert_refused(write, self.folder / "missing" / f"mesh{suffix}", "missing does not exist; create it first")
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
        self.assert_refused(read_mesh, self.folder / "missing.ply", "file not found; check its name and folder")
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
                                      "the mesh in another program first\n")

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
