# SPDX-License-Identifier: BSD-3-Clause
"""Tasks over processes, with one progress bar for all of them."""

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
    """A process died without a word: most likely the memory was not enough."""


@dataclass(frozen=True)
class Task:
    """A call that returns a record for each of its keys."""

    function: Callable[..., list[dict]]
    arguments: tuple
    keys: tuple[str, ...]
    model: Model
    title: str  # what the page says when it fails
    cost: float  # in vertices of an average eigenproblem


@dataclass(frozen=True)
class Failure:
    """A task that came to nothing, with what the filter said."""

    model: str
    title: str
    message: str


def by_message(failures: Sequence[Failure]) -> dict[tuple[str, str], list[str]]:
    """What failed, by model and message: one unsuitable mesh fails everywhere for one reason."""
    grouped: dict[tuple[str, str], list[str]] = {}
    for failure in failures:
        grouped.setdefault((failure.model, failure.message), []).append(failure.title)
    return grouped


def run_tasks(tasks: Sequence[Task], store: Store, jobs: int) -> list[Failure]:
    """Runs what the store does not have yet, dear tasks first; records go to the store as they
    come."""
    # One thread each: as many processes as processors run anyway, and sums keep their order.
    for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "VTK_SMP_MAX_THREADS"):
        os.environ.setdefault(variable, "1")
    # Meshes with many vertices first, and the tasks of a mesh together: they share its basis.
    ordered = sorted(tasks, key=lambda task: (-task.model.vertices, task.model.name, -task.cost,
                                              task.keys))
    failures: list[Failure] = []
    if not ordered:
        return failures
    # Fresh processes: the display connection and VTK's globals are not made to be forked.
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
            raise WorkerLost("a worker process died, perhaps for want of memory; run again to go "
                             "on, with fewer --jobs") from error
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            for worker in multiprocessing.active_children():
                worker.terminate()  # not minutes later, when it is through with a large mesh
            raise
    return sorted(failures, key=lambda failure: (failure.model, failure.title))


def _ignore_interrupts() -> None:
    """Control-C reaches all processes of a terminal; the main one ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _attempt(task: Task) -> tuple[list[dict], str]:
    """Runs in a worker. One mesh that fails must not end the computation of all others."""
    try:
        return task.function(*task.arguments), ""
    except (FilterError, MeshFileError) as error:
        return [], str(error)
    except Exception as error:  # noqa: BLE001 - reported on the page, with its kind
        return [], f"{type(error).__name__}: {error}"


class Progress:
    """A bar with the time left on a terminal, a line every tenth elsewhere."""

    def __init__(self, total: float) -> None:
        self._terminal = sys.stdout.isatty()
        self._total = max(total, 1e-9)
        self._done = 0.0
        self._said = 0
        self._bar = tqdm(total=self._total, ncols=90, file=sys.stdout, disable=not self._terminal,
                         smoothing=0.0,  # the mean rate: tasks differ too much for the last ones'
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
        """The estimate also moves while a large mesh is being worked on."""
        if self._terminal:
            self._bar.refresh()
