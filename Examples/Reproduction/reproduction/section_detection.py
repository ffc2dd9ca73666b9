# SPDX-License-Identifier: BSD-3-Clause
"""Section "Calibrated detection": beyond the paper, what a reading proves."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from math import comb
from pathlib import Path

import numpy as np

from spectralwatermark.report.html import Cell, Line, figure, percent, table

from . import calibration, detection, results
from .calibration import ALPHAS, DIVISIONS
from .experiments import ATTACK
from .figures import NAMES, draw_roc
from .files import write_csv
from .plan import Plan
from .results import BitStatistics, Rates, RocSummary
from .spectra import BITS
from .store import Store

OPERATING_POINTS = (0.05, 1.0 / 2**BITS, 0.01, 0.001)


def write(plan: Plan, store: Store, folder: Path) -> str:
    statistics = [results.bit_statistics(plan, store, division)
                  for division in range(len(DIVISIONS))] \
        if results.calibrations(plan, store) else []
    return "\n".join([
        """
<h2 id="detection">Calibrated detection</h2>
<p>The paper asserts a mark when enough bits agree and does not say how often an unmarked mesh
agrees as well. The detector here gives that probability, the p-value. This section measures whether
it can be believed, on meshes without a mark: a rate of false positives that is promised must not be
exceeded.</p>""",
        _bits(statistics, plan, store, folder), _rates(plan, store, folder),
        _verification(plan, store), _roc(plan, store, folder)])


# --- How unmarked meshes read ------------------------------------------------------------------


def _bits(statistics: Sequence[BitStatistics], plan: Plan, store: Store, folder: Path) -> str:
    names = list(statistics[0].by_model) if statistics else []
    rows = [["mesh", name, *(item.by_model[name] for item in statistics)] for name in names]
    rows += [["position", int(position), *(float(item.by_position[i]) for item in statistics)]
             for i, position in enumerate(detection.POSITIONS)]
    write_csv(folder / "unmarked-bits.csv", ["of", "value", "normal_reads_1", "narrow_reads_1"],
              rows)
    lines = [Line([escape(name), *(percent(item.by_model[name], 1) for item in statistics)])
             for name in names]
    lines.append(Line(["mean", *(percent(item.share(), 1) for item in statistics)], "sum"))
    bounds = [
        Line(["reads 1: most, of a mesh or a carrier position",
              *(_against(item.extremes()[1], detection.ONE_AT_MOST[item.division])
                for item in statistics)]),
        Line(["reads 0: most, of a mesh or a carrier position",
              *(_against(1.0 - item.extremes()[0], detection.ZERO_AT_MOST[item.division])
                for item in statistics)])]
    bounds += [Line([f"variance of the ones among {size} slots, by the binomial's",
                     *(_ratio(item.variance_ratios[size]) for item in statistics)])
               for size in (5, 10, 20)]
    head = [["", *(f"{name} slots" for name in DIVISIONS)]]
    return f"""
<h3 id="unmarked-bits">How the bits of unmarked meshes fall</h3>
<p>{_verdict(statistics)}</p>""" + \
        table(head, lines, ["unmarked-bits.csv"], "Share of windows that read 1") + \
        table(head, bounds, caption="Measured extremes, the bound that the detector uses in "
                                    "brackets, and independence")


def _against(measured: float, bound: float) -> Cell:
    return Cell(f'{percent(measured, 1)} <span class="soft">({percent(bound)})</span>',
                "bad" if measured > bound else "good")


def _ratio(value: float) -> str:
    return "–" if np.isnan(value) else f"{value:.2f}"


def _verdict(statistics: Sequence[BitStatistics]) -> str:
    if not statistics:
        return "No mesh was measured."
    windows = sum(item.windows for item in statistics)
    ratios = [ratio for item in statistics for ratio in item.variance_ratios.values()
              if not np.isnan(ratio)]
    normal, narrow = (percent(item.share(), 1) for item in statistics)
    outside = [DIVISIONS[item.division] for item in statistics if not item.within_bounds()]
    bounds = "All meshes and carrier positions stay within the bounds that the detector uses." \
        if not outside else \
        f"In {' and '.join(outside)} slots some mesh or position is outside of these bounds."
    spread = "like independent draws" if max(ratios) < 1.1 else \
        "a little less evenly than independent draws would" if max(ratios) < 1.3 else \
        "less evenly than independent draws would: p-values without a key are then too small"
    return f"""{windows:,} windows of ten components, each with its carrier at every position from 2
