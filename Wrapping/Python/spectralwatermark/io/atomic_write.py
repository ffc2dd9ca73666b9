# SPDX-License-Identifier: BSD-3-Clause
"""Writes a file whole or not at all."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from .errors import MeshFileError, system_errors


def write_file(
    path: str | os.PathLike, write: Callable[[Path], object], replace: bool = True
) -> None:
    """Has write() fill a temporary file in the same folder, then renames it to `path`."""
    path = Path(path)
    # A symbolic link stays, and the file that it points to is replaced.
    target = Path(os.path.realpath(path))
    partial = target.with_name(f".{os.urandom(8).hex()}.partial{target.suffix.lower()}")
    with system_errors(path, "written"):
        try:
            # The system gives the reason of a failure here; VTK would not.
            partial.touch()
            write(partial)
            _move(partial, target, replace)
        except FileExistsError:
            raise MeshFileError(f"{path}: already exists; not overwritten") from None
        except MeshFileError as error:
            raise MeshFileError(f"{path}: not written: {error}") from None
        finally:
            # The partial file may have been renamed, or never made.
            with suppress(OSError):
                partial.unlink()


def _move(partial: Path, target: Path, replace: bool) -> None:
    if not replace:
        # A link fails when the file exists by now; a rename would overwrite it.
        os.link(partial, target)
        return
    if target.exists():
        shutil.copymode(target, partial)
    partial.replace(target)


def check_writable(path: str | os.PathLike) -> None:
    """Raises MeshFileError when no file of this name can be made: before the work, not after it."""
    path = Path(path)
    with system_errors(path, "written"):
        if path.is_dir():
            raise MeshFileError(f"{path}: this is a folder; name a file in it")
        folder = Path(os.path.realpath(path)).parent
        if not folder.is_dir():
            raise MeshFileError(f"{path}: the folder {path.parent} does not exist; create it first")
        if not os.access(folder, os.W_OK | os.X_OK):
            raise MeshFileError(
                f"{path}: cannot be written: no permission to write to the folder {path.parent}; "
                "choose another folder")
        if path.exists() and not os.access(path, os.W_OK):
            raise MeshFileError(f"{path}: not overwritten: it is read-only; choose another name")
