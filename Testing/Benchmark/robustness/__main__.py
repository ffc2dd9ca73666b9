#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures which marks survive which attacks: meshes x schemes x keys x attacks, on all cores.

    PYTHONPATH=build/lib/python3/dist-packages \\
        /usr/bin/python3 Testing/Benchmark/robustness --keys 2 --output robustness

The schemes are Robust at two budgets of distortion, the paper's four modes, and as the baseline the
method of Cho and others (2007). Messages are derived from the keys. Every result is written to
OUTPUT/marks.csv and OUTPUT/outcomes.csv at once: after an interruption, or with more keys or meshes, the
same command resumes. At the end OUTPUT/index.html has tables and curves next to the published rates of
the benchmark of Wang and others (2010). Needs Debian's packages python3-numpy, python3-tqdm,
python3-jinja2 and python3-matplotlib.
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
    parser.add_argument("--keys", type=int, default=2, help="number of keys (default: 2)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(),
                        help="processes at a time (default: one for each core)")
    parser.add_argument("--output", type=Path, default=Path("robustness"))
    parser.add_argument("--only-page", action="store_true", help="write the page from existing results")
    parser.add_argument("--meshes-folder", type=Path, default=Path(
        os.environ.get("SPECTRALWATERMARK_MESH_DIR") or SOURCE.parent / "shared" / "meshes"))
    return parser.parse_args()


def main() -> None:
    arguments = parse()
    if not arguments.only_page:
        run(arguments)
    import page  # imported here because the workers need no matplotlib

    page.write(arguments.output)


if __name__ == "__main__":
    main()
