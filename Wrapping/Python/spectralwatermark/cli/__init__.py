# SPDX-License-Identifier: BSD-3-Clause
"""The program spectral-watermark.

    parser.py     what can be typed, and the help that teaches it
    secret.py     where the secret comes from
    tasks.py      from what was typed to a request for each mesh
    commands/     what each command does to one mesh: from a request to a result
    mesh_info.py  what info tells
    batch.py      the same for many files, each in a process of its own
    text_output.py results in words
    terminal.py   results as lines or JSON, progress, errors

What takes long to import (numpy, VTK's readers) waits until the arguments are understood.
"""

from __future__ import annotations

import signal
import sys

from . import terminal

DONE, NOT_FOUND, ERROR = 0, 1, 2


def main(arguments: list[str] | None = None) -> int:
    """Runs the program; its exit code: 0 done or found, 1 not found, 2 error."""
    if arguments is None:
        arguments = sys.argv[1:]
    terminal.print_any_name()
    try:
        if arguments == ["worker"]:  # what --jobs starts: a request on standard input
            from .batch import work

            return work()
        return _run(arguments)
    except terminal.UserError as error:
        terminal.say_error(str(error))
    except KeyboardInterrupt:
        terminal.say_error("stopped")
    except BrokenPipeError:  # the reader of our output went away: nobody to tell
        terminal.forget_output()
    except Exception as error:  # noqa: BLE001 - a traceback would end with the code of "not found"
        terminal.say_error(f"{type(error).__name__}: {error}; please report this")
    finally:
        terminal.stop_listening()
    return ERROR


def _run(typed: list[str]) -> int:
    from .parser import parse
    from .tasks import requests_of

    arguments = parse(typed)
    requests = requests_of(arguments)
    # Only now: a prompt for the secret ends at once.
    terminal.catch_signals((signal.SIGINT, signal.SIGTERM, signal.SIGHUP))
    if len(requests) > 1:
        from .batch import run_all

        return run_all(requests, arguments.jobs, arguments.json)
    with terminal.display(arguments.command == "report"):
        return terminal.in_child(requests[0], lambda: _run_one(requests[0], arguments.json), ERROR)


def _run_one(request: dict, as_json: bool) -> int:
    from .commands import run

    with terminal.progress(request) as show:
        result = run(request, show)
    terminal.say(request, result, as_json)
    return code_of(result)


def code_of(result: dict) -> int:
    """The exit code that one mesh's result stands for."""
    if "error" in result:
        return ERROR
    return DONE if result.get("found", True) else NOT_FOUND
