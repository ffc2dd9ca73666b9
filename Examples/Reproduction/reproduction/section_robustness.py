# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of the section "Robustness": the paper's claims, and all attacks."""

from __future__ import annotations

from pathlib import Path

from . import results
from .experiments import ATTACK, MODE, MODES, UNATTACKED, Mode
from .files import write_csv
from .models import Model
from .plan import ATTACKED_MESSAGES, Plan
from .results import Robustness
from .spectra import BITS
from .store import Store

CHANCE = BITS / 2.0  # mean number of wrong bits when nothing is left of a mark


def facts(plan: Plan, store: Store, folder: Path) -> dict:
    """What the section's template prints; the tables are also written as files."""
    _write_single(plan, store, folder)
    models = [*plan.robustness_models(), *results.large_models(plan)]
    return {
        "claims": _claims(plan, store), "by_mode": _by_mode(plan, store, folder), "models": models,
        "by_mesh": {_title(attack): [results.robustness(plan, store, [model], MODES[0], attack)
                                     for model in models] for attack in plan.attacks},
        "most_messages": ATTACKED_MESSAGES,
    }


def _claims(plan: Plan, store: Store) -> list[tuple]:
    """Each of the paper's claims with its result on the paper's model and on all meshes."""
    rows = []
    for claim, result in results.claims(plan, store):
        same = [model for model in plan.models if model.name == claim.model]
        rows.append((claim, results.robustness(plan, store, same, MODE[claim.mode], claim.attack),
                     result))
    return rows


def verdict_of(result: Robustness) -> str:
    share = result.share_read()
    if share == 1.0:
        return "holds"
    if share >= 0.9:
        return "holds nearly always"
    return "holds sometimes" if share >= 0.1 else "does not hold"


def _by_mode(plan: Plan, store: Store, folder: Path) -> dict[str, list[Robustness]]:
    """For each attack, a result for each mode."""
    found, rows = {}, []
    for attack in (UNATTACKED, *plan.attacks):
        columns = [results.robustness(plan, store, plan.robustness_models(), mode, attack)
                   for mode in MODES]
        found[_title(attack)] = columns
        rows += [[mode.key, attack, len(result.errors), result.mean(), result.share_read()]
                 for mode, result in zip(MODES, columns) if result.errors]
    write_csv(folder / "robustness-by-mode.csv",
              ["mode", "attack", "marks", "mean_bit_errors", "share_without_error"], rows)
    return found


def _title(attack: str) -> str:
    return "no attack" if attack == UNATTACKED else ATTACK[attack].title


def _write_single(plan: Plan, store: Store, folder: Path) -> None:
    rows = []
    for mode in MODES:
        for model in plan.models:
            rows += _rows_of(plan, store, mode, model)
    write_csv(folder / "robustness.csv",
              ["mesh", "mode", "attack", "marks", "mean_bit_errors", "share_without_error"], rows)


def _rows_of(plan: Plan, store: Store, mode: Mode, model: Model) -> list[list[object]]:
    rows = []
    for attack in plan.attacks:
        result = results.robustness(plan, store, [model], mode, attack)
        if result.errors:
            rows.append([model.name, mode.key, attack, len(result.errors), result.mean(),
                         result.share_read()])
    return rows
