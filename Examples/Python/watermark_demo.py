#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Watermarks a mesh with 64 bits of a secret key, attacks it, and asks each copy whose it is, blind.

What ./demo.sh runs. Leaves the marked mesh, tables and pictures in the output folder.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from spectralwatermark import (
    running,
    vtkManifoldHarmonics,
    vtkMeshDistortion,
    vtkSpectralWatermarkAlgorithm,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.attacks import attacks_on
from spectralwatermark.io import MeshFileError, read_mesh, stores_float, write_file, write_mesh
from tqdm import tqdm
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

BUNNY = Path("/usr/share/glmark2/models/bunny.obj")
# Everything that a run can leave behind: what the next run clears, and nothing else.
OUTPUTS = (
    "marked.ply",
    "attacks.csv",
    "summary.json",
    "comparison.png",
    "harmonics.png",
    "attacks.png",
    "spectrum.png",
    "carriers.png",
)
# Yours is better kept in a file: --key-file.
DEMONSTRATION_KEY = "the key of the demonstration"
FALSE_POSITIVE_RATE = 1e-6


class DemoError(Exception):
    """Something that the user can mend; its text is all they need."""


def main() -> int:
    arguments = parse_arguments()
    try:
        run(arguments)
    except (DemoError, MeshFileError, running.FilterError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="demo.sh", description=__doc__)
    parser.add_argument(
        "mesh",
        nargs="?",
        type=Path,
        default=BUNNY,
        help="a PLY, OBJ, STL, VTP or OFF file (default: the bunny of Debian's glmark2-data)",
    )
    parser.add_argument(
        "--output",
        type=Path,
        default=Path("demo-output"),
        help="folder for the results; those of an earlier run are cleared (default: %(default)s)",
    )
    parser.add_argument(
        "--key-file", type=Path, metavar="FILE",
        help="the secret, for example of head -c 32 /dev/urandom | base64 > FILE (default: a key of "
             "the demonstration, which everyone knows)")
    parser.add_argument("--bits", type=int, default=64,
                        help="how many, derived from the key (default: %(default)s)")
    parser.add_argument("--no-pictures", action="store_true", help="only the tables and the mesh")
    return parser.parse_args()


@dataclass
class Demo:
    """What the steps hand on to each other."""

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
    """One attack and what the detector made of it."""

    name: str
    mesh: vtkPolyData
    errors: int
    p_value: float
    detected: bool
    carriers: vtkTable


def run(arguments: argparse.Namespace) -> None:
    started = time.monotonic()
    if arguments.mesh == BUNNY and not BUNNY.is_file():
        raise DemoError(f"no such file: {BUNNY} (install Debian's glmark2-data, or name a mesh)")
    original = read_mesh(arguments.mesh)
    print(
        f"{arguments.mesh.name}: {original.GetNumberOfPoints():,} points, "
        f"{original.GetNumberOfPolys():,} polygons"
    )
    clear(arguments.output)
    demo = Demo(original, arguments.output, arguments.key_file, arguments.bits)
    embed(demo)
    attack_and_detect(demo)
    if not arguments.no_pictures:
        draw_pictures(demo)
    demo.summary["seconds"] = round(time.monotonic() - started, 1)
    write_file(demo.output / "summary.json", lambda path: path.write_text(
        json.dumps(demo.summary, indent=2) + "\n"))
    print(f"\nIn {demo.output}, after {demo.summary['seconds']:.0f} s:")
    for name in OUTPUTS:
        if (demo.output / name).exists():
            print(f"  {name}")
    if demo.key_file is None:
        print("\nMarked with the demonstration's key, which everyone knows. To protect a model: --key-file FILE.")


# --- Steps -------------------------------------------------------------------------------------


def embed(demo: Demo) -> None:
    """Embeds, writes the marked mesh, and takes the file as the mark's carrier from here on."""
    path = demo.output / "marked.ply"
    set_key(demo.embed, demo)
    demo.embed.SetInputData(demo.original)
    if stores_float(path):  # have the mark verified on the points as the file will hold them
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
    """Attacks the marked mesh in every way and asks whose each copy is."""
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
    """Asks with nothing but the mesh and the key."""
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


def draw_pictures(demo: Demo) -> None:
    """Draws everything; needs a display, real or virtual."""
    if not os.environ.get("DISPLAY"):
        print('\nNo display, no pictures. A virtual one will do: xvfb-run -a -s "-screen 0 '
              '1280x1024x24 -noreset" ...')
        return
    # Only now: the rendering modules need the display.
    from spectralwatermark import charts, pictures

    camera = pictures.view_of(demo.original)
    original, marked = (harmonics_of(mesh, name) for mesh, name in
                        ((demo.original, "original"), (demo.marked, "marked mesh")))
    say("Drawing")
    draw_comparison(demo, pictures, camera)
    draw_harmonics(demo, original.GetOutput(), pictures, camera)
    draw_attacks(demo, pictures)
    charts.write_spectra(demo.output / "spectrum.png", original.GetOutputDataObject(1),
                         marked.GetOutputDataObject(1))
    draw_carriers(demo, charts)


def harmonics_of(mesh: vtkPolyData, name: str) -> vtkManifoldHarmonics:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(min(100, mesh.GetNumberOfPoints()))
    update(harmonics, f"100 harmonics of the {name}")
    return harmonics


# --- Pictures ----------------------------------------------------------------------------------


def draw_comparison(demo: Demo, pictures, camera) -> None:
    """Original, marked, and how far each point moved."""
    percent = scaled_copy(demo.embed.GetOutput(), "GeometricDistortion", 100.0)
    limit = percent.GetPointData().GetArray("GeometricDistortion").GetRange()[1]
    pictures.write_panels(
        demo.output / "comparison.png",
        [
            pictures.Panel(demo.original, "original"),
            pictures.Panel(demo.marked, f"marked with {demo.bits} bits"),
            pictures.Panel(percent, "displacement", "GeometricDistortion", 0,
                           pictures.heat(limit), "percent of the bounding-box diagonal"),
        ],
        columns=3, size=560, camera=camera)


def draw_harmonics(demo: Demo, original: vtkPolyData, pictures, camera) -> None:
    """Some of the mesh's own waves, as the paper's Figure 2 shows them."""
    basis = original.GetPointData().GetArray("ManifoldHarmonics")
    eigenvalues = original.GetFieldData().GetArray("Eigenvalues")
    panels = []
    for number in (2, 6, 17, 26, 50, 100):
        if number > basis.GetNumberOfComponents():
            continue
        limit = 0.8 * max(abs(value) for value in basis.GetRange(number - 1))
        wavelength = 100.0 * 2.0 * 3.14159265 / eigenvalues.GetValue(number - 1) ** 0.5
        panels.append(pictures.Panel(
            original, f"harmonic {number}\n"
            f"wavelength {wavelength / demo.original.GetLength():.0f} % of the diagonal",
            "ManifoldHarmonics", number - 1, pictures.diverging(limit)))
    pictures.write_panels(demo.output / "harmonics.png", panels, columns=3, size=480,
                          camera=camera)


def draw_attacks(demo: Demo, pictures) -> None:
    """The attacked meshes with what is read from them."""
    shown = [row for row in demo.attacks[1:-2] if row.name != "vertices shuffled"]
    panels = [pictures.Panel(row.mesh, f"{row.name}\n{row.errors} wrong bits, p = {row.p_value:.0e}")
              for row in shown]
    pictures.write_panels(demo.output / "attacks.png", panels, columns=4, size=420)


def draw_carriers(demo: Demo, charts) -> None:
    """How firmly each carrier holds its bit of the code, in order, for some of the copies."""
    shown = ("none", "noise, 0.5 %", "quantized to 8 bits", "simplification, 90 % of the edges",
             "unmarked original")
    charts.write_carriers(demo.output / "carriers.png", [
        (row.name, row.carriers) for name in shown for row in demo.attacks if row.name == name])


def scaled_copy(mesh: vtkPolyData, array_name: str, factor: float) -> vtkPolyData:
    copy = vtkPolyData()
    copy.DeepCopy(mesh)
    values = vtk_to_numpy(copy.GetPointData().GetArray(array_name))  # a view
    values *= factor
    return copy


# --- Running filters ---------------------------------------------------------------------------


def update(algorithm: vtkAlgorithm, what: str) -> float:
    """Updates with visible progress; raises FilterError. Seconds taken."""
    if not sys.stdout.isatty():
        say(what)
    bar = tqdm(total=1.0, desc=what, file=sys.stdout, disable=not sys.stdout.isatty(), ncols=90,
               bar_format="{desc:<40} {percentage:3.0f}% |{bar:30}| {remaining} left")
    started = time.monotonic()
    with bar:
        running.update(algorithm, lambda progress: bar.update(progress - bar.n))
    return time.monotonic() - started


def say(what: str) -> None:
    print(what, flush=True)


# --- Files -------------------------------------------------------------------------------------


def clear(folder: Path) -> None:
    """Removes what an earlier run left, and no other file."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in OUTPUTS:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise DemoError(f"cannot write to {folder}: {error.strerror}") from error


def write_table(rows: list[Attacked], path: Path) -> None:
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["attack", "vertices", "wrong_bits", "p_value", "detected"])
        for row in rows:
            table.writerow(
                [row.name, row.mesh.GetNumberOfPoints(), row.errors, row.p_value, row.detected])


if __name__ == "__main__":
    sys.exit(main())
