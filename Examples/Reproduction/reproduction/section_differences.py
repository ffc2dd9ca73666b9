# SPDX-License-Identifier: BSD-3-Clause
"""Section "Where we differ from the paper": what it leaves open, and what did not come out."""

from __future__ import annotations

from html import escape

import numpy as np

from spectralwatermark.report.html import Cell, Line, table

from . import paper, results
from .experiments import MODES
from .plan import Plan
from .section_robustness import read_of, verdict_of
from .store import Store

# Point, what the paper says, what is done here.
CHOICES = (
    ("length of a harmonic", "divided by its norm ⟨H, H⟩",
     "⟨H, H⟩ = 1: divided by the norm's square root, without which nothing is orthonormal and "
     "equation 7 does not invert equation 6"),
    ("turbulence factor s", "not given", "1"),
    ("deviation d of a slot", "not defined",
     "the standard deviation of the references' magnitudes, by their number"),
    ("a target a − s d below 0", "not mentioned", "0, since magnitudes are not negative"),
    ("direction of a changed coefficient", "only its magnitude is given",
     "kept: x, y and z are scaled alike"),
    ("c = a in equation 12", "reads nothing", "reads 0"),
    ("building the marked mesh", "from its first m harmonics",
     "only the change of the spectrum is transformed back and added to the points; a mesh built "
     "from 70 harmonics would have lost its detail"),
    ("the extraction threshold", "some number of bits", "all bits; at most 20 iterations"),
    ("percentages of Tables 1 to 4", "of what is not said",
     "of the original's bounding-box diagonal"),
    ("m of the smoothing attack", "not given",
     "300; what is outside is dropped as the formula has it, or kept: both are tried"),
    ("similarity (equation 8) across resolutions", "not explained, and signs are left open",
     "absolute value; the other mesh's harmonics at the closest points; repeated eigenvalues as "
     "the space that they span"),
    ("the carrier's place in its slot", "known to both sides only",
     "the fifth, as in section 3.2.1; the filters can draw it from a secret key, which the section "
     "on detection uses"),
    ("meshes of several components", "not considered",
     "each has its own constant harmonic; slots begin 20 components after the constant ones"),
)


def write(plan: Plan, store: Store) -> str:
    choices = table([["", Cell("the paper", "text"), Cell("here", "text")]],
                    [Line([escape(point), Cell(escape(says), "wrap"), Cell(escape(done), "wrap")])
                     for point, says, done in CHOICES])
    return f"""
<h2 id="differences">Where we differ from the paper</h2>
<h3>What it leaves open</h3>
{choices}
<h3>A number that does not follow from its equations</h3>
<p>{_curvature(plan, store)}</p>
<h3>What did not converge</h3>
<p>{_convergence(plan, store)}</p>
<h3>Robustness that did not reproduce</h3>
{_robustness(plan, store)}"""


def _curvature(plan: Plan, store: Store) -> str:
    printed = [row.curvature / row.geometric for rows in paper.TABLES.values()
               for row in rows.values()]
    ours = [mark["curvature"] / mark["geometric"]
            for mode in MODES for model in plan.models
            for mark in results.marks_of(plan, store, model, mode).values() if mark["geometric"]]
    measured = "Here the equation is computed as printed and gives " \
               f"{100.0 * np.median(ours):.1f} % of GeomDiff in the median mark " \
               f"({100.0 * min(ours):.1f} to {100.0 * max(ours):.1f} %)." \
        if ours else ""
    return f"""In Tables 1 to 4 CurvDiff is {100.0 * min(printed):.1f} to {100.0 * max(printed):.1f}
% of GeomDiff in every one of {len(printed)} lines, {100.0 * np.mean(printed):.1f} % on average.
Equation 15 cannot give that: a vertex's geometric Laplacian is its distance from the mean of its
neighbours, and a mark in low harmonics moves a vertex and its neighbours nearly alike, so that the
Laplacian hardly changes. {measured} What the paper measured instead it does not say; nothing here
was tuned towards its numbers."""


def _convergence(plan: Plan, store: Store) -> str:
    parts = []
    for mode in MODES:
        counted = results.convergence(plan, store, [mode])
        parts.append(f"{mode.title.lower()} {counted.marks - counted.read} of {counted.marks}")
    total = results.convergence(plan, store)
    return f"""In the paper all models converge, with one message each. Here these did not within 20
iterations: {"; ".join(parts)}. Nothing guarantees convergence: a changed shape has other harmonics,
and where two eigenvalues nearly meet, the carrier's harmonic turns into its neighbour. Narrow slots
suffer most, since two references make an average that moves with either. What the embedding says of
itself was compared with what the blind detector reads: they disagreed on {total.contradictions} of
{total.marks} marks."""


def _robustness(plan: Plan, store: Store) -> str:
    lost = [(claim, result) for claim, result in results.claims(plan, store)
            if result.errors and result.share_read() < 1.0]
    if not lost:
        return "<p>All claims of section 3.3 held on all meshes of this run.</p>"
    items = "\n".join(
        f"<li>{escape(claim.text)}: {read_of(result)} messages read without error, "
        f"{result.mean():.2f} wrong bits of five on average; {verdict_of(result)}.</li>"
        for claim, result in lost)
    return f"""<p>The paper shows one model and one message for each of these; here, over all that
was tried:</p>
<ul>
{items}
</ul>
<p>Noise is measured in edge lengths, so that the same s is larger on a coarser mesh: see
<a href="#by-mesh">the attacks by mesh</a>. How many vertices the paper's noised models had it does
not say; its Igea had 100,000 triangles.</p>"""

