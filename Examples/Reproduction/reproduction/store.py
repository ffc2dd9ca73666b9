# SPDX-License-Identifier: BSD-3-Clause
"""Results that survive an interrupted run: one JSON line each, in the output folder."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import spectralwatermark.vtkFiltersSpectralWatermark as filters

from .experiments import REFUSED
from .models import Model

VERSION = "2"  # of the experiments; results of other versions are ignored
CACHE = "results.jsonl"


def build_fingerprint() -> str:
    """Identifies the build of the filters; the page says when results come from several builds."""
    module = Path(filters.__file__).resolve()
    libraries = sorted(module.parents[3].glob("libvtkFiltersSpectralWatermark.so*"))
    digest = hashlib.sha256()
    for path in [module, *libraries[:1]]:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:12]


def key_of(kind: str, model: Model, *details: str) -> str:
    return " ".join([kind, model.name, str(model.size), *details, f"v{VERSION}"])


class Store:
    """Records by key. put() writes each record to the file at once."""

    def __init__(self, folder: Path, fresh: bool) -> None:
        self.path = folder / CACHE
        self.build = build_fingerprint()
        self._records: dict[str, dict] = {}
        if fresh:
            self.path.unlink(missing_ok=True)
        elif self.path.exists():
            self._load()
        self.found = len(self._records)

    def _load(self) -> None:
        text = self.path.read_text(encoding="utf-8")
        for line in text.splitlines():
            try:
                entry = json.loads(line)
                self._records[entry["key"]] = entry
            except (ValueError, KeyError, TypeError):
                continue  # the line was cut off by an interruption
        if text and not text.endswith("\n"):
            with self.path.open("a", encoding="utf-8") as file:
                file.write("\n")

    def __contains__(self, key: str) -> bool:
        return key in self._records

    def get(self, key: str) -> dict | None:
        """The record, or None if there is none or a filter refused the experiment."""
        entry = self._records.get(key)
        return entry["record"] if entry and REFUSED not in entry["record"] else None

    def refused(self, keys: set[str]) -> list[tuple[str, str]]:
        """Experiments that a filter refused while others of the same task continued, each with
        the filter's message."""
        records = ((key, self._records[key]["record"]) for key in sorted(keys)
                   if key in self._records)
        return [(key, record[REFUSED]) for key, record in records if REFUSED in record]

    def put(self, key: str, record: dict) -> None:
        entry = {"key": key, "build": self.build, "record": record}
        self._records[key] = entry
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(entry) + "\n")

    def builds_of(self, keys: set[str]) -> set[str]:
        return {self._records[key]["build"] for key in keys if key in self._records}
