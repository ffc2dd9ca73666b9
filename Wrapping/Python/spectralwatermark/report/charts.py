# SPDX-License-Identifier: BSD-3-Clause
"""Charts of what the filters' table ports hold. Drawn like pictures, they need a display, real or
virtual."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable

from .rendering import Curve, table_of, write_chart

__all__ = ["write_carriers", "write_spectra"]

COLOURS = ("SteelBlue", "DarkOrange", "SeaGreen", "Purple", "Firebrick")


def write_spectra(path: Path, original: vtkTable, marked: vtkTable) -> None:
    """Both magnitudes, from tables of vtkManifoldHarmonics, without the constant harmonic's: that is
    the position."""
    curves = []
    for table, label, colour in ((original, "original", "SteelBlue"), (marked, "marked", "DarkOrange")):
        columns = {name: vtk_to_numpy(table.GetColumnByName(name))[1:]
                   for name in ("Component", "Magnitude")}
        curves.append(Curve(table_of(**columns), "Component", "Magnitude", label, colour))
    write_chart(path, curves, "Spectrum of the mesh before and after",
                ("component", "magnitude (logarithmic scale)"), logarithmic=True)


def write_carriers(path: Path, copies: Sequence[tuple[str, vtkTable]]) -> None:
    """How firmly each carrier holds its bit of the code: up to five copies' tables of
    vtkSpectralWatermarkDetect, the marked mesh's first."""
    wanted = 2.0 * vtk_to_numpy(copies[0][1].GetColumnByName("Bit")) - 1.0
    curves = []
    for (name, carriers), colour in zip(copies, COLOURS):
        margins = np.sort(wanted * vtk_to_numpy(carriers.GetColumnByName("Margin")))
        table = table_of(Carrier=np.arange(1, margins.size + 1), Margin=margins)
        curves.append(Curve(table, "Carrier", "Margin", name, colour))
    write_chart(path, curves,
                "Carriers of the code: above 0 they hold their bit, below they read the other",
                ("carriers, each copy's in order", "margin"))
