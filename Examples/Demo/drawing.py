# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of the demonstration. Charts need no display, meshes need one, real or virtual."""

from __future__ import annotations

from math import pi

from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.report import charts, rendering
from steps import Demo, update
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkCamera

SHOWN_HARMONICS = (2, 6, 17, 26, 50, 100)
SHOWN_CARRIERS = ("none", "noise, 0.5 %", "quantized to 8 bits", "simplification, 90 % of the edges",
                  "unmarked original")


def harmonics_of(demo: Demo) -> tuple[vtkManifoldHarmonics, vtkManifoldHarmonics]:
    """The first 100 harmonics of the original and of the marked mesh."""
    return _harmonics_of(demo.original, "original"), _harmonics_of(demo.marked, "marked mesh")


def _harmonics_of(mesh: vtkPolyData, name: str) -> vtkManifoldHarmonics:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(min(100, mesh.GetNumberOfPoints()))
    update(harmonics, f"100 harmonics of the {name}")
    return harmonics


def draw_charts(demo: Demo, original: vtkManifoldHarmonics, marked: vtkManifoldHarmonics) -> None:
    """The two spectra, and how firmly the carriers hold their bits in some of the copies."""
    charts.write_spectra(demo.output / "spectrum.png", original.GetOutputDataObject(1),
                         marked.GetOutputDataObject(1))
    charts.write_carriers(demo.output / "carriers.png", [
        (row.name, row.carriers) for name in SHOWN_CARRIERS for row in demo.attacks if row.name == name])


def draw_meshes(demo: Demo, original: vtkPolyData) -> None:
    """All pictures of meshes; `original` carries its harmonics."""
    camera = rendering.view_of(demo.original)
    _draw_comparison(demo, camera)
    _draw_harmonics(demo, original, camera)
    _draw_attacks(demo)


def _draw_comparison(demo: Demo, camera: vtkCamera) -> None:
    """The original, the marked mesh, and the displacement of each point."""
    percent = _scaled_copy(demo.embed.GetOutput(), "GeometricDistortion", 100.0)
    limit = percent.GetPointData().GetArray("GeometricDistortion").GetRange()[1]
    rendering.write_panels(
        demo.output / "comparison.png",
        [
            rendering.Panel(demo.original, "original"),
            rendering.Panel(demo.marked, f"marked with {demo.bits} bits"),
            rendering.Panel(percent, "displacement", "GeometricDistortion", 0,
                            rendering.heat(limit), "percent of the bounding-box diagonal"),
        ],
        columns=3, size=560, camera=camera)


def _draw_harmonics(demo: Demo, original: vtkPolyData, camera: vtkCamera) -> None:
    """Some of the harmonics, as in the paper's Figure 2."""
    basis = original.GetPointData().GetArray("ManifoldHarmonics")
    eigenvalues = original.GetFieldData().GetArray("Eigenvalues")
    panels = []
    for number in SHOWN_HARMONICS:
        if number > basis.GetNumberOfComponents():
            continue
        limit = 0.8 * max(abs(value) for value in basis.GetRange(number - 1))
        wavelength = 100.0 * 2.0 * pi / eigenvalues.GetValue(number - 1) ** 0.5
        panels.append(rendering.Panel(
            original, f"harmonic {number}\n"
            f"wavelength {wavelength / demo.original.GetLength():.0f} % of the diagonal",
            "ManifoldHarmonics", number - 1, rendering.diverging(limit)))
    rendering.write_panels(demo.output / "harmonics.png", panels, columns=3, size=480, camera=camera)


def _draw_attacks(demo: Demo) -> None:
    """The attacked meshes, each with what the detector reads from it."""
    shown = [row for row in demo.attacks[1:-2] if row.name != "vertices shuffled"]
    panels = [rendering.Panel(row.mesh, f"{row.name}\n{row.errors} wrong bits, p = {row.p_value:.0e}")
              for row in shown]
    rendering.write_panels(demo.output / "attacks.png", panels, columns=4, size=420)


def _scaled_copy(mesh: vtkPolyData, array_name: str, factor: float) -> vtkPolyData:
    copy = vtkPolyData()
    copy.DeepCopy(mesh)
    values = vtk_to_numpy(copy.GetPointData().GetArray(array_name))  # a view
    values *= factor
    return copy
