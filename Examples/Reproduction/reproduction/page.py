# SPDX-License-Identifier: BSD-3-Clause
"""The page: the paper's tables and figures beside ours, in words and numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from spectralwatermark.report.html import STYLE, Line, percent, table

from . import (
    paper,
    results,
    section_detection,
    section_differences,
    section_figures,
    section_robustness,
    section_tables,
)
from .experiments import MODES
from .files import INDEX, write_text
from .models import FOLDER_VARIABLE
from .plan import Plan
from .section_figures import Figures
from .store import CACHE, Store
from .work import Failure, by_message

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


@dataclass(frozen=True)
class Run:
    """What the page is about."""

    plan: Plan
    store: Store
    failures: Sequence[Failure]
    builds: int  # of the filters that the results came from


def write(run: Run, folder: Path) -> set[str]:
    """Writes tables, pictures of results, and the page; returns the files that failed."""
    plan, store = run.plan, run.store
    figures = Figures(plan, store, folder)
    body = "\n".join([
        _introduction(plan),
        _contents(),
        _glance(plan, store),
        _compared(plan),
        section_tables.write(plan, store, folder),
        section_figures.write_basis(figures),
        section_figures.write_marks(figures),
        section_robustness.write(plan, store, folder),
        section_figures.write_attacks(figures),
        section_tables.write_timing(plan, store, folder),
        section_detection.write(plan, store, folder),
        section_differences.write(plan, store),
        _failures(run),
        _again(run),
    ])
    write_text(folder / INDEX, f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Robust spectral watermarking, reproduced</title>
<style>{STYLE}</style>
</head>
<body>
{_unbroken(body)}
</body>
</html>
""")
    return figures.failed_files()


def _unbroken(html: str) -> str:
    """No line ends between a number and its percent sign."""
    return html.replace(" %", "\u00a0%")


def _introduction(plan: Plan) -> str:
    form = """<p class="note">This is the <b>quick form</b>: a few small meshes stand in for all
others, few messages are tried, and some strengths of the attacks are left out. Averages over so few
cases are rough.</p>""" if plan.quick else ""
    pebble = f"""<p class="note">No folder of scans was found, so everything below is shown on one
artificial <b>pebble</b>, which comes with the program. Name a folder of PLY meshes with
<code>--meshes</code> or <code>{FOLDER_VARIABLE}</code> to see real ones.</p>""" \
        if plan.pebble_only else ""
    return f"""
<h1>Robust spectral watermarking, reproduced</h1>
<p class="lead">Does this implementation do what the paper says? Every table and figure of
“{paper.TITLE}” ({paper.AUTHORS}), computed again and laid beside the original, with what did not
come out the same.</p>
<p>A bit is hidden in a triangle mesh by changing the strength of one of its <i>manifold
harmonics</i>: the vibrations of the surface, which take the place of a Fourier basis. Which
frequencies a shape is made of hardly depends on how it is triangulated or where it stands, so the
mark can be read <i>blind</i>, from a copy alone, after it was moved, noised or simplified. Each bit
has a <i>slot</i> of ten neighbouring components; one of them, the <i>carrier</i>, is made larger
than the average of others in its slot for a 1, smaller for a 0. <i>Normal</i> slots compare it with
eight others, <i>narrow</i> ones with its two neighbours. <i>Aggressive</i> embedding moves every
carrier at least a standard deviation away from the average, <i>non-aggressive</i> embedding only
those on the wrong side.</p>
{pebble}{form}"""


def _contents() -> str:
    items = "\n".join(f'<li><a href="#{place}">{escape(title)}</a></li>'
                      for place, title in CONTENTS)
    return f"<nav><ol>\n{items}\n</ol></nav>"


# --- At a glance -------------------------------------------------------------------------------


def _glance(plan: Plan, store: Store) -> str:
    items = [_marks_read(plan, store), _distortion(plan, store), _attacks(plan, store),
             _time(plan, store), _detection(plan, store)]
    return '<h2 id="glance">At a glance</h2>\n<ul class="glance">' + "\n".join(
        f"<li>{item}</li>" for item in items if item) + "</ul>"


def _marks_read(plan: Plan, store: Store) -> str:
    total = results.convergence(plan, store)
    shares = []
    for mode in MODES:
        counted = results.convergence(plan, store, [mode])
        shares.append(f"{mode.title.lower()} {counted.read} of {counted.marks}")
    return (f"<b>{total.read} of {total.marks} marks were embedded and read back blind</b> "
            f"({'; '.join(shares)}). The embedding's own word and the detector disagreed on "
            f"{total.contradictions}.")


