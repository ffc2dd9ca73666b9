# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of mesh files share: small meshes, and assertions about files."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from spectralwatermark.io import MeshFileError, read_mesh, write_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
WRITTEN = (".ply", ".obj", ".stl", ".vtp")

# Four points, two triangles: as each format's text.
SQUARE_OFF = b"OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n"
SQUARE_OBJ = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3\nf 1 3 4\n"
SQUARE_POINTS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]]
SQUARE_FACES = [[0, 1, 2], [0, 2, 3]]


def points_of(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def faces_of(mesh):
    """The corners of each face, as lists."""
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
    offsets = vtk_to_numpy(mesh.GetPolys().GetOffsetsArray())
    return [face.tolist() for face in np.split(corners, offsets[1:-1])]


def values_of(array):
    return vtk_to_numpy(array) if array else None


def texts_of(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


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


def ply(points=b"0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n", faces=b"3 0 1 2\n3 0 2 3\n",
        of_points=(), of_faces=("list uchar int vertex_indices",), numbers=(4, 2), form="ascii"):
    """A text PLY file; of_... are its properties besides x, y and z."""
    lines = ["ply", f"format {form} 1.0", f"element vertex {numbers[0]}"]
    lines += [f"property {item}" for item in ("float x", "float y", "float z", *of_points)]
    lines += [f"element face {numbers[1]}", *(f"property {item}" for item in of_faces)]
    return "\n".join([*lines, "end_header", ""]).encode() + points + faces

class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

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

    def assert_each_refused(self, suffix, cases):
        """Each file is refused with its texts; the cases are {name: (data, *texts)}."""
        for name, (data, *texts) in cases.items():
            with self.subTest(name, texts=texts):
                self.assert_refused(read_mesh, self.file(f"mesh{suffix}", data), *texts)


class InAnotherProcess(InFolder):
    """Files that crash VTK's readers: another process reads them, survives, and prints nothing else."""

    CHILD = """
import sys
from spectralwatermark.io import MeshFileError, read_mesh
for path in sys.argv[1:]:
    try:
        print("read", read_mesh(path).GetNumberOfPolys(), flush=True)
    except MeshFileError as error:
        print("refused", error, flush=True)
"""

    def said_of(self, suffix, files):
        """The child's line for each of the files."""
        paths = [self.file(f"{name}{suffix}", data) for name, data in files.items()]
        result = subprocess.run([sys.executable, "-c", self.CHILD, *paths], capture_output=True,
                                text=True, check=False)
        said = result.stdout.splitlines()
        self.assertEqual(len(said), len(paths), f"after {said[-1:]}: {result.stderr}")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return zip(paths, said)

    def assert_all_refused(self, suffix, files):
        for path, line in self.said_of(suffix, files):
            with self.subTest(path.name):
                self.assertTrue(line.startswith(f"refused {path}: "), line)

    @staticmethod
    def cuts(name, data, places):
        return {f"{name}-{place}": data[:place] for place in places}
