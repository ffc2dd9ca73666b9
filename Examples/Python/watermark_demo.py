#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Watermarks a mesh with the paper's five bits, attacks it, and reads the mark again, blind.

What ./demo.sh runs. Leaves the marked mesh, tables and pictures in the output folder.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from reproduction import running
from spectralwatermark import (
    vtkManifoldHarmonics,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from spectralwatermark.mesh_io import MeshFileError, read_mesh, stores_float, write_mesh
from tqdm import tqdm
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
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
    "evolution.png",
)
SMOOTHING_HARMONICS = 300


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
    parser.add_argument("--message", default="10110", help="bits to embed (default: %(default)s)")
    parser.add_argument("--no-pictures", action="store_true", help="only the tables and the mesh")
    return parser.parse_args()


@dataclass
class Demo:
    """What the steps hand on to each other."""

    original: vtkPolyData
    output: Path
    message: str
    embed: vtkSpectralWatermarkEmbed = field(default_factory=vtkSpectralWatermarkEmbed)
    marked: vtkPolyData | None = None
    summary: dict = field(default_factory=dict)
    attacks: list[Attacked] = field(default_factory=list)


@dataclass
class Attacked:
    """One attack and what the detector made of it."""

    name: str
    mesh: vtkPolyData
    read: str
    errors: int
    p_value: float


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
    demo = Demo(original, arguments.output, arguments.message)
    embed(demo)
    attack_and_detect(demo)
    if not arguments.no_pictures:
        draw_pictures(demo)
    demo.summary["seconds"] = round(time.monotonic() - started, 1)
    write_whole(demo.output / "summary.json", lambda path: path.write_text(
        json.dumps(demo.summary, indent=2) + "\n"))
    print(f"\nIn {demo.output}, after {demo.summary['seconds']:.0f} s:")
    for name in OUTPUTS:
        if (demo.output / name).exists():
            print(f"  {name}")


# --- Steps -------------------------------------------------------------------------------------


def embed(demo: Demo) -> None:
    """Embeds, writes the marked mesh, and takes the file as the mark's carrier from here on."""
    path = demo.output / "marked.ply"
    demo.embed.SetInputData(demo.original)
    demo.embed.SetMessage(demo.message)
    if stores_float(path):  # have the mark verified on the points as the file will hold them
        demo.embed.SetOutputPointsPrecision(vtkAlgorithm.SINGLE_PRECISION)
    seconds = update(demo.embed, f"Embedding {demo.message}")

    distortion = vtkMeshDistortion()
    distortion.SetInputData(0, demo.original)
    distortion.SetInputConnection(1, demo.embed.GetOutputPort())
    update(distortion, "Measuring the distortion")

    write_mesh(demo.embed.GetOutput(), path)
    demo.marked = read_mesh(path)

    converged = bool(demo.embed.GetConverged())
    demo.summary |= {
        "message": demo.message,
        "converged": converged,
        "iterations": demo.embed.GetNumberOfIterationsUsed(),
        "embedding_seconds": round(seconds, 2),
        "geometric_difference_percent": 100.0 * distortion.GetGeomDiff(),
        "curvature_difference_percent": 100.0 * distortion.GetCurvDiff(),
    }
    print()
    if converged:
        print(f"  converged after {demo.embed.GetNumberOfIterationsUsed()} iterations, "
              f"reads {demo.embed.GetExtractedMessage()}")
    else:
        print(f"  did NOT converge: reads {demo.embed.GetExtractedMessage()} instead of "
              f"{demo.message}; going on with the best mesh reached")
    print(f"  geometric difference  {100.0 * distortion.GetGeomDiff():.3f} %   (eq. 13, of the "
          "bounding-box diagonal)")
    print(f"  curvature difference  {100.0 * distortion.GetCurvDiff():.4f} %  (eq. 15)\n")


def attack_and_detect(demo: Demo) -> None:
    """Attacks the marked mesh in every way and reads it blind after each."""
    for name, attack in attacks_on(demo.marked):
        if attack is None:
            mesh = demo.marked
        else:
            update(attack, f"Attack: {name}")
            mesh = attack.GetOutput()
        demo.attacks.append(detect(demo, name, mesh))
    demo.attacks.append(detect(demo, "unmarked original", demo.original))

    print(f"\n  {'attack':<28}{'vertices':>9}  {'bits read':<{len(demo.message) + 6}}"
          f"{'errors':>6}{'p-value':>9}")
    for row in demo.attacks:
        print(f"  {row.name:<28}{row.mesh.GetNumberOfPoints():>9,}  "
              f"{row.read:<{len(demo.message) + 6}}{row.errors:>6}{row.p_value:>9.3f}")
    certainty = min(row.p_value for row in demo.attacks)
    print(f"\n  p-value: how likely an unmarked mesh agrees as well, at most. {len(demo.message)} bits "
          f"come down to {certainty:.2g}: these\n  rows show what the mark survives, they do not prove "
          "ownership.")
    write_whole(demo.output / "attacks.csv", lambda path: write_table(demo.attacks, path))
    demo.summary["bit_errors"] = {row.name: row.errors for row in demo.attacks}


