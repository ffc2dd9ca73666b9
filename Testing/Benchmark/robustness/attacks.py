# SPDX-License-Identifier: BSD-3-Clause
"""The attacks on marked meshes, and their strengths."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from vtkmodules.vtkCommonDataModel import vtkPolyData

from spectralwatermark import vtkMeshAttack
from spectralwatermark.attacks import ATTACKS as TABLE
from spectralwatermark.io import read_mesh, write_mesh


@dataclass(frozen=True)
class Attack:
    """A row of the tables for each strength."""

    name: str
    unit: str
    apply: Callable[[vtkPolyData, str], vtkPolyData]
    strengths: tuple[str, ...]


def _by(name: str, value: str = "") -> Callable[[vtkPolyData, str], vtkPolyData]:
    """An attack of the table of attacks; the strength is its value, unless it is a word that is always the same."""
    attack = TABLE[name]

    def apply(mesh: vtkPolyData, strength: str) -> vtkPolyData:
        return _updated(attack.on(mesh, value or attack.type(strength)))

    return apply


def _seeded(name: str) -> Callable[[vtkPolyData, str], vtkPolyData]:
    """A random attack without a value; the strength is the seed."""

    def apply(mesh: vtkPolyData, strength: str) -> vtkPolyData:
        return _updated(TABLE[name].on(mesh, seed=int(strength)))

    return apply


def _updated(attack: vtkMeshAttack) -> vtkPolyData:
    attack.Update()
    if attack.GetErrorCode():
        raise RuntimeError(f"{attack.GetAttackAsString()} failed")
    return attack.GetOutput()


def _nothing(mesh: vtkPolyData, _: str) -> vtkPolyData:
    return mesh


def _file(mesh: vtkPolyData, suffix: str) -> vtkPolyData:
    """Writes and reads the mesh: a format keeps or loses precision, order and shared points."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"mesh.{suffix}"
        write_mesh(mesh, path)
        return read_mesh(path)


# Names, units and strengths follow the benchmark of Wang and others (2010); some attacks are not in it.
ATTACKS = (
    Attack("none", "", _nothing, ("0",)),
    Attack("file", "format", _file, ("ply", "obj", "stl", "vtp")),
    Attack("similarity", "seed", _seeded("similarity"), ("1", "2")),
    Attack("reordering", "seed", _seeded("shuffle"), ("1",)),
    Attack("noise", "%", _by("noise"), ("0.05", "0.1", "0.3", "0.5")),
    Attack("smoothing", "iterations", _by("smooth"), ("5", "10", "30", "50")),
    Attack("quantization", "bits", _by("quantize"), ("11", "10", "9", "8", "7")),
    Attack("midpoint", "times", _by("subdivide", "midpoint"), ("1",)),
    Attack("sqrt3", "times", _by("subdivide", "sqrt3"), ("1",)),
    Attack("Loop", "times", _by("subdivide", "loop"), ("1",)),
    Attack("simplification", "%", _by("simplify"), ("10", "30", "50", "70", "90", "95")),
    Attack("remeshing", "% of the points", _by("remesh"), ("100",)),
    Attack("isosurface", "steps", _by("isosurface"), ("256",)),
    Attack("cropping", "%", _by("crop"), ("10", "30")),
)
