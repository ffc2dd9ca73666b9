# SPDX-License-Identifier: BSD-3-Clause
"""Any bytes as a mesh file, through the readers and writers of the command line. FuzzFiles.cxx calls it."""

import inspect
import itertools
import os
import sys
import tempfile
import types
from pathlib import Path

from vtkmodules.vtkCommonCore import vtkObject

# The package as its sources are, without the library, which no reader needs.
package = types.ModuleType("spectralwatermark")
package.__path__ = [str(Path(__file__).resolve().parents[2] / "Wrapping" / "Python" / "spectralwatermark")]
sys.modules[package.__name__] = package
from spectralwatermark.io import MeshFileError, read_mesh, write_mesh  # noqa: E402

READ = (".ply", ".obj", ".stl", ".vtp", ".off")
WRITTEN = (".ply", ".obj", ".stl", ".vtp")


def _file_name(module) -> str:
    """The string object that all code of a module holds as the name of its file."""
    codes = (getattr(inspect.unwrap(item), "__code__", None) for item in vars(module).values())
    return next(code.co_filename for code in codes if code and code.co_filename == module.__file__)


# FuzzFiles.cxx compares these objects by identity: to compare their text at every line would be slow.
TRACED_FILES = tuple(_file_name(module) for name, module in sorted(sys.modules.items())
                     if (name + ".").startswith("spectralwatermark.io."))

vtkObject.GlobalWarningDisplayOff()
_folder = tempfile.TemporaryDirectory(prefix="fuzz", dir="/dev/shm" if os.path.isdir("/dev/shm") else None)
_numbers = itertools.count()


def run(data: bytes) -> None:
    """The first byte chooses the format; a quarter of what is read is written again and read back."""
    if not data:
        return
    choice = data[0]
    source = Path(_folder.name, "read" + READ[choice % len(READ)])
    source.write_bytes(data[1:])
    try:
        mesh = read_mesh(source)
    except MeshFileError as error:
        assert str(error).startswith(str(source)) and "\n" not in str(error), error
        return
    if choice // 8 % 4 == 0:
        _there_and_back(mesh, WRITTEN[choice // 32 % len(WRITTEN)])
        assert not list(Path(_folder.name).glob(".*")), "a part of a file is left"


def _there_and_back(mesh, suffix: str) -> None:
    target = Path(_folder.name, "written" + suffix)
    try:
        write_mesh(mesh, target)
    except MeshFileError as error:
        assert not target.exists() and "\n" not in str(error), error
        return
    polygons = mesh.GetNumberOfPolys()
    try:
        again = read_mesh(target)
        if suffix == ".vtp":  # the others may part strips and seams, or leave out what has no area
            assert again.GetNumberOfPoints() == mesh.GetNumberOfPoints()
            assert again.GetNumberOfPolys() == polygons
    finally:
        target.unlink()
