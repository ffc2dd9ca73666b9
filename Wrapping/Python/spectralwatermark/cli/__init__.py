# SPDX-License-Identifier: BSD-3-Clause
"""The program spectral-watermark.

    parser.py       the options, and the help
    secret.py       where the secret comes from
    tasks.py        turns parsed arguments into a task for each mesh
    processes.py    runs each task in a process of its own
    commands/       what each command does: turns a task into a result
    mesh_info.py    the statistics that info shows
    text_output.py  turns results into text
    output.py       prints results and errors
    progress.py     the progress bar
    display.py      a display to draw on

Modules that take long to import (numpy, VTK's readers) are imported once the arguments are known to be good.
"""

from __future__ import annotations

import sys
from typing import Any

from . import output
from .display import display
from .processes import StopRequests, run_each
from .progress import ProgressBar

DONE, NOT_FOUND, ERROR = 0, 1, 2


def main(arguments: list[str] | None = None) -> int:
    """Runs the program and returns its exit code: 0 done or found, 1 not found, 2 error."""
    output.print_any_name()
    stop = StopRequests()
    try:
        return _run(sys.argv[1:] if arguments is None else arguments, stop)
    except output.UserError as error:
        output.print_error(str(error))
    except KeyboardInterrupt:
        output.print_error("stopped")
    except BrokenPipeError:  # whoever read our output is gone, so there is nobody to tell
        output.discard_output()
    except Exception as error:  # noqa: BLE001 - a traceback would end with the code of "not found"
        output.print_error(output.defect(error))
    finally:
        stop.ignore()
    return ERROR


def _run(typed: list[str], stop: StopRequests) -> int:
    from .parser import parse
    from .tasks import tasks_of

    arguments = parse(typed)
    tasks = tasks_of(arguments)
    stop.listen()  # not before: Control-C ends the prompt for a secret at once
    results: list[dict[str, Any]] = []
    with display(tasks[0].draws), ProgressBar(arguments.command) as bar:

        def take(task, result: dict[str, Any]) -> None:
            bar.clear()
            output.print_result(task, result, arguments.json)
            results.append(result)

        run_each(tasks, getattr(arguments, "jobs", 1), stop, bar.show, take)
    if len(tasks) > 1:
        output.print_summary(arguments.command, results)
    return max(map(_exit_code, results))


def _exit_code(result: dict[str, Any]) -> int:
    if "error" in result:
        return ERROR
    return DONE if result.get("found", True) else NOT_FOUND
