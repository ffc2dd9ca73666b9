# SPDX-License-Identifier: BSD-3-Clause
"""The program spectral-watermark.

    parser.py     what can be typed, and the help that teaches it
    secret.py     where the secret comes from
    requests.py   from what was typed to a request for each mesh
    commands.py   what each command does to one mesh: from a request to a result
    inspection.py what info tells
    many.py       the same for many files, each in a process of its own
    words.py      results in words
    terminal.py   results as lines or JSON, progress, errors

Nothing of VTK or numpy is imported before the arguments are understood, so that --help and mistakes
answer at once.
"""

from __future__ import annotations

import signal
import sys

from . import terminal

DONE, NOT_FOUND, ERROR = 0, 1, 2


def main(arguments: list[str] | None = None) -> int:
    """Runs the program; its exit code: 0 done or found, 1 not found, 2 error."""
    from .parser import parse

    if arguments is None:
        arguments = sys.argv[1:]
    try:
        if arguments == ["worker"]:  # what --jobs starts: a request on standard input
            from .many import work

            return work()
        return _run(parse(arguments))
    except terminal.UserError as error:
        terminal.say_error(str(error))
        return ERROR
    except BrokenPipeError:  # the reader of our output went away: nobody to tell
        sys.stdout = None
        return ERROR


def _run(arguments) -> int:
    terminal.catch_signals((signal.SIGINT, signal.SIGTERM))
    from .requests import requests_of

    requests = requests_of(arguments)
    if arguments.command == "report":
        terminal.need_display()
    if len(requests) == 1:
        from .commands import run

        with terminal.progress(requests[0]) as show:
            result = run(requests[0], show)
        terminal.say(requests[0], result, arguments.json)
        return code_of(result)
    from .many import run_all

    return run_all(requests, arguments.jobs, arguments.json)


def code_of(result: dict) -> int:
    """The exit code that one mesh's result stands for."""
    if "error" in result:
        return ERROR
    return DONE if result.get("found", True) else NOT_FOUND
