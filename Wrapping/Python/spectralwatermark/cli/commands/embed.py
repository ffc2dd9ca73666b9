# SPDX-License-Identifier: BSD-3-Clause
"""Embeds a mark, checks that it can be read back, and writes the mesh."""

from __future__ import annotations

from typing import NotRequired, TypedDict

from spectralwatermark import vtkSpectralWatermarkEmbed
from spectralwatermark.execution import FilterError
from spectralwatermark.io import check_writable, read_mesh, stores_float, write_mesh
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from ..tasks import Embed
from .filters import FilterRunner, set_watermark


class Result(TypedDict):
    output: str
    scheme: str
    secret: bool
    bits: int
    seconds: float
    distortion_percent: NotRequired[float]  # of the robust scheme
    margin: NotRequired[float]
    iterations: NotRequired[int]  # of the paper's scheme


def run(task: Embed, filters: FilterRunner) -> Result:
    check_writable(task.output)
    is_float = stores_float(task.output)
    mark = task.watermark
    embed = vtkSpectralWatermarkEmbed()
    set_watermark(embed, mark)
    embed.SetInputData(read_mesh(task.input))
    if mark.message or mark.secret.is_given():
        embed.SetMessage(mark.message)
    embed.SetMaximumDistortion(task.distortion)
    if is_float:  # verify the mark on what the file will hold
        embed.SetOutputPointsPrecision(vtkAlgorithm.SINGLE_PRECISION)
    seconds = filters.update(embed, "embedding")
    if not embed.GetConverged():
        raise FilterError("the embedded mark cannot be read back; nothing was written. Try fewer bits or a larger "
                          "--distortion")
    marked = embed.GetOutput()
    # The array would tell everyone that there is a mark, and where.
    marked.GetPointData().RemoveArray("GeometricDistortion")
    write_mesh(marked, task.output, task.force)
    result: Result = {"output": task.output, "scheme": mark.scheme, "secret": mark.secret.is_given(),
                      "bits": len(embed.GetExtractedMessage()), "seconds": round(seconds, 3)}
    if mark.scheme == "robust":
        return result | {"distortion_percent": embed.GetDistortion(), "margin": embed.GetMargin()}
    return result | {"iterations": embed.GetNumberOfIterationsUsed()}
