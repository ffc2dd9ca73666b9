# SPDX-License-Identifier: BSD-3-Clause
"""The schemes that are compared, each as two functions: mark a mesh, read a copy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import comb

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

import cho2007
from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed

BITS = 64
BITS_OF_PAPER = 5


@dataclass
class Marked:
    mesh: vtkPolyData
    converged: bool


@dataclass
class Reading:
    bit_error_rate: float
    p_value: float
    valid: bool


@dataclass(frozen=True)
class Scheme:
    name: str
    description: str
    bits: int
    mark: Callable[[vtkPolyData, str], Marked]
    read: Callable[[vtkPolyData, str], Reading]


def _secret(key: str) -> str:
    return f"robustness key {key}"


def _set(filter_: vtkSpectralWatermarkEmbed | vtkSpectralWatermarkDetect, mesh: vtkPolyData, key: str,
         properties: dict[str, object]) -> None:
    filter_.SetInputData(mesh)
    for name, value in properties.items():
        getattr(filter_, f"Set{name}")(value)
    filter_.SetSecretKey(_secret(key))


def _embed(mesh: vtkPolyData, key: str, **properties: object) -> Marked:
    embed = vtkSpectralWatermarkEmbed()
    _set(embed, mesh, key, properties)
    embed.SetMessage("")
    embed.Update()
    if embed.GetErrorCode():
        raise RuntimeError("embedding failed")
    return Marked(embed.GetOutput(), bool(embed.GetConverged()))


def _detect(mesh: vtkPolyData, key: str, **properties: object) -> Reading:
    detect = vtkSpectralWatermarkDetect()
    _set(detect, mesh, key, properties)
    detect.UseDerivedMessageOn()
    detect.SetFalsePositiveRate(1.0)  # p-values are judged later; five bits could not reach a lower rate
    detect.Update()
    if detect.GetErrorCode():
        return Reading(0.5, 1.0, False)
    return Reading(detect.GetBitErrorRate(), detect.GetPValue(), bool(detect.GetMessageIsValid()))


def _robust(budget: float) -> Scheme:
    properties = {"Scheme": vtkSpectralWatermarkEmbed.Robust, "NumberOfBits": BITS}
    return Scheme(
        f"robust {budget:g} %", f"Robust, MaximumDistortion {budget:g} %", BITS,
        lambda mesh, key: _embed(mesh, key, MaximumDistortion=budget, **properties),
        lambda mesh, key: _detect(mesh, key, **properties))


def _paper(division: int, embedding: int) -> Scheme:
    properties = {"Scheme": vtkSpectralWatermarkEmbed.PaperSlots, "NumberOfBits": BITS_OF_PAPER,
                  "SlotDivision": division, "BitEmbedding": embedding}
    name = f"{('normal', 'narrow')[division]}, {('aggressive', 'non-aggressive')[embedding]}"
    return Scheme(
        f"paper: {name}", f"PaperSlots, {name}, {BITS_OF_PAPER} bits", BITS_OF_PAPER,
        lambda mesh, key: _embed(mesh, key, **properties),
        lambda mesh, key: _detect(mesh, key, **properties))


def _message(key: str) -> str:
    random = np.random.default_rng(int(key))
    return "".join(str(bit) for bit in random.integers(0, 2, BITS))


def _mark_cho(mesh: vtkPolyData, key: str) -> Marked:
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    changed = cho2007.embed(points, _message(key))
    marked = vtkPolyData()
    marked.ShallowCopy(mesh)
    moved = vtkPoints()
    moved.SetData(numpy_to_vtk(changed, deep=True))
    marked.SetPoints(moved)
    return Marked(marked, cho2007.extract(changed, BITS) == _message(key))


def _read_cho(mesh: vtkPolyData, key: str) -> Reading:
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    read = cho2007.extract(points, BITS)
    wrong = sum(a != b for a, b in zip(read, _message(key)))
    tail = sum(comb(BITS, k) for k in range(wrong + 1)) / 2.0**BITS
    return Reading(wrong / BITS, tail, False)


SCHEMES = (
    _robust(0.07),
    _robust(0.018),
    Scheme("Cho 2007", f"vertex norms, means, strength {cho2007.STRENGTH:g}", BITS, _mark_cho, _read_cho),
    _paper(0, 0), _paper(0, 1), _paper(1, 0), _paper(1, 1),
)
