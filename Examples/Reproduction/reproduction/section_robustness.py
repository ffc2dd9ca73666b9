# SPDX-License-Identifier: BSD-3-Clause
"""Section "Robustness": the paper's claims, and every attack at every strength."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from spectralwatermark.report.html import Cell, Line, heat, percent, table

from . import results
from .experiments import ATTACK, MODES, UNATTACKED, Mode
from .files import write_csv
from .models import Model
from .plan import ATTACKED_MESSAGES, Plan
from .results import Robustness
from .spectra import BITS
from .store import Store

CHANCE = BITS / 2.0  # errors when nothing is left of a mark
NOTHING = Cell("–", "soft")


def write(plan: Plan, store: Store, folder: Path) -> str:
    small = plan.robustness_models()
    _write_single(plan, store, folder)
    names = ", ".join(model.name for model in small)
    parts = [f"""
<h2 id="robustness">Section 3.3: robustness</h2>
<p>Marked meshes are attacked and read blind, with nothing but the attacked mesh. Only marks that
were there before the attack take part. Each cell gives the mean number of wrong bits, of five, and
the share of messages that are read without any error; {CHANCE} wrong bits is what a coin would
give. Noise is in mean edge lengths (the paper's s), simplification in percent of the triangles
removed; smoothing halves the harmonics from 201 to 300 and either drops all that is outside of
these 300, as the paper's formula does, or keeps it.</p>
<h3 id="claims">The paper's claims</h3>
<p>What it says was read without error on one model each, and how it went on all of ours.</p>"""]
    parts.append(_claims(plan, store))
    parts.append(f"""<h3 id="by-mode">All attacks, by mode</h3>
<p>Over {escape(names)}, with {min(len(plan.messages), ATTACKED_MESSAGES)} messages each.</p>""")
    parts.append(_by_mode(plan, store, small, folder))
    parts.append("""<h3 id="by-mesh">All attacks, by mesh</h3>
<p>Normal slots, aggressive embedding, as in the paper's Table 1. Under each name is the number of
vertices: edges get shorter with it, and with them the noise.</p>""")
    parts.append(_by_mesh(plan, store))
    return "\n".join(parts)


def _claims(plan: Plan, store: Store) -> str:
    lines = []
    for claim, result in results.claims(plan, store):
        mode = next(mode for mode in MODES if mode.key == claim.mode)
        cells = [Cell(escape(claim.text), "wrap"), Cell(escape(mode.title.lower()), "text")]
        same = results.robustness(plan, store,
                                  [model for model in plan.models if model.name == claim.model],
                                  mode, claim.attack)
        cells.append(read_of(same) if same.errors else NOTHING)
        if result.errors:
            held = result.share_read() == 1.0
            cells += [read_of(result), f"{result.mean():.2f}",
                      Cell(verdict_of(result), "good" if held else "bad")]
        else:
            cells += [NOTHING] * 3
        lines.append(Line(cells))
    headers = [["", "", Cell("read without error", "group", span=2), "", ""],
               ["claim", Cell("mode", "text"), "same model", "all meshes", "mean wrong bits",
                "here"]]
    return table(headers, lines)


def read_of(result: Robustness) -> str:
    return f"{sum(errors == 0 for errors in result.errors)} of {len(result.errors)}"


def verdict_of(result: Robustness) -> str:
    share = result.share_read()
    if share == 1.0:
        return "holds"
    if share >= 0.9:
        return "holds nearly always"
    return "holds at times" if share >= 0.1 else "does not hold"


def _by_mode(plan: Plan, store: Store, models: Sequence[Model], folder: Path) -> str:
    lines, rows = [], []
    for attack in (UNATTACKED, *plan.attacks):
        columns = {mode: results.robustness(plan, store, models, mode, attack) for mode in MODES}
        lines.append(Line([_title(attack), *(_cell(result) for result in columns.values())]))
        rows += [[mode.key, attack, len(result.errors), result.mean(), result.share_read()]
                 for mode, result in columns.items() if result.errors]
    write_csv(folder / "robustness-by-mode.csv",
              ["mode", "attack", "marks", "mean_bit_errors", "share_without_error"], rows)
    headers = [["", Cell("normal slots", "group", span=2), Cell("narrow slots", "group", span=2)],
               ["attack", *["aggressive", "non-aggressive"] * 2]]
    return table(headers, lines, ["robustness-by-mode.csv"])


def _by_mesh(plan: Plan, store: Store) -> str:
    models = [*plan.robustness_models(), *results.large_models(plan)]
    mode = MODES[0]
    lines = []
    for attack in plan.attacks:
        cells = [_cell(results.robustness(plan, store, [model], mode, attack))
                 for model in models]
        lines.append(Line([_title(attack), *cells]))
    headers = [["", *(escape(model.name) for model in models)],
               ["attack", *(f"{model.vertices:,}" for model in models)]]
    return table(headers, lines, ["robustness.csv"])


def _title(attack: str) -> str:
    return "no attack" if attack == UNATTACKED else escape(ATTACK[attack].title)


def _cell(result: Robustness) -> Cell:
    if not result.errors:
        return NOTHING
    text = f'{result.mean():.2f} <span class="soft">· {percent(result.share_read())}</span>'
    return Cell(text, "", heat(result.mean() / CHANCE))


def _write_single(plan: Plan, store: Store, folder: Path) -> None:
    rows = []
    for mode in MODES:
        for model in plan.models:
            rows += _rows_of(plan, store, mode, model)
    write_csv(folder / "robustness.csv",
              ["mesh", "mode", "attack", "marks", "mean_bit_errors", "share_without_error"], rows)


def _rows_of(plan: Plan, store: Store, mode: Mode, model: Model) -> list[list[object]]:
    rows = []
    for attack in plan.attacks:
        result = results.robustness(plan, store, [model], mode, attack)
        if result.errors:
            rows.append([model.name, mode.key, attack, len(result.errors), result.mean(),
                         result.share_read()])
    return rows
