# SPDX-License-Identifier: BSD-3-Clause
"""The error that every function of this package raises."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager


class MeshFileError(Exception):
    """A file that cannot be read or written; its text is one line: what is wrong, what to do."""


NO_POLYGONS = "the file has no polygons; export it as a surface mesh"
CUT_OFF = "the file ends before its last face; it was cut off: copy or export it again"


@contextmanager
def system_errors(path: str | os.PathLike, done: str) -> Iterator[None]:
    """Turns what the operating system refuses into a MeshFileError; `done` is read or written."""
    try:
        yield
    except OSError as error:
        raise MeshFileError(f"{path}: cannot be {done}: {error.strerror}") from error
