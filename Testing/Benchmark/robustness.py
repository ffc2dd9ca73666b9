#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How many bits of the scheme Robust survive which attack: meshes x budgets x keys x attacks.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Benchmark/robustness.py \\
        bunny horse --keys 2 --output robustness

Attacks and strengths are those of the benchmark of Wang and others (2010), and some more. Messages of
64 bits are derived from the keys. Every result goes into OUTPUT/results.csv as soon as it is there:
interrupted, the same command goes on where it was. At the end a table of the bit error rates' means,
with those that the benchmark's authors publish for the mesh Venus beside them. Debian's packages
python3-numpy and python3-tqdm.
"""

from __future__ import annotations

import argparse
import csv
import os
import statistics
from collections.abc import Callable, Iterator
from pathlib import Path

from tqdm import tqdm
from vtkmodules.vtkIOPLY import vtkPLYReader

from spectralwatermark import (
    vtkMeshAttack,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)

SOURCE = Path(__file__).resolve().parents[2]
COLUMNS = ("mesh", "budget", "key", "attack", "strength", "bit_error_rate", "p_value", "valid",
           "distortion", "converged")
Case = tuple[str, str, str, str, str]  # the first five columns


def property_setter(attack: str, setter: str | None = None, **fixed: int):
    def apply(filter_: vtkMeshAttack, strength: float) -> None:
        getattr(filter_, f"SetAttackTo{attack}")()
        for name, value in fixed.items():
            getattr(filter_, f"Set{name}")(value)
        if setter:
            getattr(filter_, f"Set{setter}")(int(strength) if strength == int(strength) else strength)
    return apply


# Name, what sets it up, strengths.
ATTACKS: tuple[tuple[str, Callable, tuple[float, ...]], ...] = (
    ("none", property_setter("Translation"), (0,)),
    ("similarity", property_setter("Similarity", "Seed"), (1, 2)),
    ("reordering", property_setter("VertexReordering", "Seed"), (1,)),
    ("noise %", property_setter("NoiseUniform", "NoisePercent"), (0.05, 0.1, 0.3, 0.5)),
    ("smoothing", property_setter("LaplacianSmoothing", "SmoothingIterations"), (5, 10, 30, 50)),
    ("quantization", property_setter("Quantization", "QuantizationBits"), (11, 10, 9, 8, 7)),
    ("midpoint", property_setter("Subdivision", SubdivisionType=0), (1,)),
    ("sqrt3", property_setter("Subdivision", SubdivisionType=2), (1,)),
    ("Loop", property_setter("Subdivision", SubdivisionType=1), (1,)),
    ("simplification %", property_setter("Simplification", "SimplificationPercent"),
     (10, 30, 50, 70, 90, 95)),
    ("remeshing %", property_setter("Remeshing", "RemeshingPercent", RemeshingMethod=0), (100,)),
    ("isosurface", property_setter("Remeshing", "IsosurfaceResolution", RemeshingMethod=1), (256,)),
    ("cropping %", property_setter("Cropping", "CroppingPercent"), (10, 30)),
)

# Bit error rates on Venus, 64 bits: Cho 2007 and Wang 2009, at a perceptual budget.
PUBLISHED = {
    ("noise %", 0.05): (0.01, 0.0), ("noise %", 0.1): (0.03, 0.01), ("noise %", 0.3): (0.13, 0.08),
    ("noise %", 0.5): (0.28, 0.16), ("smoothing", 5): (0.10, 0.0), ("smoothing", 10): (0.23, 0.01),
    ("smoothing", 30): (0.38, 0.07), ("smoothing", 50): (0.45, 0.14),
    ("quantization", 11): (0.0, 0.0), ("quantization", 10): (0.04, 0.01),
    ("quantization", 9): (0.14, 0.01), ("quantization", 8): (0.26, 0.05),
    ("quantization", 7): (0.46, 0.17), ("midpoint", 1): (0.04, 0.0), ("sqrt3", 1): (0.14, 0.0),
    ("Loop", 1): (0.16, 0.0),
}


def read_mesh(path: Path):
    reader = vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def secret(key: str) -> str:
    return f"robustness key {key}"


class Marked:
    """One marked mesh, made when it is first asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.case: tuple[str, str, str] | None = None
        self.embed = vtkSpectralWatermarkEmbed()

    def get(self, mesh: str, budget: str, key: str) -> vtkSpectralWatermarkEmbed:
        if self.case != (mesh, budget, key):
            self.case = (mesh, budget, key)
            self.embed = vtkSpectralWatermarkEmbed()
            self.embed.SetInputData(read_mesh(self.folder / f"{mesh}.ply"))
            self.embed.SetSchemeToRobust()
            self.embed.SetSecretKey(secret(key))
            self.embed.SetMaximumDistortion(float(budget))
            self.embed.Update()
        return self.embed


