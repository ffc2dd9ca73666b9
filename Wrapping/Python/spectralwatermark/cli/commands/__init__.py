# SPDX-License-Identifier: BSD-3-Clause
"""What each command does to one mesh. A command is a module of its name, with run(task, filters)."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from spectralwatermark.attacks import ATTACKS
from spectralwatermark.execution import FilterError
from spectralwatermark.io import MeshFileError
from vtkmodules.vtkCommonCore import vtkSMPTools

from ..output import UserError, defect
from ..tasks import Task
from .filters import FilterRunner

# The options that set the filters' properties. Properties that are not here have no option.
_OPTIONS = {
    "ExpectedMessage": "--message",
    "FalsePositiveRate": "--false-positive-rate",
    "MaximumDistortion": "--distortion",
    "Message": "--message",
    "NumberOfBits": "--bits",
    "NumberOfHarmonics": "--number",
    "Scheme": "--scheme",
    "SecretKeyFile": "--key-file",
}
_OPTIONS_OF_ATTACKS = {name: f"--{attack.name}" for attack in ATTACKS.values() for name in attack.properties()}


def run(task: Task, filters: FilterRunner) -> dict[str, Any]:
    """The task's result; {"file": ..., "error": one line} when something went wrong."""
    vtkSMPTools.Initialize(task.threads)
    try:
        return {"file": task.input} | import_module(f".{task.command}", __name__).run(task, filters)
    except (MeshFileError, UserError) as error:  # names its file, where one is concerned
        text = str(error)
    except FilterError as error:
        text = f"{' and '.join(task.files())}: {_in_options(error, task)}"
    except Exception as error:  # noqa: BLE001 - one file must not end the run, nor look like "not found"
        text = f"{task.input}: {defect(error)}"
    return {"file": task.input, "error": text}


def _in_options(error: FilterError, task: Task) -> str:
    options = _OPTIONS_OF_ATTACKS if task.command == "attack" else _OPTIONS
    option = options.get(error.parameter)
    return (f"{option}: " if option else "") + error.reason + (f"; {error.advice}" if error.advice else "")
