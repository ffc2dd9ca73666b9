# SPDX-License-Identifier: BSD-3-Clause
"""Charts of the filters' tables as PNG files, drawn by matplotlib; they need no display.

Importing this module loads matplotlib: import it only where a chart is drawn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkTable

__all__ = ["chart", "write_carriers", "write_spectra"]

PIXELS_PER_INCH = 100
COLOURS = ("steelblue", "darkorange", "seagreen", "purple", "firebrick")


@contextmanager
def chart(path: Path, title: str, x: str, y: str, pixels: tuple[int, int] = (1200, 560)) -> Iterator[Axes]:
    """Gives axes to plot into and writes the PNG file afterwards, whole or not at all.

    x and y label the axes. Labelled plots get a legend to the right, where it hides none of them.
    """
    # A Figure without pyplot: no window and no global state.
    figure = Figure([size / PIXELS_PER_INCH for size in pixels], PIXELS_PER_INCH, layout="constrained")
    axes = figure.add_subplot(xlabel=x, ylabel=y)
    axes.set_title(title, fontsize=15)
    axes.xaxis.label.set_size(13)
    axes.yaxis.label.set_size(13)
    axes.tick_params(labelsize=11)
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    yield axes
    if axes.get_legend_handles_labels()[1]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=12, frameon=False)
    partial = path.with_suffix(".partial.png")
    figure.savefig(partial)
    partial.replace(path)


def write_spectra(path: Path, original: vtkTable, marked: vtkTable) -> None:
    """Draws both magnitudes, from tables of vtkManifoldHarmonics.

    The constant harmonic is left out: it holds the position.
    """
    with chart(path, "Spectrum before and after marking", "component", "magnitude") as axes:
        axes.set_yscale("log")
        for table, label, colour in zip((original, marked), ("original", "marked"), COLOURS):
            axes.plot(_column(table, "Component")[1:], _column(table, "Magnitude")[1:], label=label,
                      color=colour)


def write_carriers(path: Path, copies: Sequence[tuple[str, vtkTable]]) -> None:
    """Draws how firmly each carrier holds its bit of the code, for up to five named copies.

    The tables are those of vtkSpectralWatermarkDetect; the first one is the marked mesh's.
    """
    wanted = 2.0 * _column(copies[0][1], "Bit") - 1.0
    with chart(path, "Carriers that read the right bit (above 0) and the wrong one (below 0)",
               "carriers of each copy, sorted by margin", "margin") as axes:
        axes.axhline(0.0, color="0.6", linewidth=1.0)
        for (name, carriers), colour in zip(copies, COLOURS):
            margins = np.sort(wanted * _column(carriers, "Margin"))
            axes.plot(np.arange(1, margins.size + 1), margins, label=name, color=colour)


def _column(table: vtkTable, name: str) -> np.ndarray:
    return vtk_to_numpy(table.GetColumnByName(name))
