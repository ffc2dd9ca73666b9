#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the constants of the memory estimates and compares them with those in the source.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 \\
        Testing/Benchmark/memory/measure.py [--only WORD ...] [--scale FACTOR]

Before a task that needs much memory, the library estimates how much. An estimate is a sum of
constants, each times a number of units: triangles, vertices, nodes of a grid, bytes of a file.
CASES lists one or more tasks for each constant. The mesh of a task is so large that its constant
makes up most of the estimate. Tasks of one constant differ in what they need, and the constant
should cover them all.

A task runs in a process of its own, after a small task of the same kind has loaded the code. The
measured value is the peak of resident memory over the level before the task, less the other
constants' share of the estimate, divided by the number of units. Some filters make their estimate
only after they have converted the mesh, which then takes 44 bytes per triangle. The measured value
includes these.

A constant below the measured value is too small: a task may start although it will run out of
memory. MEMORY_PER_BYTE of a file format is different. Files of one format and size differ much in
what they need, and no file should be refused that could be read. So this constant must not be above
the least of the measured values.

The program needs Linux, Debian's python3-vtk9 and the built package. It takes two to five minutes
and 1.2 GB of memory.
"""

from __future__ import annotations

import argparse
import ctypes
import gc
import math
import multiprocessing
import re
import tempfile
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from spectralwatermark import (
    vtkManifoldHarmonics,
    vtkManifoldHarmonicsReconstruction,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.execution import FilterError, update
from spectralwatermark.io import read_mesh, write_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

SOURCE = Path(__file__).resolve().parents[3]
# The scale of the task that loads the code, and of every task in --check.
SMALL = 0.004
# The relative error of a measurement.
TOLERANCE = 0.02


@dataclass(frozen=True)
class Task:
    run: Callable[[], object]
    #: The number of units of each constant in the estimate, by the constant's name.
    units: dict[str, float]


@dataclass(frozen=True)
class Case:
    #: The name of the constant in the source.
    constant: str
    #: The file with the constant, relative to the root of the source.
    file: str
    unit: str
    task: str
    #: Makes a task whose need of memory is proportional to the scale.
    prepare: Callable[[float], Task]
    #: Whether the constant is the least need of several kinds of files.
    is_least: bool = False

    def is_named(self, words: Iterable[str]) -> bool:
        return any(word in f"{self.file} {self.constant} {self.task}" for word in words)

    def verdict(self, value: float, measured: float) -> str:
        """Why the value of the constant is wrong, or nothing."""
        if self.is_least:
            return "too large" if value > (1.0 + TOLERANCE) * measured else ""
        return "too small" if measured > (1.0 + TOLERANCE) * value else ""


def constant(file: str, name: str) -> float:
    """The value of a constant in the C++ or Python source."""
    pattern = rf"^ *(?:constexpr \w+ )?{name} = ([0-9.e+]+)( \* sizeof\(double\))?;?$"
    found = re.findall(pattern, (SOURCE / file).read_text(), re.MULTILINE)
    if len(found) != 1:
        raise SystemExit(f"{file} has {len(found)} definitions of {name} instead of one")
    ((number, of_doubles),) = found
    return float(number) * (8.0 if of_doubles else 1.0)


# --- Meshes ------------------------------------------------------------------------------------


def bumpy_torus(triangles: float, size: Sequence[float] = (1.0, 1.0, 1.0),
                centre: Sequence[float] = (0.0, 0.0, 0.0)) -> vtkPolyData:
    """A closed mesh without symmetry that has about this number of triangles."""
    rows = max(8, round(math.sqrt(triangles / 6.0)))
    columns = 3 * rows
    v, u = np.meshgrid(*(2.0 * np.pi * np.arange(n) / n for n in (rows, columns)), indexing="ij")
    tube = 0.3 + 0.04 * np.sin(2.0 * u + v) + 0.03 * np.cos(3.0 * u)
    ring = 0.65 + tube * np.cos(v)
    points = np.stack(
        (ring * np.cos(u), (ring + 0.1 * np.sin(u)) * np.sin(u), tube * np.sin(v)), axis=-1)

    a = np.arange(rows * columns).reshape(rows, columns)
    b, d = np.roll(a, -1, axis=1), np.roll(a, -1, axis=0)
    c = np.roll(d, -1, axis=1)
    triangles_of_squares = np.stack((a, b, c, a, c, d), axis=-1)
    return poly_data(np.asarray(centre) + np.asarray(size) * points.reshape(-1, 3),
                     triangles_of_squares.reshape(-1, 3))


def far_apart(triangles: float, size: float) -> vtkPolyData:
    """Two tori of this size, which are in opposite corners of a large cube."""
    a = bumpy_torus(triangles, (size, size, size))
    b = bumpy_torus(triangles, (size, size, size), (2.0, 2.0, 2.0))
    return poly_data(np.vstack((points_of(a), points_of(b))),
                     np.vstack((corners_of(a), corners_of(b) + a.GetNumberOfPoints())))


def poly_data(coordinates: np.ndarray, triangles: np.ndarray) -> vtkPolyData:
    points = vtkPoints()
    points.SetData(numpy_to_vtk(coordinates, deep=True))
    cells = vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(array, deep=True) for array in (
        np.arange(0, triangles.size + 1, 3), triangles.ravel())))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


def points_of(mesh: vtkPolyData) -> np.ndarray:
    return vtk_to_numpy(mesh.GetPoints().GetData())


def corners_of(mesh: vtkPolyData) -> np.ndarray:
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def areas_of(mesh: vtkPolyData) -> np.ndarray:
    a, b, c = points_of(mesh)[corners_of(mesh)].swapaxes(0, 1)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def extent_of(mesh: vtkPolyData) -> np.ndarray:
    return np.ptp(points_of(mesh), axis=0)


# --- Tasks of the filters ----------------------------------------------------------------------


def task_of(algorithm: vtkAlgorithm, **units: float) -> Task:
    return Task(partial(update, algorithm), units)


def attack_on(mesh: vtkPolyData, kind: int) -> vtkMeshAttack:
    attack = vtkMeshAttack()
    attack.SetInputData(mesh)
    attack.SetAttack(kind)
    return attack


def rotate(scale: float) -> Task:
    mesh = bumpy_torus(1e6 * scale)
    return task_of(attack_on(mesh, vtkMeshAttack.Rotation),
                   conversionBytesPerPolygon=mesh.GetNumberOfPolys())


def convert(scale: float) -> Task:
    """The filter converts the mesh, then refuses a rotation about an axis of no length."""
    mesh = bumpy_torus(1e6 * scale)
    attack = attack_on(mesh, vtkMeshAttack.Rotation)
    attack.SetRotationAxis(0.0, 0.0, 0.0)

    def run() -> None:
        with suppress(FilterError):
            update(attack)
        if attack.GetErrorParameter() != "RotationAxis":
            raise RuntimeError("the conversion of the mesh failed")

    return Task(run, {"conversionBytesPerPolygon": mesh.GetNumberOfPolys()})


def detect(scale: float) -> Task:
    mesh = bumpy_torus(1.5e5 * scale)
    detection = vtkSpectralWatermarkDetect()
    detection.SetInputData(mesh)
    detection.SetSecretKey("an owner")
    detection.SetNumberOfBits(2)
    return task_of(detection, detectionBytesPerTriangle=mesh.GetNumberOfPolys())


def subdivide(kind: str, scale: float) -> Task:
    mesh = bumpy_torus(4e5 * scale)
    attack = attack_on(mesh, vtkMeshAttack.Subdivision)
    attack.SetSubdivisionType(getattr(vtkMeshAttack, kind))
    parts = 3 if kind == "Sqrt3" else 4
    return task_of(attack, subdivisionBytesPerTriangle=parts * mesh.GetNumberOfPolys())


def smooth(scale: float) -> Task:
    mesh = bumpy_torus(1e6 * scale)
    return task_of(attack_on(mesh, vtkMeshAttack.LaplacianSmoothing),
                   smoothingBytesPerTriangle=mesh.GetNumberOfPolys())


def simplify(scale: float) -> Task:
    mesh = bumpy_torus(5e5 * scale)
    return task_of(attack_on(mesh, vtkMeshAttack.Simplification),
                   simplificationBytesPerTriangle=mesh.GetNumberOfPolys())


def compare(scale: float) -> Task:
    mesh = bumpy_torus(2e5 * scale)
    moved = attack_on(mesh, vtkMeshAttack.NoiseUniform)
    update(moved)
    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, mesh)
    distortion.SetInputData(1, moved.GetOutput())
    return task_of(distortion, comparisonBytesPerTriangle=2 * mesh.GetNumberOfPolys())


def remesh_uniformly(mesh: vtkPolyData) -> Task:
    attack = attack_on(mesh, vtkMeshAttack.Remeshing)
    attack.SetRemeshingMethodToUniform()
    attack.SetRemeshingPercent(100.0)
    # ResampleUniformly() begins with this step of the grid and corrects it once it has the points.
    step = math.sqrt(1.5 * areas_of(mesh).sum() / mesh.GetNumberOfPoints())
    corrected = step * math.sqrt(occupied_cells(mesh, step) / mesh.GetNumberOfPoints())
    return task_of(attack, BytesPerPiece=new_pieces(mesh, 0.5 * step),
                   BytesPerCell=np.ceil(extent_of(mesh) / corrected).prod())


def new_pieces(mesh: vtkPolyData, edge: float) -> float:
    """The same as NumberOfNewPieces() in Resampling.cxx."""
    corners = points_of(mesh)[corners_of(mesh)]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    by_area = 8.0 * areas_of(mesh) / edge ** 2
    by_length = (longest / edge) ** math.log2(3.0)
    return (np.maximum(np.maximum(by_area, by_length), 1.0) - 1.0).sum()


def occupied_cells(mesh: vtkPolyData, step: float) -> int:
    """The number of cells of a grid with this step that contain some of the surface."""
    n = 16
    weights = np.array([(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)]) / n
    samples = (weights @ points_of(mesh)[corners_of(mesh)]).reshape(-1, 3)
    cells = ((samples - samples.min(axis=0)) / step).astype(int)
    return len(np.unique(np.ravel_multi_index(cells.T, cells.max(axis=0) + 1)))


def split(scale: float) -> Task:
    """Of the shapes that were tried, needles need the most memory for each of their pieces."""
    return remesh_uniformly(bumpy_torus(3e4 * scale, (1.0, 0.01, 0.01)))


def cluster(scale: float) -> Task:
    """The grid fills a cube, of which the surface takes little."""
    return remesh_uniformly(far_apart(5e3, 0.16 / scale ** (1.0 / 3.0)))


def extract_isosurface(mesh: vtkPolyData, resolution: int) -> Task:
    attack = attack_on(mesh, vtkMeshAttack.Remeshing)
    attack.SetRemeshingMethodToIsosurface()
    attack.SetIsosurfaceResolution(resolution)
    step = extent_of(mesh).max() / resolution
    return task_of(attack, bytesPerNode=(extent_of(mesh) / step + 7.0).prod(),
                   bytesPerSquare=areas_of(mesh).sum() / step ** 2)


def fill_grid(scale: float) -> Task:
    side = scale ** (1.0 / 3.0)
    return extract_isosurface(far_apart(2e3, 0.02 / side), round(450 * side))


def extract_flat_isosurface(scale: float) -> Task:
    """The surface is so flat that the grid around it has few nodes."""
    resolution = round(450 * math.sqrt(scale))
    return extract_isosurface(bumpy_torus(1e4, (1.0, 1.0, 20.0 / resolution)), resolution)


def harmonics_of(triangles: float, count: int) -> vtkManifoldHarmonics:
    """On a mesh of at least so many vertices that the solver is the one for large meshes."""
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(bumpy_torus(max(triangles, 2500 + 10 * count)))
    harmonics.SetNumberOfHarmonics(count)
    return harmonics


def compute_harmonics(triangles: float, count: int, scale: float) -> Task:
    harmonics = harmonics_of(triangles * scale, max(20, round(count * scale)))
    vertices = harmonics.GetInput().GetNumberOfPoints()
    return task_of(harmonics, factorBytesPerVertex=vertices,
                   vectorBytesPerVertex=vertices * harmonics.GetNumberOfHarmonics())


def compute_harmonics_densely(scale: float) -> Task:
    harmonics = harmonics_of(0.0, 50)
    mesh = bumpy_torus(3600 * math.sqrt(scale))
    harmonics.SetInputData(mesh)
    harmonics.SetSolverToDense()
    return task_of(harmonics, bytesPerDenseEntry=mesh.GetNumberOfPoints() ** 2)


def adopt(triangles: float, count: int, scale: float) -> Task:
    harmonics = harmonics_of(triangles * scale, max(20, round(count * scale)))
    update(harmonics)
    reconstruction = vtkManifoldHarmonicsReconstruction()
    reconstruction.SetInputData(harmonics.GetOutput())
    size = harmonics.GetInput().GetNumberOfPoints() * harmonics.GetNumberOfHarmonics()
    return task_of(reconstruction, basesAtPeak=8.0 * size)


def embed(distortion: float | None, scale: float) -> Task:
    mesh = bumpy_torus(max(1e5 * scale, 2e3))
    embedding = vtkSpectralWatermarkEmbed()
    embedding.SetInputData(mesh)
    embedding.SetSecretKey("an owner")
    if distortion is not None:
        embedding.SetMaximumDistortion(distortion)
    patterns = number_of_patterns(embedding.GetNumberOfBits())
    return task_of(embedding, patternsAtPeak=8.0 * mesh.GetNumberOfPoints() * patterns)


def number_of_patterns(bits: int) -> float:
    """Of the carriers that hold so many bits, and of the moments of the frame."""
    scheme, golay = "Filters/Core/RobustScheme", "Filters/Core/Payload/GolayCode.h"
    checked = bits + constant(f"{scheme}/CarrierSet.cxx", "LeastCheckBits")
    words = math.ceil(checked / constant(golay, "GolayDataBits"))
    return (words * constant(golay, "GolayCodeBits")
            + constant(f"{scheme}/SolidResponse.h", "FrameMoments"))


# --- Tasks of the file formats -----------------------------------------------------------------

WriteMesh = Callable[[vtkPolyData, Path], None]


def write_text_ply(mesh: vtkPolyData, path: Path) -> None:
    writer = vtkPLYWriter()
    writer.SetFileTypeToASCII()
    write_with(writer, mesh, path)


def write_text_stl(mesh: vtkPolyData, path: Path) -> None:
    writer = vtkSTLWriter()
    writer.SetFileTypeToASCII()
    write_with(writer, mesh, path)


def write_base64_vtp(mesh: vtkPolyData, path: Path) -> None:
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToNone()
    write_with(writer, mesh, path)


def write_with(writer: vtkAlgorithm, mesh: vtkPolyData, path: Path) -> None:
    writer.SetInputData(mesh)
    writer.SetFileName(str(path))
    writer.Write()


def write_off(mesh: vtkPolyData, path: Path) -> None:
    with path.open("w") as file:
        file.write(f"OFF\n{mesh.GetNumberOfPoints()} {mesh.GetNumberOfPolys()} 0\n")
        np.savetxt(file, points_of(mesh), "%.9g")
        np.savetxt(file, corners_of(mesh), "3 %d %d %d")


def read_file(write: WriteMesh, suffix: str, triangles: float, scale: float) -> Task:
    folder = tempfile.TemporaryDirectory()
    path = Path(folder.name, f"mesh{suffix}")
    write(bumpy_torus(triangles * scale), path)

    def run() -> None:
        with folder:
            read_mesh(path)

    return Task(run, {"MEMORY_PER_BYTE": path.stat().st_size})


def format_case(suffix: str, kind: str, write: WriteMesh, triangles: float) -> Case:
    return Case("MEMORY_PER_BYTE", f"Wrapping/Python/spectralwatermark/io/{suffix[1:]}.py",
                "byte of the file", f"read {kind} {suffix[1:].upper()}",
                partial(read_file, write, suffix, triangles), is_least=True)


# --- The table ---------------------------------------------------------------------------------

ATTACK = "Filters/vtkMeshAttack.cxx"
RESAMPLING = "Filters/Private/Resampling.cxx"
HARMONICS = "Filters/Core/Harmonics/ManifoldHarmonics.cxx"
PLAN = "Filters/Core/RobustScheme/EmbeddingPlan.cxx"

CASES = (
    Case("conversionBytesPerPolygon", "Filters/Private/PolyDataMesh.cxx", "triangle",
         "convert", convert),
    Case("conversionBytesPerPolygon", "Filters/Private/PolyDataMesh.cxx", "triangle",
         "convert and rotate", rotate),
    Case("detectionBytesPerTriangle", "Filters/vtkSpectralWatermarkDetect.cxx", "triangle",
         "detect a robust mark", detect),
    Case("subdivisionBytesPerTriangle", ATTACK, "new triangle", "subdivide at midpoints",
         partial(subdivide, "Midpoint")),
    Case("subdivisionBytesPerTriangle", ATTACK, "new triangle", "subdivide by Loop's scheme",
         partial(subdivide, "Loop")),
    Case("subdivisionBytesPerTriangle", ATTACK, "new triangle", "subdivide by sqrt 3",
         partial(subdivide, "Sqrt3")),
    Case("smoothingBytesPerTriangle", ATTACK, "triangle", "smooth", smooth),
    Case("simplificationBytesPerTriangle", ATTACK, "triangle", "simplify", simplify),
    Case("comparisonBytesPerTriangle", "Filters/vtkMeshDistortion.cxx", "triangle",
         "compare two meshes", compare),
    Case("BytesPerPiece", RESAMPLING, "new piece", "remesh needles uniformly", split),
    Case("BytesPerCell", RESAMPLING, "grid cell", "remesh a sparse cube uniformly", cluster),
    Case("bytesPerNode", RESAMPLING, "grid node", "extract a sparse isosurface", fill_grid),
    Case("bytesPerSquare", RESAMPLING, "grid square", "extract a flat isosurface",
         extract_flat_isosurface),
    Case("factorBytesPerVertex", HARMONICS, "vertex", "compute few harmonics",
         partial(compute_harmonics, 3e5, 50)),
    Case("vectorBytesPerVertex", HARMONICS, "vertex, harmonic", "compute many harmonics",
         partial(compute_harmonics, 7e4, 400)),
    Case("bytesPerDenseEntry", HARMONICS, "matrix entry", "compute harmonics densely",
         compute_harmonics_densely),
    Case("basesAtPeak", HARMONICS, "byte of a basis", "adopt few harmonics",
         partial(adopt, 5e4, 100)),
    Case("basesAtPeak", HARMONICS, "byte of a basis", "adopt many harmonics",
         partial(adopt, 2e4, 400)),
    Case("patternsAtPeak", PLAN, "byte of patterns", "embed, default distortion",
         partial(embed, None)),
    Case("patternsAtPeak", PLAN, "byte of patterns", "embed, largest distortion",
         partial(embed, 100.0)),
    format_case(".ply", "binary", write_mesh, 1e6),
    format_case(".ply", "text", write_text_ply, 3e5),
    format_case(".obj", "text", write_mesh, 3e5),
    format_case(".stl", "binary", write_mesh, 1e6),
    format_case(".stl", "text", write_text_stl, 5e5),
    format_case(".vtp", "compressed", write_mesh, 1e6),
    format_case(".vtp", "base64", write_base64_vtp, 1e6),
    format_case(".off", "text", write_off, 3e5),
)


# --- Measuring ---------------------------------------------------------------------------------


def peak_memory() -> int:
    """Of this process since restart_peak(), in bytes."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(re.findall(r"^VmHWM:\s+(\d+) kB$", status, re.MULTILINE)[0])


