#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Reproduces every table and figure of the paper and shows them next to the original on one page.

Marks every mesh of a folder in the paper's four modes, attacks the marks, measures distortion, time
and the reliability of the detector's p-values, draws the figures, and lists where the numbers
differ from those of the paper. The output folder gets index.html, pictures (PNG) and tables (CSV).
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import time
from pathlib import Path

EXAMPLES = """examples:
  reproduce_paper.py --quick          three small meshes, two messages: a minute or two
  reproduce_paper.py                  everything: some 50 minutes on 2 cores for 15 scans with
                                      490,000 vertices; after an interruption the next run
                                      resumes
  reproduce_paper.py --meshes scans   the PLY meshes of your own folder

Needs the package spectralwatermark (PYTHONPATH=build/lib/python3/dist-packages after a build),
python3-numpy, python3-tqdm, python3-jinja2 and python3-matplotlib, and a display or Debian's xvfb
for the pictures of meshes. Exit code 0: the page is complete; 2: an error, reported in one line.
"""


class UserError(Exception):
    """An error that the user can fix; its text says how."""


def main() -> int:
    arguments = parse_arguments()
    try:
        ensure_display()
        return reproduce(arguments)
    except UserError as error:
        print(f"error: {error}", file=sys.stderr)
    except OSError as error:
        print(f"error: {error.filename or 'files'}: {error.strerror}", file=sys.stderr)
    except KeyboardInterrupt:
        print("\nerror: interrupted; run again to resume", file=sys.stderr)
    return 2


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--meshes", type=Path, metavar="DIR",
        help="folder of PLY meshes (default: the environment variable SPECTRALWATERMARK_MESH_DIR, "
             "else ../shared/meshes beside the source tree; if there is none, Data/pebble.ply)")
    parser.add_argument(
        "--output", type=Path, metavar="DIR", default=Path("paper-reproduction"),
        help="folder for the page; replaces only files that this program writes (default: "
             "%(default)s)")
    parser.add_argument(
        "--quick", action="store_true",
        help="the same page from the smallest meshes, two messages and fewer attacks")
    parser.add_argument(
        "--fresh", action="store_true",
        help="compute everything again; without it, results in the output folder are reused for "
             "mesh files of the same name and size. Needed after a change of the filters")
    parser.add_argument(
        "--jobs", type=int, metavar="N", default=os.cpu_count() or 1,
        help="processes at a time (default: %(default)s, the number of processors); does not change "
             "the results")
    arguments = parser.parse_args()
    if arguments.jobs < 1:
        parser.error("--jobs: at least 1")
    return arguments


def ensure_display() -> None:
    """Debian's VTK draws through X; a virtual screen is enough.

    Without -noreset the server restarts whenever its last window closes, and a worker that opens
    one at that moment is turned away.
    """
    if os.environ.get("DISPLAY"):
        return
    if shutil.which("xvfb-run") is None:
        raise UserError("no display for the pictures; a virtual one: apt install xvfb xauth")
    sys.stdout.flush()
    os.execvp("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset",
                           sys.executable, *sys.argv])


def reproduce(arguments: argparse.Namespace) -> int:
    # These modules need packages that --help names: they are imported once that can be read.
    try:
        from reproduction import files, models, page, plan, timing, work
        from reproduction.store import Store
    except ImportError as error:
        hint = "; is PYTHONPATH set? See --help" if error.name == "spectralwatermark" else ""
        raise UserError(f"{error}{hint}") from error

    started = time.monotonic()
    try:
        found = models.find_models(arguments.meshes)
    except models.NoModels as error:
        raise UserError(str(error)) from error
    folder = arguments.output
    files.prepare(folder, arguments.fresh)
    store = Store(folder, arguments.fresh)
    chosen = (plan.quick_plan if arguments.quick else plan.full_plan)(found)
    vertices = sum(model.vertices for model in chosen.models)
    print(f"meshes: {len(chosen.models)}, with {vertices:,} vertices; messages: "
          f"{len(chosen.messages)}; existing results: {store.found:,}", flush=True)

    failures = [work.Failure(name, "reading", "not a PLY mesh with vertices")
                for name in found.unreadable]
    failures += timing.measure(chosen, store)
    tasks = plan.tasks_of(chosen, store, folder)
    try:
        failures += work.run_tasks(tasks, store, arguments.jobs)
    except work.WorkerLost as error:
        raise UserError(str(error)) from error
    used = plan.keys_of(chosen)
    failures += [work.Failure(*refusal) for refusal in plan.refused(chosen, store)]
    run = page.Run(chosen, store, failures, len(store.builds_of(used)))
    failed_files = page.write(run, folder)
    complaints = files.check(folder, failed_files)
    if complaints:
        raise UserError(f"the page is incomplete: {complaints[0]} ({len(complaints)} complaints)")
    for (model, message), titles in work.by_message(failures).items():
        print(f"  failed: {model}, {titles[0]}"
              f"{f' and {len(titles) - 1} more' if titles[1:] else ''}: {message}")
    print(f"{folder / files.INDEX}, after {time.monotonic() - started:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