def _distortion(plan: Plan, store: Store) -> str:
    mode = MODES[0]
    rows = results.embedding_rows(plan, store, mode)
    geometric = section_tables.median_of(rows, "geometric")
    iterations = section_tables.median_of(rows, "iterations")
    if geometric is None or iterations is None:
        return ""
    papers_geometric = section_tables.papers_median(mode, "geometric")
    papers_iterations = section_tables.papers_median(mode, "iterations")
    alike = all(0.5 <= ours / papers <= 2.0 for ours, papers in
                ((geometric, papers_geometric), (iterations, papers_iterations)))
    return (f"<b>Iterations and GeomDiff {'are' if alike else 'are not'} of the paper's size</b>: "
            f"in its Table 1 the median model takes {papers_iterations:.0f} iterations and moves "
            f"by {papers_geometric:.2f} % of the diagonal, here {iterations:.1f} and "
            f"{geometric:.2f} %. <b>CurvDiff is not</b>: the paper's does not follow from its "
            f'equation (<a href="#differences">why</a>).')


def _attacks(plan: Plan, store: Store) -> str:
    parts = []
    for title, mode, attack in (
            ("rotation, scaling and translation", 0, ("rotation", "scaling", "translation")),
            ("simplification to a half", 0, ("simplify-50",)),
            ("noise of 0.5", 0, ("noise-0.5",)), ("smoothing as printed", 0, ("smooth-dropped",)),
            ("smoothing with the rest kept", 0, ("smooth-kept",))):
        found = [results.robustness(plan, store, plan.robustness_models(), MODES[mode], key)
                 for key in attack]
        errors = [error for result in found for error in result.errors]
        if errors:
            share = sum(error == 0 for error in errors) / len(errors)
            parts.append(f"{title}: {percent(share)}")
    if not parts:
        return ""
    return ("<b>Messages read without any error</b>, in normal slots with aggressive embedding, "
            f'after {"; ".join(parts)} (<a href="#robustness">all attacks</a>).')


def _time(plan: Plan, store: Store) -> str:
    rows = section_tables.timings(plan, store)
    if not rows:
        return ""
    name, record = min(rows, key=lambda row: abs(row[1]["vertices"] - paper.VERTICES_IN_A_MINUTE))
    return (f"<b>The harmonics of {record['vertices']:,} vertices take "
            f"{record['seconds']:.1f} s</b> ({escape(name)}); the paper needed under a "
            "minute for 20,000 in 2008.")


def _detection(plan: Plan, store: Store) -> str:
    rates = results.false_positives(plan, store)
    if not rates:
        return ""
    broken = sum(int(rate.too_many(detector).sum()) for rate in rates
                 for detector in ("hard", "soft"))
    held = "no promised rate of false positives was exceeded" if broken == 0 else \
        f"{broken} of {2 * len(rates) * 5} promised rates of false positives were exceeded"
    cases = sum(rate.cases for rate in rates)
    return f'<b>Detection on unmarked meshes</b>: {held}, in {cases:,} trials with each of two ' \
           f'detectors (<a href="#detection">details</a>).'


# --- The rest ----------------------------------------------------------------------------------


def _compared(plan: Plan) -> str:
    lines = [Line([escape(model.name), f"{model.vertices:,}", f"{model.size:,}"])
             for model in plan.models]
    return f"""
<h2 id="compared">What is compared</h2>
<p>Our meshes, all PLY files of one folder. Most of the paper's 13 models are not public; those of
the same name (elephant, horse, igea) may be other decimations of the same scan. Which mesh stands
for which of the paper's is said under each figure. Lengths are given in percent of the original's
bounding-box diagonal, so that models of any unit compare.</p>
{table([["mesh", "vertices", "bytes"]], lines)}
<p>Key of five bits, slots of ten components from component 21 on, turbulence factor 1: the paper's
setting where it gives one. On a mesh of several components, which has as many constant harmonics,
the slots begin that many later.</p>"""


def _failures(run: Run) -> str:
    text = "<p>No experiment failed.</p>"
    if run.failures:
        items = "\n".join(
            f"<li><b>{escape(model)}</b>: {escape(message)} <span class=\"soft\">"
            f"({escape('; '.join(titles))})</span></li>"
            for (model, message), titles in by_message(run.failures).items())
        text = f"""<p>These experiments came to nothing, and the tables do without them. What the
filters said, and in brackets about what:</p>
<ul>{items}</ul>"""
    return f'<h2 id="failures">What failed</h2>\n{text}'


def _again(run: Run) -> str:
    builds = "" if run.builds <= 1 else f"""<p class="note">The results behind this page come from
<b>{run.builds} different builds</b> of the filters. To have them all from one:
<code>--fresh</code>.</p>"""
    quick = " --quick" if run.plan.quick else ""
    return f"""
<h2 id="again">Run it again</h2>
<p><code>Examples/Reproduction/reproduce_paper.py{quick}</code>, see its <code>--help</code>. Messages,
noise and keys are seeded: the numbers are the same in every run and with any number of processes,
save for the times. Every single experiment is a line of <a href="{CACHE}">{CACHE}</a>, so that an
interrupted run goes on where it was.</p>{builds}"""
