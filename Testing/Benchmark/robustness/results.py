# SPDX-License-Identifier: BSD-3-Clause
"""Results as files: one line for each marked mesh and for each reading, written at once."""

from __future__ import annotations

import csv
import statistics
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TypeVar


@dataclass
class Mark:
    """A marked mesh. Distances in percent of the diagonal."""

    scheme: str
    mesh: str
    key: str
    converged: int
    seconds: float
    displacement: float  # root mean square over the vertices
    mrms: float
    hausdorff: float
    msdm: float
    msdm2: float


@dataclass
class Outcome:
    """A reading after an attack."""

    scheme: str
    mesh: str
    key: str
    attack: str
    strength: str
    bit_error_rate: float
    p_value: float
    valid: int
    seconds: float


Row = TypeVar("Row", Mark, Outcome)


def read_rows(path: Path, kind: type[Row]) -> list[Row]:
    if not path.exists():
        return []
    types = {field.name: {"str": str, "int": int, "float": float}[field.type] for field in fields(kind)}
    with open(path, newline="", encoding="utf-8") as file:
        return [kind(**{name: types[name](value) for name, value in row.items()})
                for row in csv.DictReader(file)]


def append_row(path: Path, row: Row) -> None:
    is_new = not path.exists()
    with open(path, "a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(row)])
        if is_new:
            writer.writeheader()
        writer.writerow(asdict(row))


def mean(values: list[float]) -> float | None:
    return statistics.mean(values) if values else None
