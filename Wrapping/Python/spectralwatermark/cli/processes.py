# SPDX-License-Identifier: BSD-3-Clause
"""Runs each task in a process of its own.

A process can be stopped whatever a filter does, and a reader that crashes on a damaged file takes nothing else down.
The processes are forked while this one has a single thread and has read nothing yet, so that a task, with its secret,
appears in no argument list and no environment. (concurrent.futures gives up all tasks when one process crashes.)
"""

from __future__ import annotations

import ctypes
import multiprocessing
import signal
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Any

from .output import defect

if TYPE_CHECKING:
    from .tasks import Task

Result = dict[str, Any]

SECONDS_BETWEEN_LOOKS = 0.2


class StopRequests:
    """Counts the requests to stop: Control-C, kill, and a terminal that is closed.

    Signals only count, because a filter runs no Python code until it reports progress.
    """

    SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

    def __init__(self) -> None:
        self._count = 0
        self._listens = False

    def listen(self) -> None:
        self._listens = True
        for number in self.SIGNALS:
            signal.signal(number, self._remember)

    def ignore(self) -> None:
        """For the end of the program: the interpreter removes its handlers, and a further request would kill it."""
        if self._listens:
            for number in self.SIGNALS:
                signal.signal(number, signal.SIG_IGN)

    def _remember(self, _number: int, _frame) -> None:
        self._count += 1

    def made(self) -> bool:
        return self._count > 0

    def made_twice(self) -> bool:
        return self._count > 1


def run_each(tasks: list[Task], jobs: int, stop: StopRequests, show: Callable[[float, str], None],
             take: Callable[[Task, Result], None]) -> None:
    """Runs up to `jobs` tasks at once and gives each result to take(), in the order of the tasks."""
    children = [_Child(task) for task in tasks]
    waiting = deque(children)
    taken = 0
    try:
        while taken < len(children):
            if stop.made():
                _stop(children, waiting, at_once=stop.made_twice())
            while waiting and sum(child.runs for child in children) < jobs:
                waiting.popleft().start(stop)
            _listen([child for child in children if child.runs], stop)
            while taken < len(children) and children[taken].result is not None:
                take(children[taken].task, children[taken].result)
                taken += 1
            _show_progress(children, show)
    except BaseException:  # nobody takes the results any more
        _stop(children, waiting, at_once=False)
        for child in children:
            child.join()
        raise


def _stop(children: list[_Child], waiting: deque[_Child], at_once: bool) -> None:
    while waiting:
        waiting.popleft().cancel()
    for child in children:
        child.stop(at_once)


def _listen(running: list[_Child], stop: StopRequests) -> None:
    by_connection = {child.connection: child for child in running}
    for connection in wait(list(by_connection), timeout=SECONDS_BETWEEN_LOOKS) if running else ():
        by_connection[connection].receive(stop)


def _show_progress(children: list[_Child], show: Callable[[float, str], None]) -> None:
    if len(children) == 1:
        show(*children[0].progress)
    else:
        done = sum(child.result is not None for child in children)
        show(done / len(children), f"{done} of {len(children)} files")


class _Child:
    """One task, the process that works on it, and what that process has reported."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.progress = (0.0, task.command)
        self.result: Result | None = None
        self.connection: Connection | None = None
        self._process: multiprocessing.process.BaseProcess | None = None
        self._told_to_stop = False

    @property
    def runs(self) -> bool:
        return self.connection is not None

    def start(self, stop: StopRequests) -> None:
        self.result = self.task.result_without_work()
        if self.result is not None:
            return
        context = multiprocessing.get_context("fork")
        self.connection, end = context.Pipe(duplex=False)
        self._process = context.Process(target=_work, args=(self.task, end, stop))
        self._process.start()
        end.close()  # or its end would never be seen

    def receive(self, stop: StopRequests) -> None:
        """Takes one message: the result, progress, or the end without a result."""
        try:
            message = self.connection.recv()
        except (EOFError, OSError):
            self._process.join()
            message = self._error(_why_it_ended(self._process.exitcode, stop.made()))
        if isinstance(message, tuple):
            self.progress = message
            return
        self.result = message
        self._process.join()
        self.connection.close()
        self.connection = None

    def cancel(self) -> None:
        self.result = self._error("not done: stopped")

    def stop(self, at_once: bool) -> None:
        if not self.runs:
            return
        if at_once:
            self._process.kill()
        elif not self._told_to_stop:
            self._process.terminate()
        self._told_to_stop = True

    def join(self) -> None:
        if self.runs:
            self.connection.close()
            self._process.join()

    def _error(self, text: str) -> Result:
        return {"file": self.task.input, "error": f"{self.task.input}: {text}"}


def _why_it_ended(code: int, stopped: bool) -> str:
    if stopped:
        return "not done: stopped"
    if code == -signal.SIGKILL:
        return "not done: killed, as the system does when memory runs out; close other programs"
    return f"the process that read it ended with {code}; is the file damaged?"


def _work(task: Task, connection: Connection, stop: StopRequests) -> None:
    """Runs in the child."""
    # A terminal signals all processes; only the parent answers, and sends SIGTERM.
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    end_with_parent()

    def show(share: float, what: str) -> None:
        with suppress(BrokenPipeError):  # the parent is gone, and a request to stop is on its way
            connection.send((share, what))

    try:
        from . import commands
        from .commands.filters import FilterRunner

        result = commands.run(task, FilterRunner(show, stop.made))
    except BaseException as error:  # noqa: BLE001 - the parent prints it
        result = {"file": task.input, "error": defect(error)}
    with suppress(BrokenPipeError):
        connection.send(result)


def end_with_parent() -> None:
    """Has Linux send SIGTERM to this process when its parent ends, however it does."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)