def attack_and_detect(marked, attack: str, strength: float, key: str):
    filter_ = vtkMeshAttack()
    filter_.SetInputData(marked)
    next(set_up for name, set_up, _ in ATTACKS if name == attack)(filter_, strength)
    detect = vtkSpectralWatermarkDetect()
    detect.SetInputConnection(filter_.GetOutputPort())
    detect.SetSchemeToRobust()
    detect.SetSecretKey(secret(key))
    detect.UseDerivedMessageOn()
    detect.Update()
    return detect


def cases(arguments: argparse.Namespace) -> Iterator[Case]:
    for mesh in arguments.meshes:
        for budget in arguments.budgets:
            for key in range(1, arguments.keys + 1):
                for attack, _, strengths in ATTACKS:
                    for strength in strengths:
                        yield mesh, budget, str(key), attack, f"{strength:g}"


def read_results(path: Path) -> dict[Case, dict[str, str]]:
    if not path.exists():
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        return {tuple(row[name] for name in COLUMNS[:5]): row for row in csv.DictReader(file)}


def run(arguments: argparse.Namespace) -> dict[Case, dict[str, str]]:
    arguments.output.mkdir(parents=True, exist_ok=True)
    path = arguments.output / "results.csv"
    results = read_results(path)
    missing = [case for case in cases(arguments) if case not in results]
    marked = Marked(arguments.meshes_folder)
    with open(path, "a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        if file.tell() == 0:
            writer.writeheader()
        for case in tqdm(missing, unit="attack"):
            mesh, budget, key, attack, strength = case
            embed = marked.get(mesh, budget, key)
            detect = attack_and_detect(embed.GetOutput(), attack, float(strength), key)
            row = dict(zip(COLUMNS, (*case, detect.GetBitErrorRate(), detect.GetPValue(),
                                     detect.GetMessageIsValid(), embed.GetDistortion(),
                                     embed.GetConverged())))
            writer.writerow(row)
            file.flush()
            results[case] = {name: str(value) for name, value in row.items()}
    return results


def print_table(arguments: argparse.Namespace, results: dict[Case, dict[str, str]]) -> None:
    print(f"{'bit error rates (means)':<24}" + "".join(f"{b + ' %':>10}" for b in arguments.budgets) +
          f"{'found':>10}{'Cho':>8}{'Wang':>8}")
    for attack, _, strengths in ATTACKS:
        for strength in strengths:
            line = f"{attack + ' ' + format(strength, 'g'):<24}"
            found = []
            for budget in arguments.budgets:
                rows = [row for case, row in results.items()
                        if case[0] in arguments.meshes and case[1] == budget and
                        case[3:] == (attack, f"{strength:g}")]
                line += f"{statistics.mean(float(row['bit_error_rate']) for row in rows):>10.3f}"
                found.append(sum(float(row["p_value"]) <= 1e-6 for row in rows) / len(rows))
            line += f"{'/'.join(f'{share:.0%}' for share in found):>10}"
            for rate in PUBLISHED.get((attack, strength), ()):
                line += f"{rate:>8.2f}"
            print(line)


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", metavar="MESH", help="bunny, horse, ...")
    parser.add_argument("--budgets", nargs="+", default=["0.07", "0.018"], metavar="PERCENT",
                        help="MaximumDistortion of each (default: 0.07 0.018)")
    parser.add_argument("--keys", type=int, default=2, help="how many (default: 2)")
    parser.add_argument("--output", type=Path, default=Path("robustness"))
    parser.add_argument("--meshes-folder", type=Path, default=Path(
        os.environ.get("SPECTRALWATERMARK_MESH_DIR") or SOURCE.parent / "shared" / "meshes"))
    return parser.parse_args()


def main() -> None:
    arguments = parse()
    print_table(arguments, run(arguments))


if __name__ == "__main__":
    main()
