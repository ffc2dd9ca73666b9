# SPDX-License-Identifier: BSD-3-Clause
"""Attacks a marked mesh in many ways and writes a page that shows what the mark survives."""

from __future__ import annotations

from typing import TypedDict

from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.io import check_writable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from ..output import UserError
from ..tasks import Report
from .detect import check_provable, detector
from .filters import FilterRunner, read_valid_mesh


class Result(TypedDict):
    marked: str
    output: str
    found: bool
    attacks: int
    survived: int


def run(task: Report, filters: FilterRunner) -> Result:
    check_writable(task.output)
    try:  # not above: this loads the libraries that draw
        from spectralwatermark.report import write_report
    except ModuleNotFoundError as error:
        raise UserError(str(error)) from None

    def update(algorithm: vtkAlgorithm, what: str) -> None:
        filters.update(algorithm, what)
        if isinstance(algorithm, vtkSpectralWatermarkDetect):
            check_provable(algorithm)

    readings = write_report(
        read_valid_mesh(task.input), read_valid_mesh(task.marked), task.output,
        lambda: detector(task.watermark, task.rate), task.title, update, task.force)
    return {"marked": task.marked, "output": task.output, "found": readings[0].found,
            "attacks": len(readings) - 2, "survived": sum(each.found for each in readings[1:-1])}
