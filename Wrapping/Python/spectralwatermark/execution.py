# SPDX-License-Identifier: BSD-3-Clause
"""Running filters quietly: what they complain about becomes an exception."""

from __future__ import annotations

from collections.abc import Callable

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

__all__ = ["FilterError", "update"]


class FilterError(Exception):
    """A filter refused, failed or was stopped; its text is the filter's own message."""


def update(
    algorithm: vtkAlgorithm,
    show_progress: Callable[[float], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> None:
    """Updates; raises FilterError with the first error, and when stopped() told it to stop.
    Warnings (no convergence, say) are left to the caller, who asks the filter's getters."""
    complaints: list[str] = []

    def complain(_caller, _event, message: str) -> None:
        complaints.append(message)

    def report(caller, _event) -> None:
        if show_progress is not None:
            show_progress(caller.GetProgress())
        if stopped is not None and stopped():
            caller.SetAbortExecute(1)

    complain.CallDataType = "string0"
    executive = algorithm.GetExecutive()
    observed = [
        (algorithm, algorithm.AddObserver(vtkCommand.ErrorEvent, complain)),
        (algorithm, algorithm.AddObserver(vtkCommand.WarningEvent, lambda *_: None)),
        (algorithm, algorithm.AddObserver(vtkCommand.ProgressEvent, report)),
        # Its executive only repeats that the filter failed.
        (executive, executive.AddObserver(vtkCommand.ErrorEvent, lambda *_: None)),
    ]
    algorithm.Update()
    for subject, tag in observed:
        subject.RemoveObserver(tag)
    if complaints:
        # "ERROR: In file, line n\nvtkClass (0x...): what the user needs\n\n"
        raise FilterError(complaints[0].split("): ", 1)[-1].strip())
    if stopped is not None and stopped():
        raise FilterError("stopped")
