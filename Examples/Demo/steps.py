# SPDX-License-Identifier: BSD-3-Clause
"""The steps of the demonstration: embed a mark, attack the marked mesh, read every copy."""

from __future__ import annotations

import csv
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from spectralwatermark import (
    execution,
    vtkMeshDistortion,
    vtkSpectralWatermarkAlgorithm,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.attacks import attacks_on
from spectralwatermark.io import read_mesh, stores_float, write_file, write_mesh
from tqdm import tqdm
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

# Everybody can read this key. Yours belongs in a file: --key-file.
DEMONSTRATION_KEY = "the key of the demonstration"
FALSE_POSITIVE_RATE = 1e-6


class DemoError(Exception):
    """An error that the user can fix; its text says how."""


@dataclass
class Demo:
    """The state that the steps share."""

    original: vtkPolyData
    output: Path
    key_file: Path | None
    bits: int
    embed: vtkSpectralWatermarkEmbed = field(default_factory=vtkSpectralWatermarkEmbed)
    marked: vtkPolyData | None = None
    summary: dict = field(default_factory=dict)
    attacks: list[Attacked] = field(default_factory=list)


@dataclass
class Attacked:
    """An attacked copy and what the detector reads from it."""

    name: str
    mesh: vtkPolyData
    errors: int
    p_value: float
    detected: bool
    carriers: vtkTable


def embed(demo: Demo) -> None:
    """Embeds the mark and writes the mesh; all later steps use the mesh as the file stores it."""
    path = demo.output / "marked.ply"
    set_key(demo.embed, demo)
    demo.embed.SetInputData(demo.original)
    if stores_float(path):  # then the filter verifies the mark on coordinates of single precision
        demo.embed.SetOutputPointsPrecision(vtkAlgorithm.SINGLE_PRECISION)
    seconds = update(demo.embed, f"Embedding {demo.bits} bits of the key")
    if not demo.embed.GetConverged():
        raise DemoError(f"{demo.bits} bits could not be embedded in this mesh: try fewer (--bits)")

    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, demo.original)
    distortion.SetInputConnection(1, demo.embed.GetOutputPort())
    update(distortion, "Measuring the distortion")

    write_mesh(demo.embed.GetOutput(), path)
    demo.marked = read_mesh(path)
    demo.summary |= {
        "bits": demo.bits,
        "margin": demo.embed.GetMargin(),
        "embedding_seconds": round(seconds, 2),
        "mrms_percent": 100.0 * distortion.GetMRMS(),
        "msdm2": distortion.GetMSDM2(),
    }
    print(f"""
  {demo.bits} bits in {seconds:.1f} s, read back from the mesh as written
  the surface moved by  {100.0 * distortion.GetMRMS():.3f} % of the bounding-box diagonal (MRMS)
  visible distortion    {distortion.GetMSDM2():.2f}    (MSDM2: 0 none, 1 everything)
""")


def attack_and_detect(demo: Demo) -> None:
    """Attacks the marked mesh in every way and looks for the mark in each copy."""
    for name, attack in attacks_on(demo.marked):
        if attack is None:
            mesh = demo.marked
        else:
            update(attack, f"Attack: {name}")
            mesh = attack.GetOutput()
        demo.attacks.append(detect(demo, name, mesh))
    demo.attacks.append(detect(demo, "unmarked original", demo.original))
    demo.attacks.append(detect(demo, "marked, but another key", demo.marked, another_key=True))

    print(f"\n  {'attack':<34}{'vertices':>9}  {'wrong bits':>10}  {'p-value':>8}")
    for row in demo.attacks:
        print(f"  {row.name:<34}{row.mesh.GetNumberOfPoints():>9,}  {row.errors:>10}  "
              f"{row.p_value:>8.1g}  {'mine' if row.detected else 'not mine'}")
    print(f"""
  p-value: how likely an unmarked mesh, or one marked under another key, agrees as well by chance.
  "mine" is said at {FALSE_POSITIVE_RATE:g} or less: wrongly, once in a million meshes.""")
    write_file(demo.output / "attacks.csv", lambda path: write_table(demo.attacks, path))
    demo.summary["wrong_bits"] = {row.name: row.errors for row in demo.attacks}


def detect(demo: Demo, name: str, mesh: vtkPolyData, another_key: bool = False) -> Attacked:
    """Reads a copy with nothing but the mesh and the key."""
    detector = vtkSpectralWatermarkDetect()
    detector.SetInputData(mesh)
    set_key(detector, demo)
    if another_key:
        detector.SetSecretKeyFile("")
        detector.SetSecretKey("somebody else's key")
    detector.UseDerivedMessageOn()
    detector.SetFalsePositiveRate(FALSE_POSITIVE_RATE)
    update(detector, f"Detecting: {name}")
    return Attacked(name, mesh, round(detector.GetBitErrorRate() * demo.bits), detector.GetPValue(),
                    bool(detector.GetDetected()), detector.GetOutputDataObject(1))


def set_key(watermark: vtkSpectralWatermarkAlgorithm, demo: Demo) -> None:
    watermark.SetNumberOfBits(demo.bits)
    if demo.key_file is not None:
        watermark.SetSecretKeyFile(str(demo.key_file))
    else:
        watermark.SetSecretKey(DEMONSTRATION_KEY)


def write_table(rows: list[Attacked], path: Path) -> None:
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["attack", "vertices", "wrong_bits", "p_value", "detected"])
        for row in rows:
            table.writerow(
                [row.name, row.mesh.GetNumberOfPoints(), row.errors, row.p_value, row.detected])


# --- Progress ------------------------------------------------------------------------------------


def update(algorithm: vtkAlgorithm, what: str) -> float:
    """Updates the filter with visible progress; returns the seconds taken. Raises FilterError."""
    if not sys.stdout.isatty():
        say(what)
    bar = tqdm(total=1.0, desc=what, file=sys.stdout, disable=not sys.stdout.isatty(), ncols=90,
               bar_format="{desc:<40} {percentage:3.0f}% |{bar:30}| {remaining} left")
    started = time.monotonic()
    with bar:
        execution.update(algorithm, lambda progress: bar.update(progress - bar.n))
    return time.monotonic() - started


def say(what: str) -> None:
    print(what, flush=True)
