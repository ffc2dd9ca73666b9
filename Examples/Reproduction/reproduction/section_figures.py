# SPDX-License-Identifier: BSD-3-Clause
"""The numbers in the captions of the figures."""

from __future__ import annotations

from pathlib import Path

from . import plan as planning
from .files import write_csv
from .plan import Drawing, Plan
from .store import Store


class Figures:
    """The drawings of a run with the numbers that they returned, some also written as files."""

    def __init__(self, plan: Plan, store: Store, folder: Path) -> None:
        self._drawings = {drawing.number: drawing for drawing in planning.drawings(plan)}
        self._facts = {number: store.get(drawing.key())
                       for number, drawing in self._drawings.items()}
        for number, write in (("2", _write_similarity), ("3", _write_doubling),
                              ("6", _write_difference), ("8", _write_evolution)):
            if self._facts[number] is not None:
                write(folder / f"figure-{int(number):02d}.csv", self._facts[number])

    def get(self, number: str) -> tuple[Drawing, dict] | None:
        """The drawing and its numbers, unless it failed."""
        facts = self._facts[number]
        return None if facts is None else (self._drawings[number], facts)

    def failed_files(self) -> set[str]:
        """The files that are missing because their drawing failed."""
        missing = set()
        for number, drawing in self._drawings.items():
            if self._facts[number] is None:
                missing |= set(drawing.files)
                missing |= {f"figure-{int(number):02d}.csv"}
        return missing


def stands_for(drawing: Drawing, name: str = "") -> str:
    """Says which mesh this is, and whether it is the paper's."""
    name = name or drawing.model.name
    if name == drawing.papers.lower():
        return f"{drawing.papers}, as in the paper, perhaps in another resolution."
    return f"Here {name} stands for the paper's {drawing.papers}."


def _write_similarity(path: Path, facts: dict) -> None:
    write_csv(path, ["component", "similarity"], enumerate(facts["similarity"], start=1))


def _write_doubling(path: Path, facts: dict) -> None:
    rows = zip(facts["similarity"], facts["before"], facts["after"])
    write_csv(path, ["component", "similarity", "magnitude_before", "magnitude_after"],
              [[number, *row] for number, row in enumerate(rows, start=1)])


def _write_difference(path: Path, facts: dict) -> None:
    rows = zip(facts["before"], facts["after"])
    write_csv(path, ["component", "magnitude_before", "magnitude_after", "difference"],
              [[number, before, after, after - before]
               for number, (before, after) in enumerate(rows, start=1)])


def _write_evolution(path: Path, facts: dict) -> None:
    rows = zip(facts["carrier"], facts["average"])
    write_csv(path, ["iteration", "carrier", "average"],
              [[iteration, *row] for iteration, row in enumerate(rows)])
