#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Which bits survive what: meshes x schemes x keys x attacks, on all cores.

    PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a -s -noreset \\
        /usr/bin/python3 Testing/Benchmark/robustness --keys 2 --output robustness

Schemes: Robust at two budgets of distortion, the paper's four modes, and the method of Cho and others
(2007) as baseline. Messages are derived from the keys. Every result goes into OUTPUT/marks.csv and
OUTPUT/outcomes.csv as soon as it is there: interrupted, or with more keys or meshes, the same command
goes on where it was. At the end OUTPUT/index.html has tables and curves, with the published rates of
the benchmark of Wang and others (2010) beside them; its charts are drawn through X, a virtual one is
enough. Debian's packages python3-numpy, python3-tqdm and xvfb.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from run import run
from schemes import SCHEMES

SOURCE = Path(__file__).resolve().parents[3]
MESHES = ("bunny", "horse", "armadillo", "nefertiti", "igea")


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="*", metavar="MESH", default=MESHES,
                        help=f"default: {' '.join(MESHES)}")
    parser.add_argument("--schemes", nargs="+", default=[scheme.name for scheme in SCHEMES],
                        choices=[scheme.name for scheme in SCHEMES], metavar="SCHEME")
    parser.add_argument("--keys", type=int, default=2, help="how many (default: 2)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="default: one a core")
    parser.add_argument("--output", type=Path, default=Path("robustness"))
    parser.add_argument("--only-page", action="store_true", help="from the results that are there")
    parser.add_argument("--meshes-folder", type=Path, default=Path(
        os.environ.get("SPECTRALWATERMARK_MESH_DIR") or SOURCE.parent / "shared" / "meshes"))
    return parser.parse_args()


def main() -> None:
    arguments = parse()
    if not arguments.only_page:
        run(arguments)
    import page  # draws: needs a display
    page.write(arguments.output)


if __name__ == "__main__":
    main()
