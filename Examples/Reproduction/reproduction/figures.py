# SPDX-License-Identifier: BSD-3-Clause
"""The paper's figures, drawn from our meshes. Importing this module needs a display.

Each function that draws runs in a worker and returns, in a list as all tasks do, the numbers that
the caption gives.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from spectralwatermark import (
    pictures,
    vtkManifoldHarmonicsReconstruction,
    vtkManifoldHarmonicsSimilarity,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.io import read_mesh
from spectralwatermark.execution import update
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
MOST_ATTEMPTS = 4  # messages tried before a picture shows a mark that did not converge
SMALL_PANEL, LARGE_PANEL = 420, 560  # pixels


def draw(
    function: Callable[..., list[dict]], folder: Path, files: Sequence[str], arguments: tuple
) -> list[dict]:
    """Calls one of the functions below and adds to its numbers which pictures belong to them:
    another run may draw the same figure from another mesh into the same folder."""
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
    """A few harmonics at two resolutions, with how similar they are."""
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
            panels.append(pictures.Panel(mesh, caption, "ManifoldHarmonics", number - 1,
                                         pictures.diverging(limit)))
    pictures.write_panels(folder / NAMES["2"], panels, columns=len(SHOWN_HARMONICS),
                          size=SMALL_PANEL, camera=_camera(model, fine))
    return [{"vertices": [fine.GetNumberOfPoints(), coarse.GetNumberOfPoints()],
             "triangles": [fine.GetNumberOfPolys(), coarse.GetNumberOfPolys()],
             "similarity": similarity.tolist()}]


def similarities(reference: vtkPolyData, other: vtkPolyData) -> np.ndarray:
    """Eq. 8 for each component."""
    similarity = vtkManifoldHarmonicsSimilarity()
    similarity.SetInputData(0, reference)
    similarity.SetInputData(1, other)
    update(similarity)
    return vtk_to_numpy(similarity.GetOutput().GetFieldData().GetArray("Similarity")).copy()


def _camera(model: Model, mesh: vtkPolyData) -> vtkCamera:
    return pictures.view_of(mesh, *ORIENTATIONS.get(model.name, UPRIGHT))


def _harmonic(mesh: vtkPolyData, number: int) -> np.ndarray:
    """A view: changing it changes the mesh."""
    return vtk_to_numpy(mesh.GetPointData().GetArray("ManifoldHarmonics"))[:, number - 1]


def _match_sign(fine: vtkPolyData, coarse: vtkPolyData, number: int) -> None:
    """A harmonic's sign is free; show that of the fine mesh."""
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
    """What doubling one component does: to the harmonics (Figure 3, if a file is named), to the
    spectrum (4, or 6: the difference), and to the shape (5, 7)."""
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
    table = pictures.table_of(component=np.arange(1, len(similarity) + 1), similarity=similarity)
    pictures.write_chart(
        path, [pictures.Curve(table, "component", "similarity", "similarity", "SteelBlue")],
        f"Harmonics before and after component {COMPONENT} was doubled",
        ("component", "similarity (equation 8)"))


def _draw_spectra(path: Path, before: np.ndarray, after: np.ndarray) -> None:
    component = np.arange(2, len(before) + 1)  # the first is the position
    table = pictures.table_of(component=component, before=before[1:], after=after[1:])
    doubled = pictures.table_of(component=[COMPONENT], after=[after[COMPONENT - 1]])
    pictures.write_chart(
        path,
        [pictures.Curve(table, "component", "before", "original", "SteelBlue"),
         pictures.Curve(table, "component", "after", "modified", "DarkOrange"),
         pictures.Curve(doubled, "component", "after", f"c{COMPONENT}, modified", "Firebrick",
                        markers_only=True)],
        f"Spectrum before and after component {COMPONENT} was doubled",
        ("component", "magnitude (logarithmic scale)"), logarithmic=True)


