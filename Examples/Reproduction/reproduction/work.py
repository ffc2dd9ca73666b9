# SPDX-License-Identifier: BSD-3-Clause
"""Distributes tasks over processes, with one progress bar for all of them."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass

from spectralwatermark.io import MeshFileError
from spectralwatermark.execution import FilterError
from tqdm import tqdm

from .models import Model
from .store import Store


class WorkerLost(Exception):
    """A worker process died without a message, most likely for lack of memory."""


@dataclass(frozen=True)
class Task:
    """A call that returns a record for each of its keys."""

    function: Callable[..., list[dict]]
    arguments: tuple
    keys: tuple[str, ...]
    model: Model
    title: str  # the page names a failed task by it
    cost: float  # estimate, in vertices of an average eigenproblem


@dataclass(frozen=True)
class Failure:
    """A failed task with the filter's message."""

    model: str
    title: str
    message: str


def by_message(failures: Sequence[Failure]) -> dict[tuple[str, str], list[str]]:
    """Titles of failed tasks by model and message, since many share both."""
    grouped: dict[tuple[str, str], list[str]] = {}
    for failure in failures:
        grouped.setdefault((failure.model, failure.message), []).append(failure.title)
    return grouped


def run_tasks(tasks: Sequence[Task], store: Store, jobs: int) -> list[Failure]:
    """Runs the tasks, expensive ones first, and stores each record as soon as it arrives."""
    # One thread each: there are as many processes as processors, and sums keep their order.
    for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "VTK_SMP_MAX_THREADS"):
        os.environ.setdefault(variable, "1")
    # Meshes with many vertices come first; the tasks of a mesh come together and share its basis.
    ordered = sorted(tasks, key=lambda task: (-task.model.vertices, task.model.name, -task.cost,
                                              task.keys))
    failures: list[Failure] = []
    if not ordered:
        return failures
    # Spawned processes: the display connection and VTK's globals do not survive a fork.
    context = multiprocessing.get_context("spawn")
    with Progress(sum(task.cost for task in ordered)) as progress, \
            ProcessPoolExecutor(jobs, mp_context=context, initializer=_ignore_interrupts) as pool:
        running: dict[Future, Task] = {pool.submit(_attempt, task): task for task in ordered}
        try:
            while running:
                done, _ = wait(running, timeout=1.0, return_when=FIRST_COMPLETED)
                for future in done:
                    task = running.pop(future)
                    records, complaint = future.result()
                    for key, record in zip(task.keys, records):
                        store.put(key, record)
                    if complaint:
                        failures.append(Failure(task.model.name, task.title, complaint))
                    progress.advance(task.cost)
                progress.refresh()
        except BrokenProcessPool as error:
            raise WorkerLost("a worker process died, perhaps for lack of memory; run again with "
                             "fewer --jobs to resume") from error
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in multiprocessing.active_children():
                worker.terminate()  # or it would first finish its mesh, which can take minutes
            raise
    return sorted(failures, key=lambda failure: (failure.model, failure.title))


def _ignore_interrupts() -> None:
    """Control-C reaches all processes of a terminal; the main process ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _attempt(task: Task) -> tuple[list[dict], str]:
    """Runs a task in a worker. A failing mesh must not end the computation of all others."""
    try:
        return task.function(*task.arguments), ""
    except (FilterError, MeshFileError) as error:
        return [], str(error)
    except Exception as error:  # noqa: BLE001 - reported on the page, with its kind
        return [], f"{type(error).__name__}: {error}"


class Progress:
    """On a terminal a bar with the time left, elsewhere a line for every tenth."""

    def __init__(self, total: float) -> None:
        self._terminal = sys.stdout.isatty()
        self._total = max(total, 1e-9)
        self._done = 0.0
        self._said = 0
        self._bar = tqdm(total=self._total, ncols=90, file=sys.stdout, disable=not self._terminal,
                         smoothing=0.0,  # the mean rate, because tasks differ too much for a recent one
                         bar_format="Experiments {percentage:5.1f}% |{bar}| {elapsed} so far, "
                                    "{remaining} left")

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *_details: object) -> None:
        self._bar.close()

    def advance(self, cost: float) -> None:
        self._done += cost
        self._bar.update(min(cost, self._total - self._bar.n))
        tenths = int(10.0 * self._done / self._total + 1e-9)
        if not self._terminal and tenths > self._said:
            self._said = tenths
            print(f"  {10 * tenths:3d} %", flush=True)

    def refresh(self) -> None:
        """Updates the estimate while a large mesh is being processed."""
        if self._terminal:
            self._bar.refresh()
