# SPDX-License-Identifier: BSD-3-Clause
"""The numbers of the section "Calibrated detection", which goes beyond the paper."""

from __future__ import annotations

from collections.abc import Sequence
from math import comb
from pathlib import Path

import numpy as np

from . import detection, results
from .calibration import ALPHAS, DIVISIONS, LENGTHS
from .experiments import ATTACK
from .figures import draw_roc
from .files import write_csv
from .plan import Plan
from .results import BitStatistics, Rates, RocSummary
from .spectra import BITS
from .store import Store

OPERATING_POINTS = (0.05, 1.0 / 2**BITS, 0.01, 0.001)


def facts(plan: Plan, store: Store, folder: Path) -> dict:
    """What the section's template prints; the tables are also written as files."""
    return (_bits(plan, store, folder) | _rates(plan, store, folder) | _roc(plan, store, folder)
            | {"alphas": ALPHAS, "divisions": DIVISIONS})


# --- How unmarked meshes read ------------------------------------------------------------------


def _bits(plan: Plan, store: Store, folder: Path) -> dict:
    statistics = [results.bit_statistics(plan, store, division)
                  for division in range(len(DIVISIONS))] \
        if results.calibrations(plan, store) else []
    _write_bits(statistics, folder)
    ratios = [ratio for item in statistics for ratio in item.variance_ratios.values()]
    return {
        "statistics": statistics,
        "variance_ratios": [ratio for ratio in ratios if not np.isnan(ratio)],
        "outside": [DIVISIONS[item.division] for item in statistics if not item.within_bounds()],
        "one_at_most": detection.ONE_AT_MOST, "zero_at_most": detection.ZERO_AT_MOST,
    }


def _write_bits(statistics: Sequence[BitStatistics], folder: Path) -> None:
    names = list(statistics[0].by_model) if statistics else []
    rows = [["mesh", name, *(item.by_model[name] for item in statistics)] for name in names]
    rows += [["position", int(position), *(float(item.by_position[i]) for item in statistics)]
             for i, position in enumerate(detection.POSITIONS)]
    write_csv(folder / "unmarked-bits.csv", ["of", "value", "normal_reads_1", "narrow_reads_1"],
              rows)


# --- False positives ---------------------------------------------------------------------------


def _rates(plan: Plan, store: Store, folder: Path) -> dict:
    rates = results.false_positives(plan, store)
    _write_rates(rates, folder)
    fixed = [rate for rate in rates if rate.message]
    exceeded = {"hard": _exceeded("hard", rates), "soft": _exceeded("soft", rates),
                "naive": _exceeded("naive", fixed)}
    compared, difference = results.verification(plan, store)
    ordered = sorted(rates, key=lambda rate: (rate.length, rate.kind, rate.message, rate.division))
    return {
        "rates": rates, "fixed": fixed, "exceeded_by": exceeded,
        "exceeded": exceeded["hard"] + exceeded["soft"], "claimed": 2 * len(rates) * len(ALPHAS),
        "cases": sum(rate.cases for rate in rates), "unlikely": results.UNLIKELY,
        "meshes": len(results.calibrations(plan, store)),
        "by_length": [(length, [attainable_rate(length, alpha) for alpha in ALPHAS],
                       [rate for rate in ordered if rate.length == length]) for length in LENGTHS],
        "compared": compared, "difference": difference,
    }


def _exceeded(detector: str, rates: Sequence[Rates]) -> int:
    return int(sum(rate.too_many(detector).sum() for rate in rates))


def attainable_rate(length: int, alpha: float) -> float:
    """The largest probability, at most alpha, of fair coins agreeing in some number of bits or
    more."""
    best, tail = 0.0, 0.0
    for agreements in range(length, -1, -1):
        tail += comb(length, agreements) / 2.0**length
        if tail > alpha:
            break
        best = tail
    return best


def _write_rates(rates: Sequence[Rates], folder: Path) -> None:
    rows = []
    for rate in rates:
        for i, alpha in enumerate(ALPHAS):
            rows.append([rate.kind, rate.message, DIVISIONS[rate.division], rate.length, alpha,
                         rate.cases, *(float(rate.rate(detector)[i]) for detector in
                                       ("hard", "soft", "naive")),
                         *(float(rate.worst[detector][i]) for detector in
                           ("hard", "soft", "naive"))])
    write_csv(folder / "false-positives.csv",
              ["expected", "message", "slots", "bits", "threshold", "cases", "counting", "weighing",
               "naive", "counting_worst_mesh", "weighing_worst_mesh", "naive_worst_mesh"], rows)


# --- ROC ---------------------------------------------------------------------------------------


def _roc(plan: Plan, store: Store, folder: Path) -> dict:
    summaries = results.roc_summaries(plan, store)
    curves = {(division, detector): curve for division, summary in summaries.items()
              for detector, curve in summary.curves.items()}
    draw_roc(folder, curves)
    write_csv(folder / "roc-curves.csv",
              ["slots", "detector", "false_positives", "true_positives"],
              [[division, detector, float(x), float(y)]
               for (division, detector), curve in curves.items()
               for x, y in zip(curve.false_positives, curve.true_positives)])
    families = list(dict.fromkeys(ATTACK[key].family for key in plan.attacks))
    selections = {"all attacks": summaries} | {
        family.lower(): results.roc_summaries(plan, store, [family]) for family in families}
    _write_roc(selections, folder)
    behind = max((summary.attacked_meshes for summary in summaries.values()), default=0)
    return {"roc": selections, "attacked_meshes": behind, "operating_points": OPERATING_POINTS}


def _write_roc(selections: dict[str, dict[str, RocSummary]], folder: Path) -> None:
    rows = []
    for selection, summaries in selections.items():
        for division, summary in summaries.items():
            for detector, curve in summary.curves.items():
                rows.append([selection, division, detector, summary.positives, summary.negatives,
                             curve.area(),
                             *(curve.true_positives_at(rate) for rate in OPERATING_POINTS)])
    write_csv(folder / "roc.csv",
              ["attacks", "slots", "detector", "positives", "negatives", "area",
               *(f"found_at_{rate:.5g}" for rate in OPERATING_POINTS)], rows)