to 9: {normal} read 1 in normal slots and {narrow} in narrow ones. They are no fair coins:
magnitudes are skewed and fall along the spectrum, so that 0 is the likelier. {bounds} Among
consecutive slots the ones fall {spread} (variance {min(ratios):.2f} to {max(ratios):.2f} times the
binomial's; a mesh has only some 28 slots, so that groups of 20 overlap and their number is
rough)."""


# --- False positives ---------------------------------------------------------------------------


def _rates(plan: Plan, store: Store, folder: Path) -> str:
    rates = results.false_positives(plan, store)
    _write_rates(rates, folder)
    keyless_or_keyed = [rate for rate in rates if not rate.message]
    fixed = [rate for rate in rates if rate.message]
    meshes = len(results.calibrations(plan, store))
    return f"""
<h3 id="false-positives">Claimed and measured false positives</h3>
<p>For each threshold, the share of detections on unmarked meshes whose p-value is at or under it,
in percent: first by counting bits (equation 12), then by the likelihood detector, which weighs
them. {meshes} meshes; {plan.random_messages:,} random messages each without a key, {plan.keys:,}
secret keys each with a random message and with the one that the key derives. {_overall(rates)} A
rate is marked where it is above its threshold by more than chance explains (once in
{results.UNLIKELY:,}). Few bits reach few p-values: the grey lines give the rate that can be had
with fair coins at the most.</p>""" + \
        table(_rate_head(("count", "weigh")),
              _rate_lines(keyless_or_keyed, ("hard", "soft"), attainable=True),
              ["false-positives.csv"], "Random messages and secret keys, percent") + f"""
<p>Fixed messages without a key are the hard case, since the bits of unmarked meshes are no fair
coins. They are looked for at all carrier positions and, {_every(plan.window_stride)}, at all places
of the spectrum; neighbouring places read partly the same components, so that a few meshes decide.
The third number of each is the naive p-value, which takes bits for fair coins.</p>""" + \
        table(_rate_head(("count", "weigh", "naive")),
              _rate_lines(fixed, ("hard", "soft", "naive"), attainable=False),
              ["false-positives.csv"], "Fixed messages without a key, percent", dense=True)


def _every(stride: int) -> str:
    return "component by component" if stride == 1 else f"every {stride} components"


def _overall(rates: Sequence[Rates]) -> str:
    def broken(detector: str, chosen: Sequence[Rates]) -> int:
        return int(sum(rate.too_many(detector).sum() for rate in chosen))

    total = len(rates) * len(ALPHAS)
    count, weigh = broken("hard", rates), broken("soft", rates)
    fixed = [rate for rate in rates if rate.message]
    return (f"Of {total} rates promised, {count} are exceeded by counting and {weigh} by weighing; "
            f"of the {len(fixed) * len(ALPHAS)} for fixed messages, the naive p-value exceeds "
            f"{broken('naive', fixed)}.")


def _rate_head(detectors: Sequence[str]) -> list[list[Cell | str]]:
    return [["", "", "", *(Cell(f"threshold {100.0 * alpha:g}", "group", span=len(detectors))
                           for alpha in ALPHAS)],
            ["expected", Cell("slots", "text"), "bits", *(list(detectors) * len(ALPHAS))]]


def _rate_lines(
    rates: Sequence[Rates], detectors: Sequence[str], attainable: bool
) -> list[Line]:
    ordered = sorted(rates, key=lambda rate: (rate.length, rate.kind, rate.message, rate.division))
    lines = []
    for length in calibration.LENGTHS:
        if attainable:
            best = [attainable_rate(length, alpha) for alpha in ALPHAS]
            cells = [Cell(_rate(rate)) if i == 0 else Cell("") for rate in best
                     for i in range(len(detectors))]
            lines.append(Line(["fair coins", "", str(length), *cells], "rest"))
        for rate in (rate for rate in ordered if rate.length == length):
            cells = []
            for i in range(len(ALPHAS)):
                for detector in detectors:
                    bad = rate.too_many(detector)[i]
                    cells.append(Cell(_rate(rate.rate(detector)[i]), "bad" if bad else ""))
            lines.append(Line([_name(rate), Cell(DIVISIONS[rate.division], "text"),
                               str(rate.length), *cells]))
    return lines


def _name(rate: Rates) -> str:
    if not rate.message:
        return escape(rate.kind)
    short = rate.message if len(rate.message) <= 10 else rate.message[:10] + "…"
    return f"<code>{short}</code>"


def _rate(value: float) -> str:
    return f"{100.0 * value:.2f}" if value else "0"


def attainable_rate(length: int, alpha: float) -> float:
    """The largest probability, at most alpha, that fair coins agree in some number of bits or
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


