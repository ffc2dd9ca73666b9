# SPDX-License-Identifier: BSD-3-Clause
"""Section 3.1: the time for the harmonics of a mesh, measured before anything else runs."""

from __future__ import annotations

import time

from spectralwatermark import vtkManifoldHarmonics, vtkMeshAttack
from spectralwatermark.io import MeshFileError, read_mesh
from spectralwatermark.execution import FilterError, update
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import paper
from .models import Model
from .plan import Plan
from .store import Store, key_of
from .work import Failure

HARMONICS = 100
REPEATS = 2  # the faster run counts, because caches and other processes slow down the other


def measure(plan: Plan, store: Store) -> list[Failure]:
    failures = []
    for model, reduced in timed_models(plan):
        key = timing_key(model, reduced)
        if key in store:
            continue
        try:
            store.put(key, _measure(model, reduced))
        except (FilterError, MeshFileError) as error:
            failures.append(Failure(model.name, "timing", str(error)))
    return failures


def timing_key(model: Model, reduced: bool) -> str:
    return key_of("timing", model, "20000" if reduced else "whole")


def timed_models(plan: Plan) -> list[tuple[Model, bool]]:
    """The meshes nearest to the paper's size, and one that is simplified to exactly that size."""
    def distance(model: Model) -> int:
        return abs(model.vertices - paper.VERTICES_IN_A_MINUTE)

    nearest = sorted(plan.models, key=distance)[:2 if plan.quick else 5]
    timed = [(model, False) for model in sorted(nearest, key=lambda model: model.vertices)]
    larger = [model for model in plan.all_models
              if model.vertices > 1.2 * paper.VERTICES_IN_A_MINUTE]
    if larger:
        bunny = [model for model in larger if model.name == "bunny"]
        timed.append(((bunny or larger)[0], True))
    return timed


def _measure(model: Model, reduced: bool) -> dict:
    mesh = read_mesh(model.path)
    if reduced:
        mesh = _simplified(mesh, paper.VERTICES_IN_A_MINUTE)
    fastest = float("inf")
    for _ in range(REPEATS):
        harmonics = vtkManifoldHarmonics()
        harmonics.SetInputData(mesh)
        harmonics.SetNumberOfHarmonics(HARMONICS)
        started = time.perf_counter()
        update(harmonics)
        fastest = min(fastest, time.perf_counter() - started)
    return {"vertices": mesh.GetNumberOfPoints(), "seconds": fastest}


def _simplified(mesh: vtkPolyData, vertices: int) -> vtkPolyData:
    simplify = vtkMeshAttack()
    simplify.SetInputData(mesh)
    simplify.SetAttackToSimplification()
    simplify.SetSimplificationPercent(100.0 * (1.0 - vertices / mesh.GetNumberOfPoints()))
    update(simplify)
    return simplify.GetOutput()
