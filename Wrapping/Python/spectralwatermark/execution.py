# SPDX-License-Identifier: BSD-3-Clause
"""Updates filters quietly: an error of the filter becomes an exception."""

from __future__ import annotations

from collections.abc import Callable

from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

__all__ = ["FilterError", "update"]


class FilterError(Exception):
    """A filter refused its input, failed or was stopped.

    str() is the filter's whole text. `parameter` names the property at fault ("" when there is none), `reason`
    says what is wrong, and `advice` what to do about it ("" when there is none).
    """

    def __init__(self, text: str, parameter: str = "", reason: str = "", advice: str = "") -> None:
        super().__init__(text)
        self.parameter = parameter
        self.reason = reason or text
        self.advice = advice


def update(
    algorithm: vtkAlgorithm,
    show_progress: Callable[[float], None] | None = None,
    stopped: Callable[[], bool] | None = None,
) -> None:
    """Updates the algorithm; raises FilterError with its first error, and when stopped() told it to stop.
    Warnings are not reported: ask the filter's getters, such as GetConverged()."""
    errors: list[str] = []

    def keep_error(_caller, _event, message: str) -> None:
        errors.append(message)

    def report(caller, _event) -> None:
        if show_progress is not None:
            show_progress(caller.GetProgress())
        if stopped is not None and stopped():
            caller.SetAbortExecute(1)

    keep_error.CallDataType = "string0"
    executive = algorithm.GetExecutive()
    observed = [
        (algorithm, algorithm.AddObserver(vtkCommand.ErrorEvent, keep_error)),
        (algorithm, algorithm.AddObserver(vtkCommand.WarningEvent, lambda *_: None)),
        (algorithm, algorithm.AddObserver(vtkCommand.ProgressEvent, report)),
        # The executive only repeats that the filter failed.
        (executive, executive.AddObserver(vtkCommand.ErrorEvent, lambda *_: None)),
    ]
    algorithm.Update()
    for subject, tag in observed:
        subject.RemoveObserver(tag)
    if errors:
        raise _error_of(algorithm, errors[0])
    if stopped is not None and stopped():
        raise FilterError("stopped")


def _error_of(algorithm: vtkAlgorithm, message: str) -> FilterError:
    # VTK's macro writes "ERROR: In file, line n\nvtkClass (0x...): text\n\n".
    text = message.split("): ", 1)[-1].strip()

    # VTK's own filters have only the text.
    def part(getter: str) -> str:
        return getattr(algorithm, getter)() if hasattr(algorithm, getter) else ""

    return FilterError(text, part("GetErrorParameter"), part("GetErrorReason"), part("GetErrorAdvice"))
