# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures, drawn from our meshes. Pictures of meshes need a display, charts do not.

Each function that draws runs in a worker. Like all tasks it returns a list: here, of one dictionary
with the numbers of the caption.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.ticker import MaxNLocator
from spectralwatermark import (
    vtkManifoldHarmonicsReconstruction,
    vtkManifoldHarmonicsSimilarity,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.execution import update
from spectralwatermark.io import read_mesh
from spectralwatermark.report import charts, rendering
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkStaticPointLocator
from vtkmodules.vtkRenderingCore import vtkCamera

from . import experiments
from .experiments import ATTACK, MODE, Mode
from .models import ORIENTATIONS, UPRIGHT, Model
from .roc import Curve
from .spectra import harmonics_of, magnitudes_of, original_of

NAMES = {
    "2": "figure-02-harmonics.png",
    "3": "figure-03-similarity.png",
    "4": "figure-04-spectrum.png",
    "5": "figure-05-doubled.png",
    "6": "figure-06-difference.png",
    "7": "figure-07-doubled.png",
    "8": "figure-08-evolution.png",
    "9": "figure-09-normal-aggressive.png",
    "10": "figure-10-normal-nonaggressive.png",
    "11": "figure-11-narrow-aggressive.png",
    "12": "figure-12-narrow-nonaggressive.png",
    "13": "figure-13-simplified.png",
    "14": "figure-14-noise.png",
    "15": "figure-15-noise.png",
    "16": "figure-16-smoothed.png",
    "roc": "roc.png",
    "roc-log": "roc-low-rates.png",
}
SHOWN_HARMONICS = (6, 17, 26)  # the paper's Figure 2
FIGURE_HARMONICS = 100
COMPONENT = 50  # doubled in Figures 3 to 7, watched in Figure 8
COARSER_PERCENT = 66.4  # removed: the paper's Kittens have 268,000 and 90,000 triangles
MESSAGE = "10110"
MOST_ATTEMPTS = 4  # number of messages to try before a picture shows a mark without convergence
SMALL_PANEL, LARGE_PANEL = 420, 560  # pixels


def draw(
    function: Callable[..., list[dict]], folder: Path, files: Sequence[str], arguments: tuple
) -> list[dict]:
    """Calls one of the functions below and adds digests of its pictures to its numbers.

    Another run may draw the same figure from another mesh into the same folder.
    """
    (facts,) = function(folder, *arguments)
    return [facts | {"pictures": {name: _digest(folder / name) for name in files}}]


def are_drawn(folder: Path, record: dict | None) -> bool:
    """Whether the pictures in the folder are those of this record."""
    return record is not None and all(
        (folder / name).is_file() and _digest(folder / name) == digest
        for name, digest in record["pictures"].items())


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def vertices_of(mesh: vtkPolyData) -> str:
    return f"{mesh.GetNumberOfPoints():,} vertices"


# --- Figure 2 ----------------------------------------------------------------------------------


def draw_harmonics(folder: Path, model: Model) -> list[dict]:
    """A few harmonics at two resolutions, with their similarity."""
    fine = harmonics_of(read_mesh(model.path), FIGURE_HARMONICS)
    simplify = vtkMeshAttack()
    simplify.SetInputData(fine)
    simplify.SetAttackToSimplification()
    simplify.SetSimplificationPercent(COARSER_PERCENT)
    update(simplify)
    coarse = harmonics_of(simplify.GetOutput(), FIGURE_HARMONICS)
    similarity = similarities(fine, coarse)
    panels = []
    for mesh, size in ((fine, "fine"), (coarse, "coarse")):
        for number in SHOWN_HARMONICS:
            caption = f"harmonic {number}\n{vertices_of(mesh)}"
            if size == "coarse":
                _match_sign(fine, coarse, number)
                caption += f", similarity {similarity[number - 1]:.3f}"
            limit = 0.8 * np.abs(_harmonic(fine, number)).max()
            panels.append(rendering.Panel(mesh, caption, "ManifoldHarmonics", number - 1,
                                          rendering.diverging(limit)))
    rendering.write_panels(folder / NAMES["2"], panels, columns=len(SHOWN_HARMONICS),
                           size=SMALL_PANEL, camera=_camera(model, fine))
    return [{"vertices": [fine.GetNumberOfPoints(), coarse.GetNumberOfPoints()],
             "triangles": [fine.GetNumberOfPolys(), coarse.GetNumberOfPolys()],
             "similarity": similarity.tolist()}]


def similarities(reference: vtkPolyData, other: vtkPolyData) -> np.ndarray:
    """The similarity by equation 8 of each component."""
    similarity = vtkManifoldHarmonicsSimilarity()
    similarity.SetInputData(0, reference)
    similarity.SetInputData(1, other)
    update(similarity)
    return vtk_to_numpy(similarity.GetOutput().GetFieldData().GetArray("Similarity")).copy()


def _camera(model: Model, mesh: vtkPolyData) -> vtkCamera:
    return rendering.view_of(mesh, *ORIENTATIONS.get(model.name, UPRIGHT))


def _harmonic(mesh: vtkPolyData, number: int) -> np.ndarray:
    """A view of the mesh's array: writing to it changes the mesh."""
    return vtk_to_numpy(mesh.GetPointData().GetArray("ManifoldHarmonics"))[:, number - 1]


def _match_sign(fine: vtkPolyData, coarse: vtkPolyData, number: int) -> None:
    """Gives the coarse mesh's harmonic the sign of the fine mesh's, since the sign is arbitrary."""
    locator = vtkStaticPointLocator()
    locator.SetDataSet(fine)
    locator.BuildLocator()
    step = max(1, coarse.GetNumberOfPoints() // 2000)
    sampled = range(0, coarse.GetNumberOfPoints(), step)
    closest = [locator.FindClosestPoint(coarse.GetPoint(i)) for i in sampled]
    if np.dot(_harmonic(fine, number)[closest], _harmonic(coarse, number)[list(sampled)]) < 0.0:
        _harmonic(coarse, number)[:] *= -1.0


# --- Figures 3 to 7 ----------------------------------------------------------------------------


def draw_doubling(
    folder: Path, model: Model, similarity_file: str, spectrum_file: str, panels_file: str
) -> list[dict]:
    """Doubles one component and draws the change of the spectrum (Figures 4 and 6) and of the shape
    (5 and 7). With a file for the similarity it draws that too (3), and both spectra instead of
    their difference.
    """
    original = harmonics_of(read_mesh(model.path), FIGURE_HARMONICS)
    doubling = vtkManifoldHarmonicsReconstruction()
    doubling.SetInputData(original)
    doubling.SetGain(COMPONENT, 2.0)
    doubling.KeepResidualOn()
    update(doubling)
    changed = harmonics_of(doubling.GetOutput(), FIGURE_HARMONICS)
    similarity = similarities(original, changed)
    before, after = magnitudes_of(original), magnitudes_of(changed)
    if similarity_file:
        _draw_similarity(folder / similarity_file, similarity)
        _draw_spectra(folder / spectrum_file, before, after)
    else:
        _draw_difference(folder / spectrum_file, after - before)
    facts = _draw_change(folder / panels_file, model, original, changed,
                         f"component {COMPONENT} doubled")
    return [facts | {"similarity": similarity.tolist(), "before": before.tolist(),
                     "after": after.tolist()}]


def _draw_similarity(path: Path, similarity: np.ndarray) -> None:
    with charts.chart(path, f"Harmonics before and after component {COMPONENT} was doubled",
                      "component", "similarity (equation 8)") as axes:
        axes.plot(np.arange(1, len(similarity) + 1), similarity, color="steelblue")


def _draw_spectra(path: Path, before: np.ndarray, after: np.ndarray) -> None:
    component = np.arange(2, len(before) + 1)  # the first is the position
    with charts.chart(path, f"Spectrum before and after component {COMPONENT} was doubled",
                      "component", "magnitude") as axes:
        axes.set_yscale("log")
        axes.plot(component, before[1:], color="steelblue", label="original")
        axes.plot(component, after[1:], color="darkorange", label="modified")
        axes.plot(COMPONENT, after[COMPONENT - 1], "o", color="firebrick",
                  label=f"c{COMPONENT}, modified")


def _draw_difference(path: Path, difference: np.ndarray) -> None:
    component = np.arange(2, len(difference) + 1)
    with charts.chart(path, f"Difference of the spectra after component {COMPONENT} was doubled",
                      "component", "difference of magnitudes") as axes:
        axes.plot(component, difference[1:], color="steelblue", label="modified − original")
        axes.plot(COMPONENT, difference[COMPONENT - 1], "o", color="firebrick",
                  label=f"component {COMPONENT}")


def _draw_change(
    path: Path, model: Model, original: vtkPolyData, changed: vtkPolyData, what: str
) -> dict:
    """Original, changed, and both differences in colour."""
    distortion = vtkMeshDistortion()
    distortion.ComputeSurfaceDistancesOff()
    distortion.ComputePerceptualDistancesOff()
    distortion.SetInputData(0, original)
    distortion.SetInputData(1, changed)
    update(distortion)
    coloured = distortion.GetOutput()
    panels = [rendering.Panel(original, f"original\n{vertices_of(original)}"),
              rendering.Panel(changed, what)]
    for array, title in (("GeometricDifference", "geometric distortion"),
                         ("CurvatureDifference", "curvature distortion")):
        values = vtk_to_numpy(coloured.GetPointData().GetArray(array))  # a view
        values *= 100.0
        # A few vertices have far larger values, so the scale ends at the 99th percentile.
        limit = float(np.percentile(values, 99.0)) or 1.0
        panels.append(rendering.Panel(coloured, title, array, 0, rendering.heat(limit),
                                      "percent of the bounding-box diagonal"))
    rendering.write_panels(path, panels, columns=2, size=LARGE_PANEL,
                           camera=_camera(model, original))
    return {"vertices": original.GetNumberOfPoints(),
            "geometric": 100.0 * distortion.GetGeomDiff(),
            "curvature": 100.0 * distortion.GetCurvDiff()}


# --- Figure 8 ----------------------------------------------------------------------------------


def draw_evolution(folder: Path, candidates: Sequence[Model]) -> list[dict]:
    """c50 and the average of its slot, components 45 to 54, while a 1 is embedded."""
    best: dict | None = None
    tried = []
    for model in candidates:
        for turbulence in (1.0, 0.5):
            facts = _evolution(model, turbulence)
            tried.append([model.name, turbulence, facts["iterations"]])
            longer = best is None or facts["iterations"] > best["iterations"]
            if facts["converged"] and longer:
                best = facts
        if best is not None and best["iterations"] >= 3:
            break  # "not achieved in one iteration"
    best = best or facts
    with charts.chart(folder / NAMES["8"],
                      f"Component {COMPONENT} and its slot's average over the iterations",
                      "iteration", "magnitude") as axes:
        axes.plot(best["carrier"], color="firebrick", label=f"c{COMPONENT}")
        axes.plot(best["average"], color="steelblue", label="average of its slot")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    return [best | {"tried": tried}]


def _evolution(model: Model, turbulence: float) -> dict:
    mesh, _ = original_of(model)
    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(mesh)
    embed.SetSchemeToPaperSlots()
    embed.SetMessage("1")
    embed.SetFirstComponent(COMPONENT - 5)
    embed.SetCarrierPosition(6)
    embed.SetTurbulenceFactor(turbulence)
    update(embed)
    history = embed.GetOutputDataObject(1)
    return {"model": model.name, "turbulence": turbulence,
            "vertices": mesh.GetNumberOfPoints(),
            "converged": bool(embed.GetConverged()),
            "iterations": embed.GetNumberOfIterationsUsed()} | {
        key: vtk_to_numpy(history.GetColumnByName(column)).tolist()
        for key, column in (("carrier", "Magnitude"), ("average", "Average"))}


# --- Figures 9 to 16 ---------------------------------------------------------------------------


def draw_mark(folder: Path, model: Model, mode_key: str, file: str) -> list[dict]:
    """A model before and after it was marked."""
    mode = MODE[mode_key]
    embed, facts = _mark(model, mode)
    return [facts | _draw_change(folder / file, model, original_of(model)[0], embed.GetOutput(),
                                 f"marked with {facts['message']}")]


def _mark(model: Model, mode: Mode) -> tuple[vtkSpectralWatermarkEmbed, dict]:
    """Marks with the usual message or, if that does not converge, with one that does."""
    others = [message for message in experiments.messages(8) if message != MESSAGE]
    failed = []
    for message in [MESSAGE, *others][:MOST_ATTEMPTS]:
        embed, first = experiments.embed(model, mode, message)
        if embed.GetConverged():
            break
        failed.append(message)
    return embed, {"message": message, "converged": bool(embed.GetConverged()), "failed": failed,
                   "iterations": embed.GetNumberOfIterationsUsed(), "first": first,
                   "read": embed.GetExtractedMessage()}


def draw_attack(
    folder: Path, model: Model, mode_key: str, attack_keys: Sequence[str], file: str
) -> list[dict]:
    """A model, marked and attacked, with the bits that are read from it."""
    mode = MODE[mode_key]
    original, _ = original_of(model)
    embed, facts = _mark(model, mode)
    marked = embed.GetOutput()
    message = facts["message"]
    panels = [rendering.Panel(original, f"original\n{vertices_of(original)}"),
              rendering.Panel(marked, f"marked with {message}\nreads {facts['read']}")]
    readings = []
    smoothed = any(key.startswith("smooth") for key in attack_keys)
    victim = harmonics_of(marked, experiments.smoothing_harmonics(marked)) if smoothed else marked
    for key in attack_keys:
        attack = ATTACK[key]
        mesh = experiments.attacked(victim, attack, seed=1 + int(message, 2))
        reading = experiments.read(mesh, mode, facts["first"], message)
        readings.append({"title": attack.title} | reading)
        panels.append(rendering.Panel(mesh, f"{attack.title}\nreads {reading['read']}, "
                                            f"{reading['errors']} wrong"))
    rendering.write_panels(folder / file, panels, columns=3 if len(panels) == 3 else 2,
                           size=LARGE_PANEL if len(panels) == 4 else 480,
                           camera=_camera(model, original))
    return [facts | {"readings": readings, "vertices": original.GetNumberOfPoints()}]


# --- ROC ---------------------------------------------------------------------------------------

ROC_COLOURS = {("Normal", "hard"): "steelblue", ("Normal", "soft"): "darkorange",
               ("Narrow", "hard"): "seagreen", ("Narrow", "soft"): "firebrick"}
ROC_LABELS = {"hard": "bits that agree (eq. 12)", "soft": "likelihood ratio"}
LOWEST_RATE = 1e-3


def draw_roc(folder: Path, curves: dict[tuple[str, str], Curve]) -> None:
    """Draws a curve for each division and detector, with linear and with logarithmic axis."""
    for name, scale in (("roc", "linear"), ("roc-log", "log")):
        with charts.chart(folder / NAMES[name], "ROC: marked meshes found against unmarked ones mistaken",
                          "false positives, share of unmarked meshes",
                          "true positives, share of marked meshes") as axes:
            axes.set_xscale(scale)
            for (division, detector), curve in curves.items():
                x, y = curve.false_positives, curve.true_positives
                if scale == "log":
                    x, y = x[x >= LOWEST_RATE], y[x >= LOWEST_RATE]
                axes.plot(x, y, color=ROC_COLOURS[division, detector],
                          label=f"{division} slots, {ROC_LABELS[detector]}")
            chance = np.geomspace(LOWEST_RATE, 1.0, 60)
            axes.plot(chance, chance, color="silver", label="guessing")
