# SPDX-License-Identifier: BSD-3-Clause
"""A display to draw on."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager

from .output import UserError
from .processes import end_with_parent


@contextmanager
def display(needed: bool) -> Iterator[None]:
    """Starts a virtual display when one is needed and no display works.

    xvfb-run and PyVirtualDisplay leave the server in the terminal's foreground group, where Control-C ends it before
    the drawing stops, and leave it running when the program is killed.
    """
    if not needed or _display_works():
        yield
        return
    if not shutil.which("Xvfb"):
        raise UserError("the report draws pictures: it needs a display, or a virtual one (Debian: xvfb and "
                        "libgl1-mesa-dri)")
    read, write = os.pipe()
    with subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-noreset", "-nolisten", "tcp"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
            preexec_fn=end_with_parent) as server:
        os.close(write)
        try:
            with os.fdopen(read) as answer:
                number = answer.readline().strip()
            if not number:
                raise UserError("the virtual display (Xvfb) did not start")
            os.environ["DISPLAY"] = f":{number}"
            yield
        finally:
            server.terminate()


def _display_works() -> bool:
    """VTK cannot be asked: it ends the process when it cannot connect."""
    if not os.environ.get("DISPLAY"):
        return False
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return False
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    connection = x11.XOpenDisplay(None)
    if not connection:
        return False
    x11.XCloseDisplay(connection)
    return True
