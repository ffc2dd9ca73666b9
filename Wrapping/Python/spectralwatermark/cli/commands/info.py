# SPDX-License-Identifier: BSD-3-Clause
"""Shows a mesh's statistics, and how many bits it can hold."""

from __future__ import annotations

from typing import NotRequired

from ..mesh_info import Statistics, capacity_of, describe
from ..tasks import Info
from .filters import FilterRunner, read_valid_mesh


class Result(Statistics):
    capacity_bits: NotRequired[int]
    at_distortion_percent: NotRequired[float]


def run(task: Info, filters: FilterRunner) -> Result:
    mesh = read_valid_mesh(task.input)
    result: Result = {**describe(mesh)}
    if task.capacity:
        result |= {"capacity_bits": capacity_of(mesh, task.distortion, lambda each: filters.update(each, "measuring")),
                   "at_distortion_percent": task.distortion}
    return result
