# SPDX-License-Identifier: BSD-3-Clause
"""The figures with their captions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path

import numpy as np

from spectralwatermark.report.html import figure

from . import plan as planning
from .experiments import MODE
from .figures import COMPONENT, NAMES, SHOWN_HARMONICS
from .files import write_csv
from .plan import Drawing, Plan
from .store import Store


class Figures:
    """The drawings of a run, with the numbers that they returned."""

    def __init__(self, plan: Plan, store: Store, folder: Path) -> None:
        self.folder = folder
        self._drawings = {drawing.number: drawing for drawing in planning.drawings(plan)}
        self._facts = {number: store.get(drawing.key())
                       for number, drawing in self._drawings.items()}

    def get(self, number: str) -> tuple[Drawing, dict] | None:
        facts = self._facts[number]
        return None if facts is None else (self._drawings[number], facts)

    def failed_files(self) -> set[str]:
        """Files that are not there since their drawing failed."""
        missing = set()
        for number, drawing in self._drawings.items():
            if self._facts[number] is None:
                missing |= set(drawing.files)
                missing |= {f"figure-{int(number):02d}.csv"}
        return missing


def stands_for(drawing: Drawing, name: str = "") -> str:
    """Which mesh this is, and whether it is the paper's."""
    name = name or drawing.model.name
    if name == drawing.papers.lower():
        return f"{escape(drawing.papers)}, as in the paper, perhaps in another resolution."
    return f"Here {escape(name)} stands for the paper's {escape(drawing.papers)}."


def missing(number: str) -> str:
    return f'<p class="note" id="figure-{number}">Figure {number} could not be drawn: see ' \
           f'<a href="#failures">what failed</a>.</p>'


def write_basis(figures: Figures) -> str:
    """Figures 2 to 8: harmonics, spectra, iterations."""
    return "\n".join(["""
<h2 id="figures-basis">Figures 2 to 8: harmonics and spectra</h2>""",
                      _harmonics(figures), _doubling(figures), _difference(figures),
                      _evolution(figures)])


def _harmonics(figures: Figures) -> str:
    found = figures.get("2")
    if found is None:
        return missing("2")
    drawing, facts = found
    similarity = facts["similarity"]
    write_csv(figures.folder / "figure-02.csv", ["component", "similarity"],
              list(enumerate(similarity, start=1)))
    numbers = ", ".join(f"{similarity[number - 1]:.3f}" for number in SHOWN_HARMONICS)
    fine, coarse = facts["triangles"]
    return figure("2", NAMES["2"], f"""<b>Figure 2.</b> Harmonics 6, 17 and 26 at two resolutions,
{fine:,} triangles above and {coarse:,} below. {stands_for(drawing)} Similarity by equation 8, with
the coarse mesh's harmonics taken at the closest points: {numbers}; over the first {len(similarity)}
components {np.mean(similarity):.3f} on average, {_below(similarity, 0.9)} of them under 0.9. Where
two eigenvalues nearly meet, their harmonics mix.""", ["figure-02.csv"])


def _below(values: list[float], limit: float) -> int:
    return sum(value < limit for value in values)


def _doubling(figures: Figures) -> str:
    found = figures.get("3")
    if found is None:
        return "\n".join(missing(number) for number in "345")
    drawing, facts = found
    similarity, before, after = facts["similarity"], facts["before"], facts["after"]
    write_csv(figures.folder / "figure-03.csv",
              ["component", "similarity", "magnitude_before", "magnitude_after"],
              zip(range(1, len(similarity) + 1), similarity, before, after))
    k = COMPONENT - 1
    three = figure("3", NAMES["3"], f"""<b>Figure 3.</b> Similarity of the harmonics of a mesh and
of the same mesh with component {COMPONENT} doubled. {stands_for(drawing)} Mean
{np.mean(similarity):.3f}; {_below(similarity, 0.9)} of {len(similarity)} components under 0.9,
{_below(similarity, 0.5)} under 0.5. In the paper most are
near 1. The dips come in pairs: neighbours that have turned into each other.""", ["figure-03.csv"])
    four = figure("4", NAMES["4"], f"""<b>Figure 4.</b> The spectrum of both meshes. Wanted was
c{COMPONENT} doubled; in the changed mesh's own harmonics it is {after[k] / before[k]:.2f} times
what it was. This is why embedding has to be repeated.""", ["figure-03.csv"])
    five = figure("5", NAMES["5"], f"""<b>Figure 5.</b> The two meshes, and how far each point and
each geometric Laplacian (equation 14) moved. GeomDiff {facts["geometric"]:.3f} %, CurvDiff
{facts["curvature"]:.4f} %. In this and the following figures each colour scale ends where 99 % of
the points are below.""")
    return "\n".join([three, four, five])


