# SPDX-License-Identifier: BSD-3-Clause
"""The page: the paper's tables and figures next to ours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jinja2 import Environment
from spectralwatermark.report.pages import templates_of

from . import (
    paper,
    results,
    section_detection,
    section_differences,
    section_figures,
    section_robustness,
    section_tables,
    timing,
)
from .experiments import MODE, MODES
from .figures import COMPONENT, NAMES, SHOWN_HARMONICS
from .files import INDEX, write_text
from .models import FOLDER_VARIABLE
from .plan import Plan
from .section_figures import Figures
from .spectra import BITS
from .store import CACHE, Store
from .work import Failure, by_message

TEMPLATES = Path(__file__).resolve().parent / "templates"
CONTENTS = (
    ("glance", "At a glance"),
    ("compared", "What is compared"),
    ("tables", "Tables 1 to 4: iterations and distortion"),
    ("figures-basis", "Figures 2 to 8: harmonics and spectra"),
    ("figures-marks", "Figures 9 to 12: what a mark looks like"),
    ("robustness", "Section 3.3: robustness"),
    ("figures-attacks", "Figures 13 to 16: attacked meshes"),
    ("timing", "Section 3.1: time"),
    ("detection", "Calibrated detection"),
    ("differences", "Where we differ from the paper"),
    ("failures", "What failed"),
    ("again", "Run it again"),
)
# Attacks that the glance sums up, in the first mode: what the page calls them, and their keys.
GLANCE_ATTACKS = (
    ("rotation, scaling and translation", ("rotation", "scaling", "translation")),
    ("simplification to a half", ("simplify-50",)),
    ("noise of 0.5", ("noise-0.5",)),
    ("smoothing as printed", ("smooth-dropped",)),
    ("smoothing with the rest kept", ("smooth-kept",)),
)


@dataclass(frozen=True)
class Run:
    """The results that the page presents."""

    plan: Plan
    store: Store
    failures: Sequence[Failure]
    builds: int  # number of different builds of the filters that the results came from


def write(run: Run, folder: Path) -> set[str]:
    """Writes the tables, the charts of results and the page; returns the files that failed."""
    plan, store = run.plan, run.store
    figures = Figures(plan, store, folder)
    timings = section_tables.timings(plan, store, folder)
    html = _templates().get_template("index.html.j2").render(
        title="Robust spectral watermarking, reproduced", contents=CONTENTS, plan=plan, paper=paper,
        folder_variable=FOLDER_VARIABLE, cache=CACHE, bits=BITS, mode=MODE, timing=timing,
        convergence=results.convergence(plan, store),
        convergence_by_mode=[(mode, results.convergence(plan, store, [mode])) for mode in MODES],
        distortion=_distortion(plan, store), read_after=_read_after(plan, store),
        nearest_timing=min(timings, default=None,
                           key=lambda row: abs(row[1]["vertices"] - paper.VERTICES_IN_A_MINUTE)),
        tables=section_tables.tables(plan, store, folder), timings=timings,
        figures=figures, names=NAMES, component=COMPONENT, shown_harmonics=SHOWN_HARMONICS,
        stands_for=section_figures.stands_for,
        robustness=section_robustness.facts(plan, store, folder), chance=section_robustness.CHANCE,
        verdict_of=section_robustness.verdict_of,
        detection=section_detection.facts(plan, store, folder),
        differences=section_differences.facts(plan, store),
        failures=by_message(run.failures), builds=run.builds)
    # No line ends between a number and its percent sign.
    write_text(folder / INDEX, html.replace(" %", "\u00a0%"))
    return figures.failed_files()


def _templates() -> Environment:
    templates = templates_of(TEMPLATES)
    templates.filters |= {
        "thousands": lambda number: f"{number:,}",
        "fixed": lambda value, digits: f"{value:.{digits}f}",
        "percent": lambda share, digits=0: f"{100.0 * share:.{digits}f} %",
        "rate": lambda share: f"{100.0 * share:.2f}" if share else "0",
        "mean": np.mean,
        "median": np.median,
        "below": lambda values, limit: sum(value < limit for value in values),
    }
    return templates


# --- At a glance -------------------------------------------------------------------------------


def _distortion(plan: Plan, store: Store) -> dict | None:
    """Medians of the first mode beside the paper's, and whether they are alike."""
    mode = MODES[0]
    rows = results.embedding_rows(plan, store, mode)
    ours = {name: section_tables.median_of(rows, name) for name in ("geometric", "iterations")}
    if None in ours.values():
        return None
    papers = {name: section_tables.papers_median(mode, name) for name in ours}
    alike = all(0.5 <= ours[name] / papers[name] <= 2.0 for name in ours)
    return ours | {f"papers_{name}": value for name, value in papers.items()} | {"alike": alike}


def _read_after(plan: Plan, store: Store) -> list[tuple[str, float]]:
    """The share of messages that are read without any error, by attack."""
    shares = []
    for title, attacks in GLANCE_ATTACKS:
        found = [results.robustness(plan, store, plan.robustness_models(), MODES[0], key)
                 for key in attacks]
        errors = [error for result in found for error in result.errors]
        if errors:
            shares.append((title, sum(error == 0 for error in errors) / len(errors)))
    return shares
