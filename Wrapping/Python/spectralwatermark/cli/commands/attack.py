# SPDX-License-Identifier: BSD-3-Clause
"""Applies attacks, one after the other."""

from __future__ import annotations

from typing import TypedDict

from spectralwatermark.attacks import ATTACKS
from spectralwatermark.io import check_writable, read_mesh, stores_float, write_mesh

from ..tasks import Attack
from .filters import FilterRunner


class Result(TypedDict):
    output: str
    steps: list[str]
    points_before: int
    points: int


def run(task: Attack, filters: FilterRunner) -> Result:
    check_writable(task.output)
    stores_float(task.output)  # raises for a format that cannot be written
    mesh = read_mesh(task.input)
    before = mesh.GetNumberOfPoints()
    for number, (name, value) in enumerate(task.steps):
        attack = ATTACKS[name].on(mesh, value, task.seed + number)
        filters.update(attack, name)
        mesh = attack.GetOutput()
    write_mesh(mesh, task.output, task.force)
    return {"output": task.output, "steps": [name for name, _ in task.steps], "points_before": before,
            "points": mesh.GetNumberOfPoints()}
