# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of the section "Tables 1 to 4", and of the table of times."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import paper, results, timing
from .experiments import MODES, Mode
from .files import write_csv
from .plan import Plan
from .results import EmbeddingRow, Spread
from .store import Store


@dataclass(frozen=True)
class Table:
    """One of the paper's tables with our numbers."""

    mode: Mode
    rows: list[EmbeddingRow]
    medians: dict[str, float | None]
    papers_medians: dict[str, float]
    others: dict[str, paper.Row]  # the paper's models that are not among ours


def tables(plan: Plan, store: Store, folder: Path) -> list[Table]:
    """All four, also written as files."""
    _write_marks(plan, store, folder)
    return [_table(plan, store, mode, folder) for mode in MODES]


def _table(plan: Plan, store: Store, mode: Mode, folder: Path) -> Table:
    rows = results.embedding_rows(plan, store, mode)
    _write_table(mode, rows, folder)
    names = ("iterations", "geometric", "curvature")
    return Table(mode, rows, {name: median_of(rows, name) for name in names},
                 {name: papers_median(mode, name) for name in names}, _others(mode, rows))


def _others(mode: Mode, rows: list[EmbeddingRow]) -> dict[str, paper.Row]:
    ours = {row.model.name.capitalize() for row in rows}
    return {name: row for name, row in paper.TABLES[mode.key].items() if name not in ours}


def median_of(rows: list[EmbeddingRow], name: str) -> float | None:
    """The median of the meshes' means."""
    values = [getattr(row, name).mean for row in rows if getattr(row, name) is not None]
    return float(np.median(values)) if values else None


def papers_median(mode: Mode, name: str) -> float:
    return float(np.median([getattr(row, name) for row in paper.TABLES[mode.key].values()]))


def _write_table(mode: Mode, rows: list[EmbeddingRow], folder: Path) -> None:
    def numbers(value: Spread | None) -> list[object]:
        if value is None:
            return ["", ""]
        return [value.mean, "" if value.deviation is None else value.deviation]

    ours = [[row.model.name, row.model.vertices, row.marks, row.converged,
             *numbers(row.iterations), *numbers(row.geometric), *numbers(row.curvature),
             " ".join(str(bits) for bits in row.bits_right_otherwise),
             *(row.printed or ["", "", ""])] for row in rows]
    theirs = [[name, *[""] * 10, *printed] for name, printed in _others(mode, rows).items()]
    write_csv(
        folder / f"table-{mode.table}.csv",
        ["mesh", "vertices", "marks", "read", "iterations", "iterations_deviation",
         "geomdiff_percent", "geomdiff_deviation", "curvdiff_percent", "curvdiff_deviation",
         "bits_right_otherwise", "paper_iterations", "paper_geomdiff_percent",
         "paper_curvdiff_percent"], ours + theirs)


def _write_marks(plan: Plan, store: Store, folder: Path) -> None:
    rows = []
    for mode in MODES:
        for model in plan.models:
            for message, mark in results.marks_of(plan, store, model, mode).items():
                rows.append([model.name, mode.key, message, int(mark["converged"]),
                             mark["iterations"], mark["geometric"], mark["curvature"],
                             mark["read"], mark["errors"], mark["first"]])
    write_csv(folder / "marks.csv",
              ["mesh", "mode", "message", "converged", "iterations", "geomdiff_percent",
               "curvdiff_percent", "read", "bit_errors", "first_component"], rows)


# --- Timing ------------------------------------------------------------------------------------


def timings(plan: Plan, store: Store, folder: Path) -> list[tuple[str, dict]]:
    """Records by name, the smallest mesh first; also written as a file."""
    rows = []
    for model, reduced in timing.timed_models(plan):
        record = store.get(timing.timing_key(model, reduced))
        if record is not None:
            rows.append((f"{model.name}, simplified" if reduced else model.name, record))
    rows.sort(key=lambda row: row[1]["vertices"])
    write_csv(folder / "timing.csv", ["mesh", "vertices", "harmonics", "seconds"],
              [[name, record["vertices"], timing.HARMONICS, round(record["seconds"], 3)]
               for name, record in rows])
    return rows