def _verification(plan: Plan, store: Store) -> str:
    compared, difference = results.verification(plan, store)
    return f"""
<p class="note">These tables come from a second construction of the detector, in numpy, that adds up
the tail of the distribution in another way. {compared:,} p-values and likelihood ratios of
<code>vtkSpectralWatermarkDetect</code> itself were compared with it, with and without keys, on
every mesh: the largest difference is {difference:.1e}.</p>"""


# --- ROC ---------------------------------------------------------------------------------------


def _roc(plan: Plan, store: Store, folder: Path) -> str:
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
    counts = ", ".join(f"{division.lower()} slots {summary.positives:,} and {summary.negatives:,}"
                       for division, summary in summaries.items())
    behind = max((summary.attacked_meshes for summary in summaries.values()), default=0)
    return f"""
<h3 id="roc">Counting bits against weighing them</h3>
<p>Marked meshes under the attacks of the robustness section, each tried with its message, against
unmarked meshes under the same attacks, each tried with all {2**BITS} messages (what random messages
give on average). Marked and unmarked cases: {counts}; behind the unmarked ones are {behind}
attacked meshes. By chance all five bits agree in 1 of 32 cases (3.125 %): below that rate counting
finds nothing. The likelihood ratio can go lower, since it tells strong readings from weak ones.
{_comparison(summaries)}</p>
{_roc_table(selections)}
""" + "\n".join([
        figure("roc", NAMES["roc"], """<b>ROC.</b> Share of attacked marks that are found against
the share of attacked unmarked meshes that are mistaken for marked ones, as the threshold goes
down.""",
               ["roc-curves.csv"]),
        figure("roc-low", NAMES["roc-log"], """<b>ROC at low rates.</b> The same with a logarithmic
axis. The curves of counting begin at about 1 in 32, where all five bits have to agree.""",
               ["roc-curves.csv"])])


def _comparison(summaries: dict[str, RocSummary]) -> str:
    parts = []
    for division, summary in summaries.items():
        hard, soft = (summary.curves[detector].area() for detector in ("hard", "soft"))
        verdict = "better than" if soft > hard + 0.002 else \
            "worse than" if soft < hard - 0.002 else "as good as"
        parts.append(f"{verdict} counting in {division.lower()} slots ({soft:.3f} against "
                     f"{hard:.3f})")
    return f"By the area under the curve, weighing is {' and '.join(parts)}; the table tells at " \
           "which rates." if parts else ""


def _roc_table(selections: dict[str, dict[str, RocSummary]]) -> str:
    head = [["", "", Cell("area under the curve", "group", span=2),
             *(Cell(f"found at {100.0 * rate:.3g} % false", "group", span=2)
               for rate in OPERATING_POINTS)],
            ["attacks", Cell("slots", "text"), *(["count", "weigh"] * (1 + len(OPERATING_POINTS)))]]
    lines = []
    for selection, summaries in selections.items():
        for division, summary in summaries.items():
            hard, soft = summary.curves["hard"], summary.curves["soft"]
            cells = [f"{hard.area():.3f}", f"{soft.area():.3f}"]
            for rate in OPERATING_POINTS:
                cells += [percent(curve.true_positives_at(rate), 1) for curve in (hard, soft)]
            lines.append(Line([selection, Cell(division, "text"), *cells],
                              "head" if selection == "all attacks" else ""))
    return table(head, lines, ["roc.csv"])


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
