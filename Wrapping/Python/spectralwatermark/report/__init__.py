# SPDX-License-Identifier: BSD-3-Clause
"""A report on a marked model for its recipient: one HTML file that needs no others.

    from spectralwatermark import vtkSpectralWatermarkDetect
    from spectralwatermark.io import read_mesh
    from spectralwatermark.report import write_report

    def detector():
        detect = vtkSpectralWatermarkDetect()
        detect.SetSecretKeyFile("my.key")
        detect.UseDerivedMessageOn()
        return detect

    write_report(read_mesh("model.ply"), read_mesh("marked.ply"), "report.html", detector)

Importing this module needs Jinja2 and matplotlib. Drawing the meshes needs a display: Debian's VTK draws
through X, and a virtual display (xvfb-run) is enough.
"""

from __future__ import annotations

import base64
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .. import (
    vtkManifoldHarmonics,
    vtkMeshDistortion,
    vtkSpectralWatermarkDetect,
)
from ..attacks import attacks_on
from ..execution import FilterError, update
from ..io import write_file

try:
    from . import charts, pages, rendering
except ModuleNotFoundError as error:
    if error.name not in ("jinja2", "matplotlib"):
        raise
    raise ModuleNotFoundError(f"reports need the Python module {error.name} (Debian: apt install "
                              f"python3-{error.name})", name=error.name) from None

__all__ = ["write_report"]

HARMONICS = 100
SIDES = (("front", (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)), ("right", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
         ("back", (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)), ("above", (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)))
IN_THE_CHART = ("noise, 0.5 %", "quantized to 8 bits", "simplification, 90 % of the edges")


@dataclass
class Reading:
    """What the detector reads from one copy."""

    name: str
    vertices: int
    bits: int
    wrong: int
    p_value: float
    found: bool
    carriers: vtkTable


def write_report(
    original: vtkPolyData,
    marked: vtkPolyData,
    path: str | os.PathLike,
    detector: Callable[[], vtkSpectralWatermarkDetect],
    title: str = "A protected model",
    run: Callable[[vtkAlgorithm, str], object] = lambda algorithm, what: update(algorithm),
    replace: bool = True,
) -> list[Reading]:
    """Attacks the marked mesh, reads every copy and writes the page, whole or not at all.

    detector() gives a detector that expects a message: one derived from a secret, or a given one. The page
    does not contain the secret. run(algorithm, what) updates a filter. An existing file is only overwritten if
    replace is true. Raises FilterError and MeshFileError.
    """
    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, original)
    distortion.SetInputData(1, marked)
    run(distortion, "comparing")
    readings = _readings(original, marked, detector, run)
    spectra = [_harmonics_of(mesh, run) for mesh in (original, marked)]

    def write(partial: Path) -> None:
        # In the page's folder, which is writable; the system's folder for temporary files may not be.
        with tempfile.TemporaryDirectory(prefix=".", dir=partial.parent) as name:
            folder = Path(name)
            _draw(folder, original, marked, distortion, readings, spectra)
            page = _page(folder, title, distortion, readings)
        partial.write_text(page, encoding="utf-8")

    write_file(path, write, replace)
    return readings


# --- Readings ------------------------------------------------------------------------------------


def _readings(original, marked, detector, run) -> list[Reading]:
    readings = [_read("the marked model", marked, detector, run)]
    for name, attack in attacks_on(marked):
        if attack is not None:
            run(attack, name)
            readings.append(_read(name, attack.GetOutput(), detector, run))
    readings.append(_read("the unmarked original", original, detector, run))
    return readings


def _read(name: str, mesh: vtkPolyData, detector, run) -> Reading:
    detect = detector()
    detect.SetInputData(mesh)
    run(detect, f"reading: {name}")
    if detect.GetBitErrorRate() < 0.0:
        raise FilterError("the report needs a message to look for: set a secret key and "
                          "UseDerivedMessage, or ExpectedMessage")
    bits = len(detect.GetExtractedMessage())
    return Reading(name, mesh.GetNumberOfPoints(), bits, round(bits * detect.GetBitErrorRate()),
                   detect.GetPValue(), bool(detect.GetDetected()), detect.GetOutputDataObject(1))


def _harmonics_of(mesh: vtkPolyData, run) -> vtkTable:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(min(HARMONICS, mesh.GetNumberOfPoints() // 2))
    run(harmonics, "harmonics")
    return harmonics.GetOutputDataObject(1)


# --- Pictures ------------------------------------------------------------------------------------


def _draw(folder: Path, original, marked, distortion, readings, spectra) -> None:
    rendering.write_panels(
        folder / "sides.png",
        [rendering.Panel(mesh, f"{what}, {side}") for mesh, what in ((original, "original"),
                                                                   (marked, "marked"))
         for side, _, _ in SIDES],
        columns=4, size=420,
        cameras=[rendering.view_of(mesh, front, up) for mesh in (original, marked)
                 for _, front, up in SIDES])
    percent = vtkPolyData()
    percent.DeepCopy(distortion.GetOutput())
    values = vtk_to_numpy(percent.GetPointData().GetArray("SurfaceDistance"))  # a view
    values *= 100.0
    colours = rendering.heat(max(float(values.max()), 1e-12))
    rendering.write_panels(
        folder / "distortion.png",
        [rendering.Panel(percent, side, "SurfaceDistance", 0, colours, "percent of the diagonal")
         for side, _, _ in (SIDES[0], SIDES[2])],
        columns=2, size=620,
        cameras=[rendering.view_of(percent, front, up) for _, front, up in (SIDES[0], SIDES[2])])
    charts.write_spectra(folder / "spectrum.png", *spectra)
    if readings[0].carriers.GetColumnByName("Carrier") is not None:  # only the robust scheme has carriers
        charts.write_carriers(folder / "carriers.png", [
            (row.name, row.carriers) for row in readings
            if row in (readings[0], readings[-1]) or row.name in IN_THE_CHART])


# --- The page ------------------------------------------------------------------------------------


def _page(folder: Path, title: str, distortion: vtkMeshDistortion, readings: list[Reading]) -> str:
    marked, *attacked, original = readings
    pictures = {file.stem: base64.b64encode(file.read_bytes()).decode("ascii") for file in folder.glob("*.png")}
    return pages.templates_of().get_template("report.html.j2").render(
        title=title, distortion=distortion, marked=marked, attacked=attacked, original=original,
        survived=sum(row.found for row in attacked), pictures=pictures)
