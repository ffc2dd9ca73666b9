#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Marks every mesh of a folder and records the distortion and the margin of each mark.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/batch_folder.py \
        FOLDER OUTPUT KEYFILE

OUTPUT gets the marked meshes and marks.csv; meshes that it already contains are skipped. A mesh that cannot be
read or marked is reported, and the others are still processed. (spectral-watermark embed FOLDER/* --output-dir
OUTPUT --key-file KEYFILE does much the same, for several meshes at a time.)
"""

import csv
import sys
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkEmbed
from spectralwatermark.io import MeshFileError, read_mesh, stores_float, write_mesh
from spectralwatermark.execution import FilterError, update

SUFFIXES = (".ply", ".obj", ".stl", ".vtp")


def main(folder: str, output: str, key_file: str) -> int:
    target = Path(output)
    target.mkdir(parents=True, exist_ok=True)
    if target.samefile(folder):
        sys.exit("OUTPUT is FOLDER: the originals would be lost; name another folder")
    failed = 0
    with (target / "marks.csv").open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["file", "points", "distortion_percent", "margin"])
        for path in sorted(Path(folder).iterdir()):
            if path.suffix.lower() not in SUFFIXES or (target / path.name).exists():
                continue
            try:
                table.writerow(mark(path, target / path.name, key_file))
                print(f"{path.name}: marked")
            except (MeshFileError, FilterError) as error:
                print(f"{path.name}: {error}", file=sys.stderr)
                failed += 1
    return 2 if failed else 0


def mark(path: Path, target: Path, key_file: str) -> list:
    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(read_mesh(path))
    embed.SetSecretKeyFile(key_file)
    if stores_float(target):  # then the filter verifies the mark in single precision
        embed.SetOutputPointsPrecision(embed.SINGLE_PRECISION)
    update(embed)
    if not embed.GetConverged():
        raise FilterError("the mark could not be embedded; nothing was written")
    write_mesh(embed.GetOutput(), target)
    return [path.name, embed.GetOutput().GetNumberOfPoints(), embed.GetDistortion(), embed.GetMargin()]


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