def _draw_difference(path: Path, difference: np.ndarray) -> None:
    component = np.arange(2, len(difference) + 1)
    table = pictures.table_of(component=component, difference=difference[1:])
    doubled = pictures.table_of(component=[COMPONENT], difference=[difference[COMPONENT - 1]])
    pictures.write_chart(
        path,
        [pictures.Curve(table, "component", "difference", "modified - original", "SteelBlue"),
         pictures.Curve(doubled, "component", "difference", f"component {COMPONENT}",
                        "Firebrick", markers_only=True)],
        f"Difference of the spectra after component {COMPONENT} was doubled",
        ("component", "difference of magnitudes"))


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
    panels = [pictures.Panel(original, f"original\n{vertices_of(original)}"),
              pictures.Panel(changed, what)]
    for array, title in (("GeometricDifference", "geometric distortion"),
                         ("CurvatureDifference", "curvature distortion")):
        values = vtk_to_numpy(coloured.GetPointData().GetArray(array))  # a view
        values *= 100.0
        # A few vertices stick out far: the scale ends where 99 % of them are below.
        limit = float(np.percentile(values, 99.0)) or 1.0
        panels.append(pictures.Panel(coloured, title, array, 0, pictures.heat(limit),
                                     "percent of the bounding-box diagonal"))
    pictures.write_panels(path, panels, columns=2, size=LARGE_PANEL,
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
    table = pictures.table_of(iteration=range(len(best["carrier"])), carrier=best["carrier"],
                              average=best["average"])
    pictures.write_chart(
        folder / NAMES["8"],
        [pictures.Curve(table, "iteration", "carrier", f"c{COMPONENT}", "Firebrick"),
         pictures.Curve(table, "iteration", "average", "average of its slot", "SteelBlue")],
        f"Component {COMPONENT} and its slot's average over the iterations",
        ("iteration", "magnitude"), whole_numbers=True)
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
    """With the usual message or, when it does not converge, with one that does."""
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
    """A model, marked, and attacked, with the bits that are read from it."""
    mode = MODE[mode_key]
    original, _ = original_of(model)
    embed, facts = _mark(model, mode)
    marked = embed.GetOutput()
    message = facts["message"]
    panels = [pictures.Panel(original, f"original\n{vertices_of(original)}"),
              pictures.Panel(marked, f"marked with {message}\nreads {facts['read']}")]
    readings = []
    smoothed = any(key.startswith("smooth") for key in attack_keys)
    victim = harmonics_of(marked, experiments.smoothing_harmonics(marked)) if smoothed else marked
    for key in attack_keys:
        attack = ATTACK[key]
        mesh = experiments.attacked(victim, attack, seed=1 + int(message, 2))
        reading = experiments.read(mesh, mode, facts["first"], message)
        readings.append({"title": attack.title} | reading)
        panels.append(pictures.Panel(mesh, f"{attack.title}\nreads {reading['read']}, "
                                           f"{reading['errors']} wrong"))
    pictures.write_panels(folder / file, panels, columns=3 if len(panels) == 3 else 2,
                          size=LARGE_PANEL if len(panels) == 4 else 480,
                          camera=_camera(model, original))
    return [facts | {"readings": readings, "vertices": original.GetNumberOfPoints()}]


# --- ROC ---------------------------------------------------------------------------------------

ROC_COLOURS = {("Normal", "hard"): "SteelBlue", ("Normal", "soft"): "DarkOrange",
               ("Narrow", "hard"): "SeaGreen", ("Narrow", "soft"): "Firebrick"}
ROC_LABELS = {"hard": "bits that agree (eq. 12)", "soft": "likelihood ratio"}
LOWEST_RATE = 1e-3


def draw_roc(folder: Path, curves: dict[tuple[str, str], Curve]) -> None:
    """By division and detector: once over all rates, once with the low rates spread out."""
    for name, logarithmic in (("roc", False), ("roc-log", True)):
        lines = []
        for (division, detector), curve in curves.items():
            x, y = curve.false_positives, curve.true_positives
            if logarithmic:
                x, y = x[x >= LOWEST_RATE], y[x >= LOWEST_RATE]
            lines.append(pictures.Curve(
                pictures.table_of(x=x, y=y), "x", "y", f"{division} slots, {ROC_LABELS[detector]}",
                ROC_COLOURS[division, detector]))
        chance = np.geomspace(LOWEST_RATE, 1.0, 60)
        lines.append(pictures.Curve(pictures.table_of(x=chance, y=chance), "x", "y", "a coin", "Silver"))
        pictures.write_chart(
            folder / NAMES[name], lines, "Marked meshes found, against unmarked ones mistaken",
            ("false positives, share of unmarked meshes" +
             (" (logarithmic scale)" if logarithmic else ""), "true positives"),
            logarithmic_x=logarithmic)

