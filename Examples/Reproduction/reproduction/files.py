# SPDX-License-Identifier: BSD-3-Clause
"""The output folder: its files, how they are written, and a check of the page."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from html.parser import HTMLParser
from pathlib import Path

from .figures import NAMES

INDEX = "index.html"
TABLES = (
    "table-1.csv", "table-2.csv", "table-3.csv", "table-4.csv", "marks.csv",
    "robustness-by-mode.csv", "robustness.csv", "timing.csv", "unmarked-bits.csv",
    "false-positives.csv", "roc.csv", "roc-curves.csv", "figure-02.csv", "figure-03.csv",
    "figure-06.csv", "figure-08.csv",
)
# Every file that a run can leave. The next run removes these and no others.
OUTPUTS = (INDEX, *TABLES, *NAMES.values())


def prepare(folder: Path, fresh: bool) -> None:
    """Removes the page first, so that an unfinished run leaves none.

    Pictures stay unless the run is a fresh one: a run that resumes reuses them.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name in OUTPUTS if fresh else (INDEX, *TABLES):
        (folder / name).unlink(missing_ok=True)
    for partial in (*folder.glob("*.partial"), *folder.glob("figure-*.partial.png"),
                    *folder.glob("roc*.partial.png")):
        partial.unlink()


def write_text(path: Path, text: str) -> None:
    """Writes the file whole or not at all."""
    partial = path.with_name(path.name + ".partial")
    partial.write_text(text, encoding="utf-8")
    partial.replace(path)


def write_csv(path: Path, header: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(header)
    for row in rows:
        table.writerow([f"{cell:.9g}" if isinstance(cell, float) else cell for cell in row])
    write_text(path, text.getvalue())


class _Links(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.targets: list[str] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name in ("href", "src") and value:
                self.targets.append(value)
            elif name == "id" and value:
                self.anchors.add(value)


def check(folder: Path, failed_figures: set[str]) -> list[str]:
    """Complaints about the page: files that are missing, empty or elsewhere, and missing anchors.

    The page must link every table and figure except the figures known to have failed.
    """
    page = folder / INDEX
    if not page.is_file():
        return [f"{INDEX} is missing"]
    links = _Links()
    links.feed(page.read_text(encoding="utf-8"))
    complaints = []
    for target in links.targets:
        if target.startswith("#"):
            if target[1:] not in links.anchors:
                complaints.append(f"the page has no anchor {target}")
        elif "/" in target or ":" in target:
            complaints.append(f"{target} is not in the page's folder")
        elif not (folder / target).is_file() or (folder / target).stat().st_size == 0:
            complaints.append(f"{target} is missing or empty")
    for name in OUTPUTS:
        if name != INDEX and name not in links.targets and name not in failed_figures:
            complaints.append(f"{name} is not on the page")
    return complaints
