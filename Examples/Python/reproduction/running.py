# SPDX-License-Identifier: BSD-3-Clause
"""Running filters quietly: what they complain about becomes an exception."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from spectralwatermark import mesh_io
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm


class FilterError(Exception):
    """A filter refused or failed; its text is the filter's own message."""


def update(algorithm: vtkAlgorithm, show_progress: Callable[[float], None] | None = None) -> None:
    """Updates; raises FilterError with the first error. Warnings (no convergence, say) are left
    to the caller, who asks the filter's getters."""
    complaints: list[str] = []

    def complain(_caller, _event, message: str) -> None:
        complaints.append(message)

    complain.CallDataType = "string0"
    executive = algorithm.GetExecutive()
    observed = [
        (algorithm, algorithm.AddObserver(vtkCommand.ErrorEvent, complain)),
        (algorithm, algorithm.AddObserver(vtkCommand.WarningEvent, lambda *_: None)),
        # Its executive only repeats that the filter failed.
        (executive, executive.AddObserver(vtkCommand.ErrorEvent, lambda *_: None)),
    ]
    if show_progress is not None:
        observed.append((algorithm, algorithm.AddObserver(
            vtkCommand.ProgressEvent, lambda caller, _: show_progress(caller.GetProgress()))))
    algorithm.Update()
    for subject, tag in observed:
        subject.RemoveObserver(tag)
    if complaints:
        # "ERROR: In file, line n\nvtkClass (0x...): what the user needs\n\n"
        raise FilterError(complaints[0].split("): ", 1)[-1].strip())


def read_mesh(path: Path) -> vtkPolyData:
    try:
        return mesh_io.read_mesh(path)
    except mesh_io.MeshFileError as error:
        raise FilterError(str(error)) from error
