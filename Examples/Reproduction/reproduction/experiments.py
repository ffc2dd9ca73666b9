# SPDX-License-Identifier: BSD-3-Clause
"""Marks, attacks and reads meshes, for Tables 1 to 4 and section 3.3."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from spectralwatermark import (
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkAlgorithm,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.execution import FilterError, update
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .models import Model
from .spectra import BITS, SLOT_SIZE, harmonics_of, magnitudes_of, original_of

SEED = 2008
SMOOTHING_HARMONICS = 300


@dataclass(frozen=True)
class Mode:
    """A way to divide the spectrum and to embed a bit."""

    key: str
    title: str
    table: int  # of the paper
    division: int
    embedding: int


MODES = (
    Mode("normal-aggressive", "Normal slots, aggressive", 1, 0, 0),
    Mode("normal-nonaggressive", "Normal slots, non-aggressive", 2, 0, 1),
    Mode("narrow-aggressive", "Narrow slots, aggressive", 3, 1, 0),
    Mode("narrow-nonaggressive", "Narrow slots, non-aggressive", 4, 1, 1),
)
MODE = {mode.key: mode for mode in MODES}


@dataclass(frozen=True)
class Attack:
    """One attack at one strength."""

    key: str
    family: str
    title: str
    kind: int
    properties: tuple[tuple[str, object], ...] = ()


def _attacks() -> list[Attack]:
    attacks = [
        Attack("rotation", "Affine", "rotation by 100° about (1, 2, 3)", vtkMeshAttack.Rotation,
               (("RotationAxis", (1.0, 2.0, 3.0)), ("RotationAngle", 100.0))),
        Attack("scaling", "Affine", "scaling by 3", vtkMeshAttack.UniformScaling,
               (("ScaleFactor", 3.0),)),
        Attack("translation", "Affine", "translation by a diagonal", vtkMeshAttack.Translation),
    ]
    for tenths in range(1, 11):
        strength = tenths / 10.0
        attacks.append(Attack(f"noise-{strength}", "Noise", f"noise, s = {strength}",
                              vtkMeshAttack.NoiseAlongNormals, (("NoiseFactor", strength),)))
    for percent in (10, 25, 50, 75, 90, 95):
        attacks.append(Attack(f"simplify-{percent}", "Simplification",
                              f"simplification, {percent} %", vtkMeshAttack.Simplification,
                              (("SimplificationPercent", float(percent)),)))
    attacks.append(Attack("smooth-kept", "Smoothing", "smoothing, rest kept",
                          vtkMeshAttack.SpectralSmoothing, (("KeepResidual", True),)))
    attacks.append(Attack("smooth-dropped", "Smoothing", "smoothing, rest dropped (as printed)",
                          vtkMeshAttack.SpectralSmoothing, (("KeepResidual", False),)))
    return attacks


ATTACKS = tuple(_attacks())
ATTACK = {attack.key: attack for attack in ATTACKS}
UNATTACKED = "none"
REFUSED = "refused"  # the key of the filter's message in the record of a refused attack


def messages(count: int) -> list[str]:
    """Distinct five-bit messages, the same in every run."""
    drawn = np.random.default_rng(SEED).permutation(2**BITS)[:count]
    return [format(number, f"0{BITS}b") for number in drawn]


def embed(model: Model, mode: Mode, message: str) -> tuple[vtkSpectralWatermarkEmbed, int]:
    """The filter after its run, and the component where its first slot begins."""
    mesh, first = original_of(model)
    embedding = vtkSpectralWatermarkEmbed()
    embedding.SetMessage(message)
    _run(embedding, mesh, mode, first)
    return embedding, first


def _run(
    watermark: vtkSpectralWatermarkAlgorithm, mesh: vtkPolyData, mode: Mode, first: int
) -> None:
    watermark.SetInputData(mesh)
    watermark.SetSchemeToPaperSlots()
    watermark.SetFirstComponent(first)
    watermark.SetSlotDivision(mode.division)
    watermark.SetBitEmbedding(mode.embedding)
    update(watermark)


def attacked(mesh: vtkPolyData, attack: Attack, seed: int) -> vtkPolyData:
    """The attacked mesh. Smoothing reuses a basis that the mesh carries."""
    vandal = vtkMeshAttack()
    vandal.SetInputData(mesh)
    vandal.SetAttack(attack.kind)
    vandal.SetSeed(seed)
    vandal.SetNumberOfHarmonics(smoothing_harmonics(mesh))
    vandal.SetTranslationVector(mesh.GetLength(), 0.0, 0.0)
    for name, value in attack.properties:
        getattr(vandal, f"Set{name}")(value)
    update(vandal)
    return vandal.GetOutput()


def smoothing_harmonics(mesh: vtkPolyData) -> int:
    return min(SMOOTHING_HARMONICS, mesh.GetNumberOfPoints() // 2)


def read(mesh: vtkPolyData, mode: Mode, first: int, message: str) -> dict:
    """The detector's reading, from the mesh alone."""
    detector = vtkSpectralWatermarkDetect()
    detector.SetExpectedMessage(message)
    # Five bits cannot reach a p-value that proves a mark, so every rate is accepted.
    detector.SetFalsePositiveRate(1.0)
    _run(detector, mesh, mode, first)
    return {
        "read": detector.GetExtractedMessage(),
        "errors": round(detector.GetBitErrorRate() * len(message)),
        "ratio": detector.GetLogLikelihoodRatio(),
        "vertices": mesh.GetNumberOfPoints(),
    }


