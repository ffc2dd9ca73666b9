# SPDX-License-Identifier: BSD-3-Clause
"""A page that shows what a mark is worth, to send along with a model: one HTML file, no others.

    from spectralwatermark import vtkSpectralWatermarkDetect
    from spectralwatermark.io import read_mesh
    from spectralwatermark.report import write_report

    def detector():
        detect = vtkSpectralWatermarkDetect()
        detect.SetSecretKeyFile("my.key")
        detect.UseDerivedMessageOn()
        return detect

    write_report(read_mesh("model.ply"), read_mesh("marked.ply"), "report.html", detector)

Importing this module needs a display: Debian's VTK draws through X, and a virtual one (xvfb-run) is
enough.
"""

from __future__ import annotations

import base64
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from html import escape
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
from . import charts, rendering
from .html import STYLE, Cell, Line, table
from ..io import write_file
from ..execution import FilterError, update

__all__ = ["write_report"]

HARMONICS = 100
SIDES = (("front", (0.0, 0.0, 1.0), (0.0, 1.0, 0.0)), ("right", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
         ("back", (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)), ("above", (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)))
IN_THE_CHART = ("noise, 0.5 %", "quantized to 8 bits", "simplification, 90 % of the edges")


@dataclass
class Reading:
    """What a copy reads."""

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

    detector() gives a detector that expects a message: derived from a secret, or given. The page does
    not hold the secret. run(algorithm, what) updates a filter. A file that is there already stays unless
    it is to be replaced. Raises FilterError and MeshFileError.
    """
    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, original)
    distortion.SetInputData(1, marked)
    run(distortion, "comparing")
    readings = _readings(original, marked, detector, run)
    spectra = [_harmonics_of(mesh, run) for mesh in (original, marked)]

    def write(partial: Path) -> None:
        # Beside the page: into that folder one can write, which is not sure of the system's for such files.
        with tempfile.TemporaryDirectory(prefix=".", dir=partial.parent) as name:
            folder = Path(name)
            _draw(folder, original, marked, distortion, readings, spectra)
            page = _page(folder, title, distortion, readings)
        partial.write_text(page, encoding="utf-8")

    write_file(path, write, replace)
    return readings


# --- Figures -------------------------------------------------------------------------------------


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
    if readings[0].carriers.GetColumnByName("Carrier") is not None:  # of the robust scheme
        charts.write_carriers(folder / "carriers.png", [
            (row.name, row.carriers) for row in readings
            if row in (readings[0], readings[-1]) or row.name in IN_THE_CHART])


# --- The page ------------------------------------------------------------------------------------


def _page(folder: Path, title: str, distortion: vtkMeshDistortion, readings: list[Reading]) -> str:
    first, last = readings[0], readings[-1]
    survived = sum(row.found for row in readings[1:-1])
    verdict = "carries the mark" if first.found else "does NOT carry the mark"
    body = [
        f"<h1>{escape(title)}</h1>",
        f'<p class="lead">The marked model {verdict}: {first.bits - first.wrong} of {first.bits} bits '
        f"agree, and chance would agree as well with a probability of {first.p_value:.1e}. The mark is "
        f"found after {survived} of {len(readings) - 2} attacks. In the unmarked original it is "
        f"{'found' if last.found else 'not found'} (p = {last.p_value:.2g}).</p>",
        "<h2>What one sees</h2>", _image(folder, "sides", "The original and the marked model"),
        "<h2>What was changed</h2>",
        table([["", ""]], _changes(distortion)),
        _image(folder, "distortion", "Distance of the marked surface from the original"),
        "<h2>What the mark survives</h2>", table(
            [["attack", "vertices", "wrong bits", "p-value", "verdict"]],
            [Line([escape(row.name), f"{row.vertices:,}", f"{row.wrong} of {row.bits}",
                   f"{row.p_value:.1e}", Cell("found" if row.found else "not found",
                                              "good" if row.found != (row is last) else "bad")])
             for row in readings]),
        "<p>The p-value is how likely a model that was never marked, or was marked under another key, "
        "agrees as well by chance.</p>",
        _image(folder, "carriers", "How firmly the carriers hold their bits"),
        "<h2>The spectrum</h2>", _image(folder, "spectrum", "Spectrum before and after"),
        "<p>The magnitudes of the first manifold harmonics: the waves that belong to this shape.</p>",
    ]
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>'
            f'\n<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head>\n<body>\n'
            + "\n".join(body) + "\n</body></html>\n")


def _changes(distortion: vtkMeshDistortion) -> list[Line]:
    return [
        Line(["Root mean square distance between the surfaces (MRMS)",
              f"{100.0 * distortion.GetMRMS():.4f} % of the diagonal"]),
        Line(["Largest distance (Hausdorff)", f"{100.0 * distortion.GetHausdorff():.4f} %"]),
        Line(["Visible distortion (MSDM2; 0: none, 1: everything)", f"{distortion.GetMSDM2():.3f}"]),
    ]


def _image(folder: Path, name: str, text: str) -> str:
    file = folder / f"{name}.png"
    if not file.exists():
        return ""
    data = base64.b64encode(file.read_bytes()).decode("ascii")
    return f'<figure><img alt="{escape(text)}" src="data:image/png;base64,{data}"></figure>'
