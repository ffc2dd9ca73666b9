# SPDX-License-Identifier: BSD-3-Clause
"""Runs VTK's readers and writers, and turns their messages into a MeshFileError.

The modules of the formats import each reader and writer in the function that uses it: to load them
all takes longer than to read a mesh of 50,000 points.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .errors import MeshFileError

INCOMPLETE = "VTK did not write all of it; is the disk full?"


def run_reader(reader: vtkAlgorithm) -> vtkPolyData:
    """The mesh that the reader makes of its file."""
    with _vtk_messages() as messages:
        reader.Update()
    error = _first_error(messages)
    if error:
        raise MeshFileError(f"{error}; is the file damaged?")
    return reader.GetOutput()


def run_writer(writer: vtkAlgorithm, mesh: vtkPolyData, path: Path) -> None:
    """Writes the mesh, and raises MeshFileError when the writer noticed a failure."""
    writer.SetInputData(mesh)
    writer.SetFileName(os.fsencode(path))
    with _vtk_messages() as messages:
        writer.Write()
    # Each writer reports a failure in its own way, by a message, a code, or no file, and none gives
    # the reason.
    if _first_error(messages) or writer.GetErrorCode() or not path.exists():
        raise MeshFileError(INCOMPLETE)


def expect_whole(path: Path, check: Callable[[bytes], object]) -> None:
    """Checks what was written: the writers of PLY, OBJ and STL do not notice a full disk."""
    try:
        check(path.read_bytes())
    except MeshFileError:
        raise MeshFileError(INCOMPLETE) from None


@contextmanager
def _vtk_messages() -> Iterator[vtkStringOutputWindow]:
    """Collects the messages of all of VTK, and keeps them off the terminal.

    Observers cannot do this: they do not reach the parser inside the XML reader.
    """
    messages = vtkStringOutputWindow()
    window = vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(messages)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    if vtkLogger.GetCurrentVerbosityCutoff() == verbosity:
        # This was the cutoff of a log file, which records more than the terminal shows. The
        # terminal's own cannot be asked for, so it gets its default.
        verbosity = min(verbosity, vtkLogger.VERBOSITY_INFO)
    try:
        yield messages
    finally:
        vtkLogger.SetStderrVerbosity(verbosity)
        vtkOutputWindow.SetInstance(window)


def _first_error(messages: vtkStringOutputWindow) -> str:
    """The first error, on one line, or an empty string.

    VTK writes "ERROR: In file, line n\\nvtkClass (0x...): the message\\n\\n".
    """
    text = messages.GetOutput()
    # VTK returns bytes when a message quotes a file that is not UTF-8.
    text = text if isinstance(text, str) else text.decode("ascii", "replace")
    found = re.search(r"^ERROR: In .*, line \d+\n(?:\w+ \(\w+\): )?(.*)", text, re.MULTILINE)
    return " ".join(found[1].split())[:400].rstrip(".") if found else ""
