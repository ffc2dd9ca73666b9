# SPDX-License-Identifier: BSD-3-Clause
"""The available meshes, and which of them stand for the paper's."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[3]  # of the project
PEBBLE = SOURCE / "Data" / "pebble.ply"
DEFAULT_FOLDER = SOURCE.parent / "shared" / "meshes"
FOLDER_VARIABLE = "SPECTRALWATERMARK_MESH_DIR"

# For each of the paper's models our candidates, the best first. A model of the same name is the
# same scan, perhaps in another resolution; the others are only of the same kind.
STAND_INS = {
    "Kitten": ("bunny", "bimba", "fertility"),
    "Iphigenia": ("nefertiti", "bimba", "fertility"),
    "Igea": ("igea", "elephant"),
    "Dinosaur": ("armadillo", "elephant"),
    "Gargoyle": ("beast", "cow"),
    "Greek": ("bimba", "fertility"),
    "Shell": ("rocker-arm", "fertility"),
    "Elephant": ("elephant",),
    "Topology": ("casting", "fertility"),
}

# Front and up direction of scans that do not stand upright in their file.
ORIENTATIONS = {
    "nefertiti": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
}
UPRIGHT = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0))


class NoModels(Exception):
    """The folder of meshes is unusable; the text says how to fix it."""


@dataclass(frozen=True)
class Model:
    """A mesh in a file."""

    name: str
    path: Path
    vertices: int
    size: int  # bytes of the file; name and size identify the content


@dataclass(frozen=True)
class Collection:
    """The PLY meshes of a folder."""

    models: tuple[Model, ...]  # the smallest first
    unreadable: tuple[str, ...]  # names of files that are not PLY meshes
    pebble_only: bool  # no folder was found


def find_models(folder: Path | None) -> Collection:
    chosen = folder or Path(os.environ.get(FOLDER_VARIABLE) or DEFAULT_FOLDER)
    if folder is not None and not folder.is_dir():
        raise NoModels(f"folder not found: {folder}")
    files = sorted(chosen.glob("*.ply")) if chosen.is_dir() else []
    if folder is not None and not files:
        raise NoModels(f"no PLY meshes in {folder}")
    read = {path: _model(path) for path in files or [PEBBLE]}
    models = [model for model in read.values() if model is not None]
    if not models:
        raise NoModels(f"no PLY mesh with vertices in {chosen}")
    models.sort(key=lambda model: (model.vertices, model.name))
    unreadable = tuple(path.name for path, model in read.items() if model is None)
    return Collection(tuple(models), unreadable, not files)


def _model(path: Path) -> Model | None:
    """Reads only the header, because some meshes are large; None if it is not that of a mesh."""
    with path.open("rb") as file:
        for line in file:
            words = line.split()
            if words[:2] == [b"element", b"vertex"]:
                vertices = int(words[2]) if words[2:] and words[2].isdigit() else 0
                size = path.stat().st_size
                return Model(path.stem, path, vertices, size) if vertices else None
            if words == [b"end_header"]:
                break
    return None


def stand_in(models: Sequence[Model], papers: str) -> Model:
    """Our mesh for one of the paper's models: a listed one if possible, otherwise any."""
    by_name = {model.name: model for model in models}
    for name in STAND_INS[papers]:
        if name in by_name:
            return by_name[name]
    return models[list(STAND_INS).index(papers) % len(models)]