def restart_peak() -> None:
    """Makes the present level the peak, after unused memory was given back to the system."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    Path("/proc/self/clear_refs").write_text("5")


def measure(case: Case, scale: float) -> float:
    if scale > SMALL:
        case.prepare(SMALL).run()
    task = case.prepare(scale)
    restart_peak()
    level = peak_memory()
    task.run()
    others = sum(constant(case.file, name) * number
                 for name, number in task.units.items() if name != case.constant)
    return (peak_memory() - level - others) / task.units[case.constant]


def measured(cases: Sequence[Case], scale: float) -> list[float]:
    """Of each case, all in one new process."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as process:
        return list(process.map(measure, cases, [scale] * len(cases)))


def print_table(cases: Sequence[Case], scale: float) -> None:
    form = "{:<33}{:<18}{:<31}{:>6}{:>10}{:>7}  {}"
    print(form.format("constant", "per", "task", "code", "measured", "ratio", ""))
    wrong = []
    file = ""
    for case in cases:
        if case.file != file:
            file = case.file
            print(file)
        value = constant(file, case.constant)
        (need,) = measured([case], scale)
        verdict = case.verdict(value, need)
        print(form.format(f"  {case.constant}", case.unit, case.task, f"{value:g}", f"{need:.2f}",
                          f"{need / value:.2f}", verdict), flush=True)
        if verdict:
            wrong.append(f"{file}: {case.constant} is {verdict}: {value:g} where {need:.2f} was "
                         f"measured ({case.task})")
    print("", *wrong or ["Every constant covers what was measured."], sep="\n")


def check(cases: Sequence[Case]) -> None:
    """Checks that the constants can be read and the tasks run. Small tasks measure nothing."""
    for case in cases:
        if constant(case.file, case.constant) <= 0.0:
            raise SystemExit(f"{case.file}: {case.constant} is not positive")
    measured(cases, SMALL)


def main() -> None:
    first, _, rest = __doc__.partition("\n")
    parser = argparse.ArgumentParser(description=first, epilog=rest,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD",
                        help="only the rows with one of these words in the file, constant or task")
    parser.add_argument("--scale", type=float, default=1.0, metavar="FACTOR",
                        help="multiplies what every task needs (default: 1)")
    parser.add_argument("--check", action="store_true",
                        help="only check that every constant is found and every task runs")
    arguments = parser.parse_args()
    cases = [case for case in CASES if case.is_named(arguments.only)]
    if not cases:
        parser.error(f"no row has a word of {arguments.only}")
    if arguments.check:
        check(cases)
    else:
        print_table(cases, arguments.scale)


if __name__ == "__main__":
    main()