def mark_and_attack(
    model: Model, mode_key: str, message: str, attack_keys: Sequence[str]
) -> list[dict]:
    """Marks a model and reads it after each attack or UNATTACKED; returns a record for each."""
    mode = MODE[mode_key]
    embedding, first = embed(model, mode, message)
    marked = embedding.GetOutput()
    smoothable = marked
    if any(key.startswith("smooth") for key in attack_keys):
        smoothable = harmonics_of(marked, smoothing_harmonics(marked))
    records = []
    for key in attack_keys:
        if key == UNATTACKED:
            records.append(_embedding_record(model, mode, message, embedding, first))
            continue
        victim = smoothable if key.startswith("smooth") else marked
        try:
            # Each message gets its own noise, so that the averages cover both.
            mesh = attacked(victim, ATTACK[key], seed=1 + int(message, 2))
            records.append(read(mesh, mode, first, message))
        except FilterError as error:  # for example too few vertices; the other attacks continue
            records.append({REFUSED: str(error)})
    return records


def _embedding_record(
    model: Model, mode: Mode, message: str, embedding: vtkSpectralWatermarkEmbed, first: int
) -> dict:
    distortion = vtkMeshDistortion()
    distortion.ComputeSurfaceDistancesOff()
    distortion.ComputePerceptualDistancesOff()
    distortion.SetInputData(0, original_of(model)[0])
    distortion.SetInputData(1, embedding.GetOutput())
    update(distortion)
    return read(embedding.GetOutput(), mode, first, message) | {
        "converged": bool(embedding.GetConverged()),
        "iterations": embedding.GetNumberOfIterationsUsed(),
        "geometric": 100.0 * distortion.GetGeomDiff(),
        "curvature": 100.0 * distortion.GetCurvDiff(),
        "first": first,
    }


def attack_unmarked(model: Model, attack_keys: Sequence[str]) -> list[dict]:
    """The magnitudes in the five slots of an unmarked model after each attack.

    A detector must not mistake these for a mark.
    """
    mesh, first = original_of(model)
    smoothable = mesh
    if any(key.startswith("smooth") for key in attack_keys):
        smoothable = harmonics_of(mesh, smoothing_harmonics(mesh))
    records = []
    for key in attack_keys:
        victim = smoothable if key.startswith("smooth") else mesh
        try:
            after = victim if key == UNATTACKED else attacked(victim, ATTACK[key], seed=0)
            needed = first - 1 + BITS * SLOT_SIZE
            slots = magnitudes_of(harmonics_of(after, needed))[first - 1:]
            records.append({"slots": slots.tolist()})
        except FilterError as error:
            records.append({REFUSED: str(error)})
    return records
