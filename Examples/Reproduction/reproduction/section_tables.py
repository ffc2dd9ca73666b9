# SPDX-License-Identifier: BSD-3-Clause
"""Section "Tables 1 to 4", and the table of the timing."""

from __future__ import annotations

from html import escape
from pathlib import Path

import numpy as np

from spectralwatermark.report.html import Cell, Line, table

from . import paper, results, timing
from .experiments import MODES, Mode
from .files import write_csv
from .plan import Plan
from .results import EmbeddingRow, Spread
from .spectra import BITS
from .store import Store

NOTHING = Cell("–", "soft")


def write(plan: Plan, store: Store, folder: Path) -> str:
    _write_marks(plan, store, folder)
    parts = [f"""
<h2 id="tables">Tables 1 to 4: iterations and distortion</h2>
<p>Each mesh is marked with {_count(len(plan.messages))} of five bits, each on a fresh copy, in each
of the four modes. <b>Read</b> counts those that the blind detector reads back from the marked
mesh, of all that were tried; iterations and differences are means over these, ± one standard
deviation over the messages. Where a message could not be embedded in 20 iterations,
<b>otherwise right</b> says how many of its bits the best mesh reads. All differences are percent of
the bounding-box diagonal of the original mesh. Every single mark:
<a href="marks.csv">marks.csv</a>.</p>
<p>The paper's models of the same name stand in the same line. They are the same scans, but perhaps
not in the same resolution, and the paper does not give its messages: equal to the last digit they
cannot be. Its other models are not public here and follow below ours.</p>"""]
    for mode in MODES:
        parts.append(_table(plan, store, mode, folder))
    return "\n".join(parts)


def _count(messages: int) -> str:
    return "one random message" if messages == 1 else f"{messages} random messages"


def _table(plan: Plan, store: Store, mode: Mode, folder: Path) -> str:
    rows = results.embedding_rows(plan, store, mode)
    _write_table(mode, rows, folder)
    named = {row.model.name.capitalize() for row in rows}
    lines: list[Line] = [Line(_cells(row)) for row in rows]
    lines.append(_medians(mode, rows))
    lines += [Line([escape(name), *[""] * 6, *_printed(printed)], "rest")
              for name, printed in paper.TABLES[mode.key].items() if name not in named]
    headers = [
        ["", "", Cell("here", "group", span=5), Cell("the paper", "group", span=3)],
        ["mesh", "vertices", "read", "iterations", "GeomDiff %", "CurvDiff %", "otherwise right",
         "iterations", "GeomDiff %", "CurvDiff %"]]
    return (f'<h3 id="table-{mode.table}">Table {mode.table}: {mode.title.lower()}</h3>' +
            table(headers, lines, [f"table-{mode.table}.csv"]))


def _cells(row: EmbeddingRow) -> list[Cell | str]:
    lost = ", ".join(str(bits) for bits in row.bits_right_otherwise)
    return [escape(row.model.name), f"{row.model.vertices:,}",
            Cell(f"{row.converged} of {row.marks}", "" if row.converged == row.marks else "bad"),
            _spread(row.iterations, 1), _spread(row.geometric, 3), _spread(row.curvature, 4),
            Cell(f"{lost} of {BITS}") if lost else NOTHING, *_printed(row.printed)]


def _spread(value: Spread | None, digits: int) -> Cell | str:
    if value is None:
        return NOTHING
    if value.deviation is None:
        return f"{value.mean:.{digits}f}"
    return f'{value.mean:.{digits}f} <span class="soft">± {value.deviation:.{digits}f}</span>'


def _printed(row: paper.Row | None) -> list[Cell | str]:
    if row is None:
        return [NOTHING] * 3
    return [str(row.iterations), f"{row.geometric:.3f}", f"{row.curvature:.3f}"]


def _medians(mode: Mode, rows: list[EmbeddingRow]) -> Line:
    cells: list[Cell | str] = ["median", ""]
    cells.append(f"{sum(row.converged for row in rows)} of {sum(row.marks for row in rows)}")
    for name, digits in (("iterations", 1), ("geometric", 3), ("curvature", 4)):
        median = median_of(rows, name)
        cells.append(NOTHING if median is None else f"{median:.{digits}f}")
    cells.append("")
    for name, digits in (("iterations", 0), ("geometric", 3), ("curvature", 3)):
        cells.append(f"{papers_median(mode, name):.{digits}f}")
    return Line(cells, "sum")


def median_of(rows: list[EmbeddingRow], name: str) -> float | None:
    """Of the meshes' means."""
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
    named = {row.model.name.capitalize() for row in rows}
    theirs = [[name, *[""] * 10, *printed]
              for name, printed in paper.TABLES[mode.key].items() if name not in named]
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


def write_timing(plan: Plan, store: Store, folder: Path) -> str:
    rows = timings(plan, store)
    write_csv(folder / "timing.csv", ["mesh", "vertices", "harmonics", "seconds"],
              [[name, record["vertices"], timing.HARMONICS, round(record["seconds"], 3)]
               for name, record in rows])
    lines: list[Line] = [
        Line([escape(name), f"{record['vertices']:,}", f"{record['seconds']:.2f}"])
        for name, record in rows]
    lines.append(Line(["the paper, 2008", f"{paper.VERTICES_IN_A_MINUTE:,}", "under 60"], "sum"))
    return f"""
<h2 id="timing">Section 3.1: time</h2>
<p>The paper: “it takes less than 1 minute to calculate the Manifold Harmonic Basis for a mesh with
20,000 vertices”, on a processor of 2.66 GHz and with a number of harmonics that it does not give.
Here the first {timing.HARMONICS} harmonics are computed, on one thread of this machine and before
anything else runs; the faster of {timing.REPEATS} runs.</p>""" + \
        table([["mesh", "vertices", "seconds"]], lines, ["timing.csv"])


def timings(plan: Plan, store: Store) -> list[tuple[str, dict]]:
    """By name, the smallest first."""
    rows = []
    for model, reduced in timing.timed_models(plan):
        record = store.get(timing.timing_key(model, reduced))
        if record is not None:
            rows.append((f"{model.name}, simplified" if reduced else model.name, record))
    return sorted(rows, key=lambda row: row[1]["vertices"])
