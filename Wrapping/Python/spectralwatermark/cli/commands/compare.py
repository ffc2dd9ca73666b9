# SPDX-License-Identifier: BSD-3-Clause
"""Measures how far two surfaces are apart, and how visible that is."""

from __future__ import annotations

from typing import NotRequired, TypedDict

from spectralwatermark import vtkMeshDistortion
from spectralwatermark.io import check_writable, write_mesh

from ..tasks import Compare
from .filters import FilterRunner, read_valid_mesh


class Result(TypedDict):
    other: str
    mrms_percent: float
    hausdorff_percent: float
    msdm2: float
    msdm: NotRequired[float]  # when the points correspond
    geometric_difference_percent: NotRequired[float]
    curvature_difference_percent: NotRequired[float]


def run(task: Compare, filters: FilterRunner) -> Result:
    if task.output is not None:
        check_writable(task.output)
    distortion = vtkMeshDistortion()
    for port, path in enumerate((task.input, task.other)):
        distortion.SetInputData(port, read_valid_mesh(path))
    filters.update(distortion, "comparing")
    if task.output is not None:
        write_mesh(distortion.GetOutput(), task.output, task.force)
    result: Result = {"other": task.other, "mrms_percent": 100.0 * distortion.GetMRMS(),
                      "hausdorff_percent": 100.0 * distortion.GetHausdorff(), "msdm2": distortion.GetMSDM2()}
    if distortion.GetGeomDiff() >= 0.0:  # the points correspond
        result |= {"msdm": distortion.GetMSDM(),
                   "geometric_difference_percent": 100.0 * distortion.GetGeomDiff(),
                   "curvature_difference_percent": 100.0 * distortion.GetCurvDiff()}
    return result