def attacks_on(mesh: vtkPolyData) -> list[tuple[str, vtkMeshAttack | None]]:
    """The paper's attacks (section 3.3), by name."""
    diagonal = mesh.GetLength()
    return [
        ("none", None),
        ("rotation by 100 degrees",
         attack_on(mesh, vtkMeshAttack.Rotation, RotationAxis=(1, 2, 3), RotationAngle=100.0)),
        ("scaling by 3", attack_on(mesh, vtkMeshAttack.UniformScaling, ScaleFactor=3.0)),
        ("translation by a diagonal",
         attack_on(mesh, vtkMeshAttack.Translation, TranslationVector=(diagonal, 0.0, 0.0))),
        ("noise, s = 0.1", attack_on(mesh, vtkMeshAttack.NoiseAlongNormals, NoiseFactor=0.1)),
        ("noise, s = 0.3", attack_on(mesh, vtkMeshAttack.NoiseAlongNormals, NoiseFactor=0.3)),
        ("noise, s = 0.5", attack_on(mesh, vtkMeshAttack.NoiseAlongNormals, NoiseFactor=0.5)),
        (f"smoothing, {SMOOTHING_HARMONICS} harmonics",
         attack_on(mesh, vtkMeshAttack.SpectralSmoothing,
                   NumberOfHarmonics=min(SMOOTHING_HARMONICS, mesh.GetNumberOfPoints() // 2))),
        ("simplification, 50 %",
         attack_on(mesh, vtkMeshAttack.Simplification, SimplificationPercent=50.0)),
        ("simplification, 80 %",
         attack_on(mesh, vtkMeshAttack.Simplification, SimplificationPercent=80.0)),
    ]


def attack_on(mesh: vtkPolyData, kind: int, **properties) -> vtkMeshAttack:
    attack = vtkMeshAttack()
    attack.SetInputData(mesh)
    attack.SetAttack(kind)
    for name, value in properties.items():
        getattr(attack, f"Set{name}")(value)
    return attack


def detect(demo: Demo, name: str, mesh: vtkPolyData) -> Attacked:
    """Reads the mark with nothing but the mesh."""
    detector = vtkSpectralWatermarkDetect()
    detector.SetInputData(mesh)
    detector.SetExpectedMessage(demo.message)
    # No rate is asked for: a few bits could not reach any that proves something.
    detector.SetFalsePositiveRate(1.0)
    update(detector, f"Detecting: {name}")
    errors = round(detector.GetBitErrorRate() * len(demo.message))
    return Attacked(name, mesh, detector.GetExtractedMessage(), errors, detector.GetPValue())


def draw_pictures(demo: Demo) -> None:
    """Draws everything; needs a display, real or virtual."""
    if not os.environ.get("DISPLAY"):
        print('\nNo display, no pictures. A virtual one will do: xvfb-run -a -s "-screen 0 '
              '1280x1024x24 -noreset" ...')
        return
    # Only now: the rendering modules need the display.
    import mesh_pictures as pictures

    camera = pictures.view_of(demo.original)
    original, marked = (harmonics_of(mesh, name) for mesh, name in
                        ((demo.original, "original"), (demo.marked, "marked mesh")))
    say("Drawing")
    draw_comparison(demo, pictures, camera)
    draw_harmonics(demo, original, pictures, camera)
    draw_attacks(demo, pictures)
    draw_spectrum(demo, original, marked, pictures)
    draw_evolution(demo, pictures)


def harmonics_of(mesh: vtkPolyData, name: str) -> vtkPolyData:
    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(mesh)
    harmonics.SetNumberOfHarmonics(min(100, mesh.GetNumberOfPoints()))
    update(harmonics, f"100 harmonics of the {name}")
    return harmonics.GetOutput()


# --- Pictures ----------------------------------------------------------------------------------


def draw_comparison(demo: Demo, pictures, camera) -> None:
    """Original, marked, and how far each point moved."""
    percent = scaled_copy(demo.embed.GetOutput(), "GeometricDistortion", 100.0)
    limit = percent.GetPointData().GetArray("GeometricDistortion").GetRange()[1]
    pictures.write_panels(
        demo.output / "comparison.png",
        [
            pictures.Panel(demo.original, "original"),
            pictures.Panel(demo.marked, f"marked with {demo.message}"),
            pictures.Panel(percent, "displacement", "GeometricDistortion", 0,
                           pictures.heat(limit), "percent of the bounding-box diagonal"),
        ],
        columns=3, size=560, camera=camera)


def draw_harmonics(demo: Demo, original: vtkPolyData, pictures, camera) -> None:
    """Some of the basis functions that the mark lives in, as the paper's Figure 2 shows them."""
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
    rows = [row for row in demo.attacks
            if not row.name.startswith(("none", "scaling", "translation", "unmarked"))]
    panels = [pictures.Panel(row.mesh, f"{row.name}\n{row.read}, {row.errors} wrong")
              for row in rows]
    pictures.write_panels(demo.output / "attacks.png", panels, columns=4, size=420)


def draw_spectrum(demo: Demo, original: vtkPolyData, marked: vtkPolyData, pictures) -> None:
    """Magnitudes before and after, with the carriers picked out."""
    carriers = {table_value(demo, slot, "Component") for slot in range(len(demo.message))}
    before = spectrum_table(original)
    after = spectrum_table(marked)
    pictures.write_chart(
        demo.output / "spectrum.png",
        [
            pictures.Curve(before, "Component", "Magnitude", "original", "SteelBlue"),
            pictures.Curve(after, "Component", "Magnitude", "marked", "DarkOrange"),
            pictures.Curve(spectrum_table(marked, carriers), "Component", "Magnitude",
                           "carriers of the bits", "Firebrick", markers_only=True),
        ],
        "Spectrum of the mesh before and after", ("component", "magnitude (logarithmic scale)"),
        logarithmic=True)


def draw_evolution(demo: Demo, pictures) -> None:
    """Each carrier's distance from its slot's average over the iterations."""
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray
    from vtkmodules.vtkCommonDataModel import vtkTable

    history = demo.embed.GetOutputDataObject(1)
    bits = len(demo.message)
    iterations = history.GetNumberOfRows() // bits
    table = vtkTable()
    numbers = vtkIntArray()
    numbers.SetName("Iteration")
    for iteration in range(iterations):
        numbers.InsertNextValue(iteration)
    table.AddColumn(numbers)
    colours = ("SteelBlue", "DarkOrange", "SeaGreen", "Firebrick", "Purple")
    curves = []
    for slot, bit in enumerate(demo.message[: len(colours)]):
        margins = vtkDoubleArray()
        margins.SetName(f"margin {slot}")
        for iteration in range(iterations):
            row = iteration * bits + slot
            magnitude, average, deviation = (
                history.GetValueByName(row, name).ToDouble()
                for name in ("Magnitude", "Average", "Deviation"))
            margins.InsertNextValue((magnitude - average) / deviation if deviation else 0.0)
        table.AddColumn(margins)
        curves.append(pictures.Curve(table, "Iteration", margins.GetName(),
                                     f"component {table_value(demo, slot, 'Component')}: bit {bit}",
                                     colours[slot]))
    pictures.write_chart(
        demo.output / "evolution.png", curves,
        "Carriers over the iterations: above 0 reads 1, below reads 0",
        ("iteration", "(magnitude - average) / deviation"),
        whole_numbers=True)


def table_value(demo: Demo, row: int, column: str) -> int:
    return demo.embed.GetOutputDataObject(1).GetValueByName(row, column).ToInt()


def spectrum_table(mesh: vtkPolyData, only: set[int] | None = None):
    """Component and magnitude, from the second component on: the first is the position."""
    from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray
    from vtkmodules.vtkCommonDataModel import vtkTable

    magnitudes = mesh.GetFieldData().GetArray("SpectrumMagnitude")
    component, magnitude = vtkIntArray(), vtkDoubleArray()
    component.SetName("Component")
    magnitude.SetName("Magnitude")
    for k in range(1, magnitudes.GetNumberOfTuples()):
        if only is None or k + 1 in only:
            component.InsertNextValue(k + 1)
            magnitude.InsertNextValue(magnitudes.GetValue(k))
    table = vtkTable()
    table.AddColumn(component)
    table.AddColumn(magnitude)
    return table


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


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Writes beside and renames: the file is there whole or not at all."""
    partial = path.with_name(f"{path.stem}.partial{path.suffix}")
    try:
        write(partial)
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise DemoError(f"cannot write {path}: {error.strerror}") from error


def write_table(rows: list[Attacked], path: Path) -> None:
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["attack", "vertices", "bits_read", "bit_errors", "p_value"])
        for row in rows:
            table.writerow(
                [row.name, row.mesh.GetNumberOfPoints(), row.read, row.errors, row.p_value])


if __name__ == "__main__":
    sys.exit(main())
