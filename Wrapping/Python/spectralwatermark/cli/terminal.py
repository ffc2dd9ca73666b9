# SPDX-License-Identifier: BSD-3-Clause
"""What the program says: results on standard output, all else on standard error."""

from __future__ import annotations

import ctypes
import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

PROGRAM = "spectral-watermark"

_times_stopped = 0
_caught: tuple[int, ...] = ()  # the signals that ask to stop
_child: int | None = None  # the process that works
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
        import json

        print_text(json.dumps(result))
    if "error" in result:
        say_error(result["error"])
    elif not as_json:
        from .text_output import lines_of

        print_text("\n".join(lines_of(request, result)))


def print_text(text: str) -> None:
    """On standard output, at once; raises UserError when it is not taken."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:  # a full disk, say
        forget_output()
        raise UserError(f"the output cannot be written: {error.strerror}") from error


def print_any_name() -> None:
    """File names may be any bytes; what is printed of them is those bytes."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="surrogateescape")


def forget_output() -> None:
    """So that the interpreter does not complain at its end of output that nobody takes."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


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


# --- Something to draw on ------------------------------------------------------------------------


@contextmanager
def display(needed: bool) -> Iterator[None]:
    """A virtual display when one is needed and there is none."""
    if not needed or _display_works():
        yield
        return
    import shutil
    import subprocess

    if not shutil.which("Xvfb"):
        raise UserError("the report draws pictures: it needs a display, or a virtual one (Debian: xvfb and "
                        "libgl1-mesa-dri)")
    read, write = os.pipe()
    with subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-noreset", "-nolisten",
             "tcp"], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            start_new_session=True) as server:
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


# --- Being asked to stop -------------------------------------------------------------------------


def catch_signals(numbers: tuple[int, ...]) -> None:
    """From now on these are remembered: stopped() tells. A filter runs on until it reports progress, and no
    Python code before."""
    global _caught
    _caught = numbers
    for number in numbers:
        signal.signal(number, _remember)


def _remember(_number: int, _frame) -> None:
    global _times_stopped
    _times_stopped += 1
    if _child is not None:  # asked twice: at once
        os.kill(_child, signal.SIGTERM if _times_stopped == 1 else signal.SIGKILL)


def why_it_ended(code: int) -> str:
    """What is said of a process whose work did not come to an end."""
    if stopped():
        return "not done: stopped"
    if code == -signal.SIGKILL:
        return "not done: killed, as the system does when memory runs out; close other programs"
    return f"the process that read it ended with {code}; is the file damaged?"


def in_child(request: dict, work: Callable[[], int], error: int) -> int:
    """work()'s code, of a process of its own: this one can then be stopped whatever a filter does, and a
    reader that crashes on a damaged file takes nothing down."""
    global _child
    sys.stdout.flush()
    pid = os.fork()
    if pid == 0:
        _end(work)
    _child = pid
    if _times_stopped:
        os.kill(pid, signal.SIGTERM)
    _, status = os.waitpid(pid, 0)
    _child = None
    code = os.waitstatus_to_exitcode(status)
    if code < 0:
        say_error(f"{request['input']}: {why_it_ended(code)}")
        return error
    return code


def _end(work: Callable[[], int]) -> None:
    """The child's way: what a terminal sends to both is the parent's to answer."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    end_with_parent()
    code = 2
    try:
        code = work()
        sys.stdout.flush()
    except BrokenPipeError:
        pass
    except UserError as error:
        say_error(str(error))
    except BaseException as error:  # noqa: BLE001 - a traceback would end with the code of "not found"
        say_error(f"{type(error).__name__}: {error}; please report this")
    finally:
        gc.collect()  # VTK's windows, before what they are on
        os._exit(code)


def end_with_parent() -> None:
    """Linux sends SIGTERM when the parent dies, however it does."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)


def stop_listening() -> None:
    """At the end: the interpreter gives up its handlers, and would die of a second request to stop."""
    for number in _caught:
        signal.signal(number, signal.SIG_IGN)


def stopped() -> bool:
    return _times_stopped > 0


def stopped_twice() -> bool:
    return _times_stopped > 1
