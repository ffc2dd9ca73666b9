# SPDX-License-Identifier: BSD-3-Clause
"""The results as a page: tables with the published rates beside ours, and curves."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np
from spectralwatermark import pictures
from spectralwatermark.report.html import STYLE, Cell, Line, figure, heat, table

import published
from attacks import ATTACKS, Attack
from results import Mark, Outcome, mean, read_rows
from schemes import SCHEMES, Scheme

COLOURS = ("SteelBlue", "MidnightBlue", "Firebrick", "DarkOrange", "Goldenrod", "SeaGreen", "YellowGreen")
PUBLISHED_COLOURS = ("LightCoral", "Silver")
FOUND = 1e-6  # p-value at which a mark counts as found
MOST_DIGITS = 30  # of a p-value, in the curves


def write(folder: Path) -> None:
    marks = read_rows(folder / "marks.csv", Mark)
    outcomes = read_rows(folder / "outcomes.csv", Outcome)
    schemes = [scheme for scheme in SCHEMES if any(m.scheme == scheme.name for m in marks)]
    meshes = list(dict.fromkeys(m.mesh for m in marks))
    keys = sorted({m.key for m in marks}, key=int)
    body = "\n".join([
        "<h1>What survives</h1>",
        f'<p class="lead">Bit error rates after attacks: means over {escape(", ".join(meshes))} and '
        f"{len(keys)} key{'s' if len(keys) != 1 else ''}, each with its own message. A rate of .5 is "
        "chance.</p>",
        _marks(schemes, marks), _rates(schemes, outcomes), _found(schemes, outcomes),
        _by_mesh(schemes, outcomes, meshes), _curves(schemes, outcomes, folder),
        _certainty(schemes, outcomes, folder),
    ])
    path = folder / "index.html"
    partial = path.with_suffix(".partial")
    partial.write_text(
        f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>What survives</title>\n'
        f"<style>{STYLE}</style></head><body>\n{body}\n</body></html>\n", encoding="utf-8")
    partial.replace(path)
    print(f"wrote {path}")


def _short(rate: float | None) -> str:
    return "" if rate is None else f"{rate:.3f}".removeprefix("0")


def _rate_cell(rate: float | None) -> Cell:
    return Cell(_short(rate), background=heat(0.0 if rate is None else 1.6 * rate))


def _name(attack: Attack, strength: str) -> str:
    return f"{attack.name} {strength} {attack.unit}" if attack.unit else attack.name


def _select(outcomes: Sequence[Outcome], scheme: Scheme, attack: str, strength: str | None = None,
            mesh: str | None = None) -> list[Outcome]:
    return [o for o in outcomes if o.scheme == scheme.name and o.attack == attack and
            strength in (None, o.strength) and mesh in (None, o.mesh)]


def _marks(schemes: Sequence[Scheme], marks: Sequence[Mark]) -> str:
    def column(scheme: Scheme, name: str) -> float | None:
        return mean([getattr(m, name) for m in marks if m.scheme == scheme.name])
    lines = [Line(["bits", *(str(scheme.bits) for scheme in schemes), *(4 * ["64"])])]
    for label, name, digits, known in (
            ("MRMS, % of the diagonal", "mrms", 4, published.MRMS),
            ("displacement, root mean square, %", "displacement", 4, None),
            ("Hausdorff distance, %", "hausdorff", 3, None), ("MSDM", "msdm", 3, published.MSDM),
            ("MSDM2", "msdm2", 3, None), ("embedding, s", "seconds", 1, published.SECONDS)):
        lines.append(Line([label, *(f"{column(scheme, name):.{digits}f}" for scheme in schemes),
                           *(map(str, known) if known else 4 * [""])]))
    lines.append(Line(["embedded and read back", *(
        f"{sum(m.converged for m in marks if m.scheme == scheme.name)} of "
        f"{sum(m.scheme == scheme.name for m in marks)}" for scheme in schemes), *(4 * [""])]))
    return "<h2>Distortion</h2>" + table([_header("means", schemes, True)], lines, ["marks.csv"])


def _header(first: str, schemes: Sequence[Scheme], with_published: bool) -> list[Cell | str]:
    columns = [Cell(f'<span title="{escape(s.description)}">{escape(s.name)}</span>') for s in schemes]
    if with_published:
        columns += [f"{name}<br>published" for name in published.COLUMNS]
    return [first, *columns]


def _rates(schemes: Sequence[Scheme], outcomes: Sequence[Outcome]) -> str:
    lines = []
    for attack in ATTACKS:
        for strength in attack.strengths:
            rates = [mean([o.bit_error_rate for o in _select(outcomes, scheme, attack.name, strength)])
                     for scheme in schemes]
            known = published.RATES.get((attack.name, strength), (None,) * 4)
            lines.append(Line([_name(attack, strength), *map(_rate_cell, (*rates, *known))]))
    return ("<h2>Bit error rates</h2><p>The published columns are for another mesh, Venus, with the "
            "distortion that the first table gives; the others were measured in this run. Cropping "
            "leaves another solid and another spectrum.</p>" +
            table([_header("attack", schemes, True)], lines, ["outcomes.csv"], dense=True))


def _found(schemes: Sequence[Scheme], outcomes: Sequence[Outcome]) -> str:
    able = [scheme for scheme in schemes if 2.0**-scheme.bits < FOUND]
    lines = []
    for attack in ATTACKS:
        for strength in attack.strengths:
            cells: list[Cell | str] = [_name(attack, strength)]
            for scheme in able:
                rows = _select(outcomes, scheme, attack.name, strength)
                found = sum(o.p_value <= FOUND for o in rows)
                share = found / len(rows) if rows else 1.0
                cells.append(Cell(f"{found} of {len(rows)}", background=heat(1.0 - share)))
            lines.append(Line(cells))
    return (f"<h2>Found</h2><p>Marks whose p-value is at most {FOUND:g}. Five bits cannot get there: "
            "the paper's modes are left out.</p>" +
            table([_header("attack", able, False)], lines, dense=True))


def _by_mesh(schemes: Sequence[Scheme], outcomes: Sequence[Outcome], meshes: Sequence[str]) -> str:
    parts = ["<h2>Mesh by mesh</h2>"]
    for scheme in schemes:
        if not scheme.name.startswith("robust"):
            continue
        lines = []
        for attack in ATTACKS:
            for strength in attack.strengths:
                lines.append(Line([_name(attack, strength), *(
                    _rate_cell(mean([o.bit_error_rate for o in
                                     _select(outcomes, scheme, attack.name, strength, mesh)]))
                    for mesh in meshes)]))
        parts.append(f"<h3>{escape(scheme.description)}</h3>" +
                     table([["attack", *map(escape, meshes)]], lines, dense=True))
    return "\n".join(parts)


def _curves(schemes: Sequence[Scheme], outcomes: Sequence[Outcome], folder: Path) -> str:
    parts = ["<h2>Error against strength</h2>"]
    for attack in ATTACKS:
        strengths = [float(s) for s in attack.strengths] if attack.unit in ("%", "iterations", "bits") \
            else []
        if len(strengths) < 3:
            continue
        curves = []
        for scheme, colour in zip(schemes, COLOURS):
            rates = [mean([o.bit_error_rate for o in _select(outcomes, scheme, attack.name, s)])
                     for s in attack.strengths]
            if None not in rates:
                curves.append(pictures.Curve(
                    pictures.table_of(strength=strengths, rate=rates), "strength", "rate", scheme.name,
                    colour))
        if (attack.name, attack.strengths[0]) in published.RATES:
            for column, colour in enumerate(PUBLISHED_COLOURS):
                rates = [published.RATES[attack.name, s][column] for s in attack.strengths]
                curves.append(pictures.Curve(
                    pictures.table_of(strength=strengths, rate=rates), "strength", "rate",
                    f"published: {published.COLUMNS[column].split(' (')[0]}", colour))
        name = f"rates-{attack.name}.png"
        pictures.write_chart(folder / name, curves, f"Bit error rate after {attack.name}",
                                  (f"{attack.name}, {attack.unit}", "bit error rate"))
        parts.append(figure(attack.name, name, f"Bit error rate after {attack.name}."))
    return "\n".join(parts)


def _certainty(schemes: Sequence[Scheme], outcomes: Sequence[Outcome], folder: Path) -> str:
    """What share of attacked copies is found at which rate of false positives: the ROC curve, since
    the p-value is that rate."""
    attacked = [a.name for a in ATTACKS if a.name not in ("none", "file", "cropping")]
    curves = []
    digits = np.linspace(0.0, MOST_DIGITS, 301)
    for scheme, colour in zip(schemes, COLOURS):
        values = np.array([o.p_value for o in outcomes
                           if o.scheme == scheme.name and o.attack in attacked])
        if len(values):
            shares = [(values <= 10.0**-digit).mean() for digit in digits]
            curves.append(pictures.Curve(
                pictures.table_of(digits=digits, share=shares), "digits", "share", scheme.name, colour))
    pictures.write_chart(
        folder / "roc.png", curves, "Copies found, all attacks but cropping",
        ("one false positive in 10 to the power of", "share of copies found"))
    return "<h2>Certainty</h2>" + figure(
        "roc", "roc.png", "Share of attacked copies that are found, against the rate of false positives "
        "that is accepted. P-values of the scheme Robust and of the baseline are exact, those of the "
        "paper's scheme with a key too; five bits end at 1/32.")
