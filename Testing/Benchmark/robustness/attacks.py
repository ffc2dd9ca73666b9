# SPDX-License-Identifier: BSD-3-Clause
"""What is done to marked meshes, and how strongly."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from vtkmodules.vtkCommonDataModel import vtkPolyData

from spectralwatermark import vtkMeshAttack
from spectralwatermark.io import read_mesh, write_mesh


@dataclass(frozen=True)
class Attack:
    """A row of the tables for each strength."""

    name: str
    unit: str
    apply: Callable[[vtkPolyData, str], vtkPolyData]
    strengths: tuple[str, ...]


def _with_filter(attack: str, setter: str | None = None, **fixed: int):
    def apply(mesh: vtkPolyData, strength: str) -> vtkPolyData:
        filter_ = vtkMeshAttack()
        filter_.SetInputData(mesh)
        getattr(filter_, f"SetAttackTo{attack}")()
        for name, value in fixed.items():
            getattr(filter_, f"Set{name}")(value)
        if setter:
            number = float(strength)
            getattr(filter_, f"Set{setter}")(int(number) if number == int(number) else number)
        filter_.Update()
        if filter_.GetErrorCode():
            raise RuntimeError(f"{attack} {strength} failed")
        return filter_.GetOutput()
    return apply


def _nothing(mesh: vtkPolyData, _: str) -> vtkPolyData:
    return mesh


def _file(mesh: vtkPolyData, suffix: str) -> vtkPolyData:
    """Written and read again: a format keeps or loses precision, order and shared points."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"mesh.{suffix}"
        write_mesh(mesh, path)
        return read_mesh(path)


# Names, units and strengths as in the benchmark of Wang and others (2010), and what it has not.
ATTACKS = (
    Attack("none", "", _nothing, ("0",)),
    Attack("file", "format", _file, ("ply", "obj", "stl", "vtp")),
    Attack("similarity", "seed", _with_filter("Similarity", "Seed"), ("1", "2")),
    Attack("reordering", "seed", _with_filter("VertexReordering", "Seed"), ("1",)),
    Attack("noise", "%", _with_filter("NoiseUniform", "NoisePercent"), ("0.05", "0.1", "0.3", "0.5")),
    Attack("smoothing", "iterations", _with_filter("LaplacianSmoothing", "SmoothingIterations"),
           ("5", "10", "30", "50")),
    Attack("quantization", "bits", _with_filter("Quantization", "QuantizationBits"),
           ("11", "10", "9", "8", "7")),
    Attack("midpoint", "times", _with_filter("Subdivision", SubdivisionType=0), ("1",)),
    Attack("sqrt3", "times", _with_filter("Subdivision", SubdivisionType=2), ("1",)),
    Attack("Loop", "times", _with_filter("Subdivision", SubdivisionType=1), ("1",)),
    Attack("simplification", "%", _with_filter("Simplification", "SimplificationPercent"),
           ("10", "30", "50", "70", "90", "95")),
    Attack("remeshing", "% of the points",
           _with_filter("Remeshing", "RemeshingPercent", RemeshingMethod=0), ("100",)),
    Attack("isosurface", "steps", _with_filter("Remeshing", "IsosurfaceResolution", RemeshingMethod=1),
           ("256",)),
    Attack("cropping", "%", _with_filter("Cropping", "CroppingPercent"), ("10", "30")),
)