def _difference(figures: Figures) -> str:
    found = figures.get("6")
    if found is None:
        return "\n".join(missing(number) for number in "67")
    drawing, facts = found
    before, after = np.array(facts["before"]), np.array(facts["after"])
    write_csv(figures.folder / "figure-06.csv",
              ["component", "magnitude_before", "magnitude_after", "difference"],
              zip(range(1, len(before) + 1), before.tolist(), after.tolist(),
                  (after - before).tolist()))
    k = COMPONENT - 1
    six = figure("6", NAMES["6"], f"""<b>Figure 6.</b> Difference of the spectra after component
{COMPONENT} was doubled. {stands_for(drawing)} c{COMPONENT} became {after[k] / before[k]:.2f} times
as large instead of twice, and other magnitudes changed that nobody touched: as the paper
observes.""", ["figure-06.csv"])
    seven = figure("7", NAMES["7"], f"""<b>Figure 7.</b> The meshes of Figure 6. GeomDiff
{facts["geometric"]:.3f} %, CurvDiff {facts["curvature"]:.4f} %.""")
    return "\n".join([six, seven])


def _evolution(figures: Figures) -> str:
    found = figures.get("8")
    if found is None:
        return missing("8")
    drawing, facts = found
    write_csv(figures.folder / "figure-08.csv", ["iteration", "carrier", "average"],
              zip(range(len(facts["carrier"])), facts["carrier"], facts["average"]))
    tried = "; ".join(f"{escape(name)} with s = {turbulence:g}: {_times(iterations)}"
                      for name, turbulence, iterations in facts["tried"])
    return figure("8", NAMES["8"], f"""<b>Figure 8.</b> c{COMPONENT} and the average of its slot,
components 45 to 54, while a 1 is embedded. {stands_for(drawing, facts["model"])} The turbulence
factor s is {facts["turbulence"]:g}; the carrier is above the average after
{_times(facts["iterations"])}. In the paper it took several on Igea; what was tried here, in
this order: {tried}.""", ["figure-08.csv"])


def _times(iterations: int) -> str:
    return f"{iterations} iteration" + ("" if iterations == 1 else "s")


def write_marks(figures: Figures) -> str:
    """Figures 9 to 12: distortion in the four modes."""
    return """
<h2 id="figures-marks">Figures 9 to 12: what a mark looks like</h2>
<p>Original, marked, and both distortions in colour: one figure for each mode.</p>
""" + _each(figures, ("9", "10", "11", "12"), _mark)


def _each(
    figures: Figures, numbers: Sequence[str], write: Callable[[Drawing, dict], str]
) -> str:
    parts = []
    for number in numbers:
        found = figures.get(number)
        parts.append(missing(number) if found is None else write(*found))
    return "\n".join(parts)


def _mark(drawing: Drawing, facts: dict) -> str:
    mode = MODE[drawing.arguments[1]]
    return figure(drawing.number, NAMES[drawing.number], f"""<b>Figure {drawing.number}.</b>
{mode.title} embedding. {stands_for(drawing)} {_marked(facts)} GeomDiff {facts["geometric"]:.3f} %,
CurvDiff {facts["curvature"]:.4f} %.""")


def _marked(facts: dict) -> str:
    failed = facts["failed"] if facts["converged"] else facts["failed"][:-1]
    first = f"Embedding {', '.join(failed)} did not converge. " if failed else ""
    if facts["converged"]:
        return f"{first}Marked with {facts['message']} in {_times(facts['iterations'])}."
    return (f"{first}Embedding {facts['message']} did not converge either: the best mesh reads "
            f"{facts['read']}.")


def write_attacks(figures: Figures) -> str:
    """Figures 13 to 16: attacked meshes."""
    return ('<h3 id="figures-attacks">Figures 13 to 16: attacked meshes</h3>\n' +
            _each(figures, ("13", "14", "15", "16"), _attack))


def _attack(drawing: Drawing, facts: dict) -> str:
    mode = MODE[drawing.arguments[1]]
    readings = " ".join(_reading(reading) for reading in facts["readings"])
    unnamed = " (the paper does not name the mode of this figure)" if drawing.number == "13" else ""
    return figure(drawing.number, NAMES[drawing.number], f"""<b>Figure {drawing.number}.</b>
{mode.title} embedding{unnamed}. {stands_for(drawing)} {_marked(facts)} {readings} In the paper all
bits are right.""")


def _reading(reading: dict) -> str:
    right = "all bits right" if reading["errors"] == 0 else f"{reading['errors']} wrong"
    return (f"After {escape(reading['title'])} ({reading['vertices']:,} vertices), it reads "
            f"{reading['read']}: {right}.")
