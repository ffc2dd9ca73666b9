# SPDX-License-Identifier: BSD-3-Clause
"""The results as a page: tables with the published rates next to ours, and curves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from spectralwatermark.report.charts import chart
from spectralwatermark.report.pages import templates_of

import published
from attacks import ATTACKS, Attack
from results import Mark, Outcome, mean, read_rows
from schemes import SCHEMES, Scheme

TEMPLATES = Path(__file__).resolve().parent / "templates"
COLOURS = ("steelblue", "midnightblue", "firebrick", "darkorange", "goldenrod", "seagreen", "yellowgreen")
PUBLISHED_COLOURS = ("lightcoral", "silver")
FOUND = 1e-6  # largest p-value at which a mark counts as found
MOST_DIGITS = 30  # the curves of p-values end at 10 to the power of minus this
MEASURES = (  # label, name in Mark, digits, published values
    ("MRMS, % of the diagonal", "mrms", 4, published.MRMS),
    ("displacement, root mean square, %", "displacement", 4, None),
    ("Hausdorff distance, %", "hausdorff", 3, None),
    ("MSDM", "msdm", 3, published.MSDM),
    ("MSDM2", "msdm2", 3, None),
    ("embedding, s", "seconds", 1, published.SECONDS),
)


@dataclass(frozen=True)
class Results:
    """Everything that was measured, and the schemes and meshes that occur in it."""

    marks: list[Mark]
    outcomes: list[Outcome]
    schemes: list[Scheme]
    meshes: list[str]

    def of(self, scheme: Scheme, attack: Attack, strength: str, mesh: str | None = None) -> list[Outcome]:
        return [outcome for outcome in self.outcomes
                if (outcome.scheme, outcome.attack, outcome.strength) == (scheme.name, attack.name, strength)
                and mesh in (None, outcome.mesh)]

    def rate(self, *which: object) -> float | None:
        """The mean bit error rate of these outcomes."""
        return mean([outcome.bit_error_rate for outcome in self.of(*which)])


def write(folder: Path) -> None:
    """Reads marks.csv and outcomes.csv of the folder; writes index.html and its charts beside them."""
    results = _read(folder)
    able = [scheme for scheme in results.schemes if 2.0**-scheme.bits < FOUND]
    html = templates_of(TEMPLATES).get_template("robustness.html.j2").render(
        title="Robustness to attacks", published=published, schemes=results.schemes, able=able, limit=FOUND,
        meshes=results.meshes, keys=len({mark.key for mark in results.marks}),
        distortion=_distortion(results), read_back=_read_back(results),
        cases=[_case(results, able, attack, strength) for attack, strength in _cases()],
        by_mesh=_by_mesh(results), curves=_draw_curves(results, folder))
    _draw_certainty(results, folder)
    path = folder / "index.html"
    partial = path.with_suffix(".partial")
    partial.write_text(html, encoding="utf-8")
    partial.replace(path)
    print(f"wrote {path}")


def _read(folder: Path) -> Results:
    marks = read_rows(folder / "marks.csv", Mark)
    schemes = [scheme for scheme in SCHEMES if any(mark.scheme == scheme.name for mark in marks)]
    meshes = list(dict.fromkeys(mark.mesh for mark in marks))
    return Results(marks, read_rows(folder / "outcomes.csv", Outcome), schemes, meshes)


def _cases() -> Iterator[tuple[Attack, str]]:
    for attack in ATTACKS:
        for strength in attack.strengths:
            yield attack, strength


def _name(attack: Attack, strength: str) -> str:
    return f"{attack.name} {strength} {attack.unit}" if attack.unit else attack.name


# --- Tables --------------------------------------------------------------------------------------


def _distortion(results: Results) -> list[dict]:
    rows = []
    for label, name, digits, known in MEASURES:
        ours = [mean([getattr(mark, name) for mark in results.marks if mark.scheme == scheme.name])
                for scheme in results.schemes]
        rows.append({"label": label, "digits": digits, "ours": ours,
                     "published": known or [""] * len(published.COLUMNS)})
    return rows


def _read_back(results: Results) -> list[tuple[int, int]]:
    """For each scheme the marks that were read back, and all marks."""
    counts = []
    for scheme in results.schemes:
        converged = [mark.converged for mark in results.marks if mark.scheme == scheme.name]
        counts.append((sum(converged), len(converged)))
    return counts


def _case(results: Results, able: Sequence[Scheme], attack: Attack, strength: str) -> dict:
    """One attack at one strength: error rates, published ones, and marks found of all."""
    found = []
    for scheme in able:
        outcomes = results.of(scheme, attack, strength)
        found.append((sum(outcome.p_value <= FOUND for outcome in outcomes), len(outcomes)))
    return {
        "name": _name(attack, strength), "found": found,
        "rates": [results.rate(scheme, attack, strength) for scheme in results.schemes],
        "published": published.RATES.get((attack.name, strength), [None] * len(published.COLUMNS)),
    }


def _by_mesh(results: Results) -> list[tuple[Scheme, list]]:
    return [(scheme, [(_name(attack, strength), [results.rate(scheme, attack, strength, mesh)
                                                 for mesh in results.meshes])
                      for attack, strength in _cases()])
            for scheme in results.schemes if scheme.name.startswith("robust")]


# --- Charts --------------------------------------------------------------------------------------


def _draw_curves(results: Results, folder: Path) -> list[str]:
    """A chart for each attack with at least three strengths on a scale; returns the attacks' names."""
    drawn = [attack for attack in ATTACKS
             if attack.unit in ("%", "iterations", "bits") and len(attack.strengths) >= 3]
    for attack in drawn:
        with chart(folder / f"rates-{attack.name}.png", f"Bit error rate after {attack.name}",
                   f"{attack.name}, {attack.unit}", "bit error rate") as axes:
            strengths = [float(strength) for strength in attack.strengths]
            axes.set_xticks(strengths, attack.strengths)
            for scheme, colour in zip(results.schemes, COLOURS):
                rates = [results.rate(scheme, attack, strength) for strength in attack.strengths]
                if None not in rates:
                    axes.plot(strengths, rates, label=scheme.name, color=colour, marker=".")
            if (attack.name, attack.strengths[0]) in published.RATES:
                for column, colour in enumerate(PUBLISHED_COLOURS):
                    axes.plot(strengths, [published.RATES[attack.name, strength][column]
                                          for strength in attack.strengths], color=colour, marker=".",
                              label=f"published: {published.COLUMNS[column].split(' (')[0]}")
    return [attack.name for attack in drawn]


def _draw_certainty(results: Results, folder: Path) -> None:
    """The share of attacked copies that is found at each rate of false positives.

    This is the ROC curve, because the p-value is that rate.
    """
    attacked = [attack.name for attack in ATTACKS if attack.name not in ("none", "file", "cropping")]
    digits = np.linspace(0.0, MOST_DIGITS, 301)
    with chart(folder / "roc.png", "Copies found, all attacks but cropping", "accepted rate of false positives",
               "share of copies found") as axes:
        axes.set_xscale("log")
        axes.invert_xaxis()
        for scheme, colour in zip(results.schemes, COLOURS):
            values = np.array([outcome.p_value for outcome in results.outcomes
                               if outcome.scheme == scheme.name and outcome.attack in attacked])
            if len(values):
                shares = [(values <= 10.0**-digit).mean() for digit in digits]
                axes.plot(10.0**-digits, shares, label=scheme.name, color=colour)
