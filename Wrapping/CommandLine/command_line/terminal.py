# SPDX-License-Identifier: BSD-3-Clause
"""What the program says: results on standard output, all else on standard error."""

from __future__ import annotations

import json
import os
import shutil
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

PROGRAM = "spectral-watermark"

_stopped_by: int | None = None
_bar = None  # the progress bar that is on the terminal


class UserError(Exception):
    """What ends the program with code 2; its text is one line that says what to do."""


def say_error(text: str) -> None:
    print(f"{PROGRAM}: {' '.join(text.split())}", file=sys.stderr, flush=True)


def say(request: dict, result: dict, as_json: bool) -> None:
    """One mesh's result, on standard output; an error on standard error too."""
    if _bar is not None:
        _bar.clear()
    if as_json:
        print(json.dumps(result), flush=True)
    if "error" in result:
        say_error(result["error"])
    elif not as_json:
        from .words import lines_of

        print("\n".join(lines_of(request, result)), flush=True)


# --- Progress ------------------------------------------------------------------------------------


@contextmanager
def progress(request: dict) -> Iterator[Callable[[float, str], None]]:
    """A bar with the time left, on a terminal; nothing in a pipe."""
    if not sys.stderr.isatty():
        yield lambda share, what: None
        return
    from tqdm import tqdm

    bar = tqdm(total=1.0, file=sys.stderr, leave=False, dynamic_ncols=True, desc=request["command"],
               bar_format="{desc:<24} {percentage:3.0f}% |{bar}| {remaining} left")

    def show(share: float, what: str) -> None:
        bar.set_description_str(what, refresh=False)
        if share < bar.n:
            bar.reset()
        bar.update(share - bar.n)

    global _bar
    _bar = bar
    try:
        with bar:
            yield show
    finally:
        _bar = None


def need_display() -> None:
    """Starts the program again on a virtual display when there is none."""
    if os.environ.get("DISPLAY"):
        return
    if not shutil.which("xvfb-run"):
        raise UserError("the report draws pictures: it needs a display, or the program xvfb-run (Debian: "
                        "xvfb, xauth and libgl1-mesa-dri)")
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable,
                           *sys.argv])


# --- Being asked to stop -------------------------------------------------------------------------


def catch_signals(numbers: tuple[int, ...]) -> None:
    """From now on these are remembered, and the filter that runs is asked to stop."""
    for number in numbers:
        signal.signal(number, _remember)


def _remember(number: int, _frame) -> None:
    global _stopped_by
    if _stopped_by is not None:  # asked twice: at once
        sys.exit(128 + number)
    _stopped_by = number


def stopped() -> bool:
    return _stopped_by is not None
