# SPDX-License-Identifier: BSD-3-Clause
"""The section "Where we differ from the paper": what it leaves open, and what did not reproduce."""

from __future__ import annotations

from . import paper, results
from .experiments import MODES
from .plan import Plan
from .store import Store

# The point, the paper's statement, our choice.
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
    ("percentages of Tables 1 to 4", "the reference length is not given",
     "of the original's bounding-box diagonal"),
    ("m of the smoothing attack", "not given",
     "300; both variants are tried: everything else dropped, as in the formula, or kept"),
    ("similarity (equation 8) across resolutions", "not explained, and signs are left open",
     "absolute value; the other mesh's harmonics at the closest points; repeated eigenvalues as "
     "the space that they span"),
    ("the carrier's place in its slot", "known to both sides only",
     "the fifth, as in section 3.2.1; the filters can draw it from a secret key, which the section "
     "on detection uses"),
    ("meshes of several components", "not considered",
     "each has its own constant harmonic; slots begin 20 components after the constant ones"),
)


def facts(plan: Plan, store: Store) -> dict:
    """What the section's template prints; ratios are CurvDiff in percent of GeomDiff."""
    marks = [mark for mode in MODES for model in plan.models
             for mark in results.marks_of(plan, store, model, mode).values() if mark["geometric"]]
    return {
        "choices": CHOICES,
        "papers_ratios": [100.0 * row.curvature / row.geometric for rows in paper.TABLES.values()
                          for row in rows.values()],
        "ratios": [100.0 * mark["curvature"] / mark["geometric"] for mark in marks],
        "lost_claims": [(claim, result) for claim, result in results.claims(plan, store)
                        if result.errors and result.share_read() < 1.0],
    }
