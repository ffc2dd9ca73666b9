# SPDX-License-Identifier: BSD-3-Clause
"""Marks, attacks and reads in one process for each marked mesh; skips results that already exist."""

from __future__ import annotations

import argparse
import multiprocessing
import queue
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
from tqdm import tqdm
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkPolyData

from attacks import ATTACKS
from results import Mark, Outcome, append_row, read_rows
from schemes import SCHEMES, Marked
from spectralwatermark import vtkMeshDistortion
from spectralwatermark.io import read_mesh

Group = tuple[str, str, str]  # scheme, mesh, key: one marked mesh
Case = tuple[str, str]  # attack, strength

rows: multiprocessing.Queue  # in a worker: takes results to the process that writes them


def start_worker(to_writer: multiprocessing.Queue) -> None:
    global rows  # pylint: disable=global-statement
    rows = to_writer
    vtkSMPTools.Initialize(1)  # one thread for each mesh


def displacement(original: vtkPolyData, marked: vtkPolyData) -> float:
    before, after = (vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
                     for mesh in (original, marked))
    return 100.0 * float(np.sqrt(((after - before) ** 2).sum(axis=1).mean())) / original.GetLength()


def measure(group: Group, original: vtkPolyData, marked: Marked, seconds: float) -> Mark:
    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, original)
    distortion.SetInputData(1, marked.mesh)
    distortion.Update()
    return Mark(*group, int(marked.converged), seconds, displacement(original, marked.mesh),
                100.0 * distortion.GetMRMS(), 100.0 * distortion.GetHausdorff(),
                distortion.GetMSDM(), distortion.GetMSDM2())


def run_group(folder: Path, group: Group, is_measured: bool, cases: list[Case]) -> None:
    name, mesh, key = group
    scheme = next(scheme for scheme in SCHEMES if scheme.name == name)
    original = read_mesh(folder / f"{mesh}.ply")
    start = time.perf_counter()
    marked = scheme.mark(original, key)
    if not is_measured:
        rows.put(measure(group, original, marked, time.perf_counter() - start))
    for attack, strength in cases:
        attacked = next(a for a in ATTACKS if a.name == attack).apply(marked.mesh, strength)
        start = time.perf_counter()
        reading = scheme.read(attacked, key)
        rows.put(Outcome(*group, attack, strength, reading.bit_error_rate, reading.p_value,
                         int(reading.valid), time.perf_counter() - start))


def groups_of(arguments: argparse.Namespace) -> Iterator[Group]:
    for key in range(1, arguments.keys + 1):
        for mesh in arguments.meshes:
            for scheme in arguments.schemes:
                yield scheme, mesh, str(key)


def run(arguments: argparse.Namespace) -> None:
    arguments.output.mkdir(parents=True, exist_ok=True)
    files = {Mark: arguments.output / "marks.csv", Outcome: arguments.output / "outcomes.csv"}
    measured = {(m.scheme, m.mesh, m.key) for m in read_rows(files[Mark], Mark)}
    done = {(o.scheme, o.mesh, o.key, o.attack, o.strength) for o in read_rows(files[Outcome], Outcome)}
    work = []
    for group in groups_of(arguments):
        cases = [(attack.name, strength) for attack in ATTACKS for strength in attack.strengths
                 if (*group, attack.name, strength) not in done]
        if cases or group not in measured:
            work.append((group, group in measured, cases))
    arrived = multiprocessing.get_context("spawn").Queue()
    with tqdm(total=sum(len(cases) for _, _, cases in work), unit="attack") as bar, \
            ProcessPoolExecutor(arguments.jobs, multiprocessing.get_context("spawn"), start_worker,
                                (arrived,)) as pool:
        tasks = {pool.submit(run_group, arguments.meshes_folder, *task): task[0] for task in work}
        while not (all(task.done() for task in tasks) and arrived.empty()):
            try:
                row = arrived.get(timeout=0.5)
            except queue.Empty:
                continue
            append_row(files[type(row)], row)
            bar.update(isinstance(row, Outcome))
        for task, group in tasks.items():
            if task.exception():
                tqdm.write(f"{', '.join(group)}: {task.exception()}")
