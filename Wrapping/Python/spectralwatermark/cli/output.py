# SPDX-License-Identifier: BSD-3-Clause
"""Prints results on standard output, and errors and the summary on standard error."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .tasks import Task

PROGRAM = "spectral-watermark"


class UserError(Exception):
    """Ends the program, or one task, with exit code 2. The text is one line that says what to do."""


def defect(error: BaseException) -> str:
    """The text for an exception that nobody expected."""
    return f"{type(error).__name__}: {error}; please report this"


def print_result(task: Task, result: dict[str, Any], as_json: bool) -> None:
    """Prints one mesh's result; an error goes to standard error as well."""
    if as_json:
        import json

        print_text(json.dumps(result))
    if "error" in result:
        print_error(result["error"])
    elif not as_json:
        from .text_output import lines_of

        print_text("\n".join(lines_of(task, result)))


def print_summary(command: str, results: list[dict[str, Any]]) -> None:
    from .text_output import summary_of

    print(summary_of(command, results), file=sys.stderr, flush=True)


def print_error(text: str) -> None:
    print(f"{PROGRAM}: {' '.join(text.split())}", file=sys.stderr, flush=True)


def print_text(text: str) -> None:
    """Prints at once; raises UserError when the text cannot be written, as on a full disk."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        discard_output()
        raise UserError(f"the output cannot be written: {error.strerror}") from error


def print_any_name() -> None:
    """File names may be any bytes; they are printed as those bytes."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="surrogateescape")


def discard_output() -> None:
    """Keeps the interpreter from failing at its end on output that nobody takes."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
