#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Watermarks a mesh with 64 bits of a secret key, attacks it, and looks for the mark in each copy.

Detection is blind: it uses the copy and the key alone. ./demo.sh runs this program. The output folder gets the
marked mesh, tables and pictures.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from pathlib import Path

from spectralwatermark.execution import FilterError
from spectralwatermark.io import MeshFileError, read_mesh, write_file
from steps import Demo, DemoError, attack_and_detect, embed, say

BUNNY = Path("/usr/share/glmark2/models/bunny.obj")
# Every file that a run can leave. The next run removes these and no others.
OUTPUTS = ("marked.ply", "attacks.csv", "summary.json", "comparison.png", "harmonics.png", "attacks.png",
           "spectrum.png", "carriers.png")


def main() -> int:
    arguments = parse_arguments()
    try:
        run(arguments)
    except (DemoError, MeshFileError, FilterError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="demo.sh", description=__doc__)
    parser.add_argument(
        "mesh", nargs="?", type=Path, default=BUNNY,
        help="a PLY, OBJ, STL, VTP or OFF file (default: the bunny of Debian's glmark2-data)")
    parser.add_argument(
        "--output", type=Path, default=Path("demo-output"),
        help="folder for the results; those of an earlier run are removed (default: %(default)s)")
    parser.add_argument(
        "--key-file", type=Path, metavar="FILE",
        help="the secret, for example from head -c 32 /dev/urandom | base64 > FILE (default: the "
             "demonstration's key, which is public)")
    parser.add_argument("--bits", type=int, default=64,
                        help="number of bits derived from the key (default: %(default)s)")
    parser.add_argument("--no-pictures", action="store_true", help="only the tables and the mesh")
    return parser.parse_args()


def run(arguments: argparse.Namespace) -> None:
    started = time.monotonic()
    if arguments.mesh == BUNNY and not BUNNY.is_file():
        raise DemoError(f"file not found: {BUNNY} (install Debian's glmark2-data, or name a mesh)")
    original = read_mesh(arguments.mesh)
    print(f"{arguments.mesh.name}: {original.GetNumberOfPoints():,} points, "
          f"{original.GetNumberOfPolys():,} polygons")
    clear(arguments.output)
    demo = Demo(original, arguments.output, arguments.key_file, arguments.bits)
    embed(demo)
    attack_and_detect(demo)
    if not arguments.no_pictures:
        draw(demo)
    demo.summary["seconds"] = round(time.monotonic() - started, 1)
    write_file(demo.output / "summary.json", lambda path: path.write_text(
        json.dumps(demo.summary, indent=2) + "\n"))
    print(f"\nIn {demo.output}, after {demo.summary['seconds']:.0f} s:")
    for name in OUTPUTS:
        if (demo.output / name).exists():
            print(f"  {name}")
    if demo.key_file is None:
        print("\nMarked with the demonstration's key, which is public. To protect a model: --key-file FILE.")


def draw(demo: Demo) -> None:
    """Draws the charts and, where there is a display, the meshes."""
    # Imported here because matplotlib takes a moment to load.
    import drawing

    original, marked = drawing.harmonics_of(demo)
    say("Drawing")
    drawing.draw_charts(demo, original, marked)
    if os.environ.get("DISPLAY"):
        drawing.draw_meshes(demo, original.GetOutput())
    else:
        print('\nNo pictures of meshes, since there is no display. A virtual one is enough: '
              'xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" ...')


def clear(folder: Path) -> None:
    """Removes the files of an earlier run, and no others."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in OUTPUTS:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise DemoError(f"cannot write to {folder}: {error.strerror}") from error


if __name__ == "__main__":
    sys.exit(main())
