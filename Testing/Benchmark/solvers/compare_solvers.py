#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times eigensolvers on the same matrices, side by side, and checks that they agree.

The program SolveHarmonics of the test build runs our block Lanczos solver and Spectra. SciPy's eigsh
(ARPACK, SuperLU) and, where they are installed, SLEPc's Krylov-Schur with MUMPS run here. All use
shift-invert to the same tolerance. The solvers take turns, each run in a process of its own. Times are
medians of the solve alone, without reading or assembling anything. The BLAS that a peer ran with stands
behind its figures; Debian's update-alternatives (libblas.so.3) chooses it.

    /usr/bin/python3 Testing/Benchmark/solvers/compare_solvers.py compare bunny --harmonics 100 300
    PYTHONPATH=build/lib/python3/dist-packages \\
        /usr/bin/python3 Testing/Benchmark/solvers/compare_solvers.py scale --output scaling

Needs Debian's packages python3-scipy, python3-slepc4py and python3-numpy; the charts of "scale" need
python3-matplotlib and python3-jinja2. Where SLEPc is installed but not found, set SLEPC_DIR and
PETSC_DIR to their folders under /usr/lib/slepcdir and /usr/lib/petscdir.
"""

from __future__ import annotations

import argparse
import csv
import importlib.util
import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

SOURCE = Path(__file__).resolve().parents[3]
TOLERANCE = 1e-9  # for eigsh and SLEPc: gives residuals as small as ours in practice
AGREEMENT = 1e-8  # largest difference of eigenvalues, relative to the reference or to 1
LARGEST_RESIDUAL = 1e-8  # apart from the rounding on slivers, which SolveHarmonics bounds
SHIFT = -1.0  # a surface of area 1 has its first eigenvalue near 12

NAMES = {
    "block-lanczos": "this library",
    "spectra": "Spectra, Eigen LDL^T",
    "scipy": "SciPy eigsh, SuperLU",
    "slepc": "SLEPc Krylov-Schur, MUMPS",
}
SERIES_MESHES = (("cow", 0), ("elephant", 0), ("camelhead", 0), ("bunny", 0), ("ogre", 0),
                 ("igea", 0), ("igea", 1))
SERIES_HARMONICS = (50, 100, 200, 500, 1000, 2000)


# --- One solve in a process of its own ----------------------------------------------------------


def solve_with_scipy(folder: Path, count: int) -> tuple[float, np.ndarray, np.ndarray]:
    from scipy.sparse.linalg import eigsh

    stiffness, mass = read_matrices(folder)
    started = time.perf_counter()
    values, vectors = eigsh(stiffness, k=count, M=mass, sigma=SHIFT, tol=TOLERANCE)
    return time.perf_counter() - started, values, vectors


def solve_with_slepc(folder: Path, count: int) -> tuple[float, np.ndarray, np.ndarray]:
    import slepc4py

    slepc4py.init([])
    from petsc4py import PETSc
    from slepc4py import SLEPc

    def of_scipy(matrix):
        rows = matrix.tocsr()
        return PETSc.Mat().createAIJ(rows.shape, csr=(rows.indptr, rows.indices, rows.data))

    stiffness, mass = (of_scipy(matrix) for matrix in read_matrices(folder))
    started = time.perf_counter()
    solver = SLEPc.EPS().create()
    solver.setOperators(stiffness, mass)
    solver.setProblemType(SLEPc.EPS.ProblemType.GHEP)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    solver.setTarget(SHIFT)
    solver.setDimensions(count)
    solver.setTolerances(TOLERANCE)
    transformation = solver.getST()
    transformation.setType(SLEPc.ST.Type.SINVERT)
    factorisation = transformation.getKSP().getPC()
    transformation.getKSP().setType("preonly")
    factorisation.setType("cholesky")
    factorisation.setFactorSolverType("mumps")
    solver.solve()
    seconds = time.perf_counter() - started
    found = min(count, solver.getConverged())
    values = np.array([solver.getEigenvalue(k).real for k in range(found)])
    vectors = np.empty((stiffness.getSize()[0], found))
    vector = stiffness.createVecRight()
    for k in range(found):
        solver.getEigenvector(k, vector)
        vectors[:, k] = vector.getArray()
    return seconds, values, vectors


def read_matrices(folder: Path):
    from scipy.io import mmread

    return mmread(folder / "stiffness.mtx").tocsc(), mmread(folder / "mass.mtx").tocsc()


def relative_residuals(folder: Path, values: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    stiffness, mass = read_matrices(folder)
    massed = mass @ vectors
    residuals = np.linalg.norm(stiffness @ vectors - massed * values, axis=0)
    return residuals / ((np.abs(values) + 1.0) * np.linalg.norm(massed, axis=0))


def loaded_blas() -> str:
    """The file names of the BLAS libraries in this process; which BLAS a peer runs with decides much."""
    paths = {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if "/" in line}
    names = {Path(path).resolve() for path in paths if re.match(r"lib.*(blas|mkl|blis)", Path(path).name)}
    return ", ".join(sorted("/".join(path.parts[-2:]) for path in names)) or "none"


def solve_here(solver: str, folder: Path, count: int, values_file: Path) -> None:
    seconds, values, vectors = {"scipy": solve_with_scipy,
                                "slepc": solve_with_slepc}[solver](folder, count)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    np.savetxt(values_file, values, fmt="%.17g")
    residual = float(relative_residuals(folder, values, vectors).max())
    print(json.dumps({"seconds": seconds, "peak_mib": peak, "residual": residual, "blas": loaded_blas()}))


# --- Many solves ---------------------------------------------------------------------------------


class Bench:
    """Where the program, the meshes and the matrices are."""

    def __init__(self, arguments: argparse.Namespace, work: Path) -> None:
        self.program = arguments.program
        self.meshes = arguments.meshes_folder
        self.threads = arguments.threads
        self.work = work
        if not self.program.exists():
            sys.exit(f"no {self.program}: build the tests first (./test.sh), or give --program")

    def path(self, mesh: str) -> Path:
        path = self.meshes / f"{mesh}.ply"
        if not path.exists():
            sys.exit(f"no {path}: set SPECTRALWATERMARK_MESH_DIR, or give --meshes-folder")
        return path

    def ours(self, mesh: str, count: int, *options: str) -> dict:
        return self._json([str(self.program), str(self.path(mesh)), str(count),
                           "--threads", str(self.threads), *options])

    def solve(self, solver: str, mesh: str, count: int) -> dict:
        """The result of a run, with its eigenvalues."""
        values = self.work / "values.txt"
        if solver in ("block-lanczos", "spectra"):
            result = self.ours(mesh, count, "--solver", solver, "--values", str(values))
        else:
            result = self._json([sys.executable, __file__, "solve", solver, str(self.work),
                                 str(count), str(values)])
        return result | {"values": np.sort(np.loadtxt(values))}

    def write_matrices(self, mesh: str) -> None:
        self.ours(mesh, 10, "--matrices", str(self.work))

    def _json(self, command: Sequence[str]) -> dict:
        threads = str(self.threads)
        environment = os.environ | {"OMP_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads}
        output = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
        return json.loads(output.stdout.splitlines()[-1])


def disagreement(values: np.ndarray, reference: np.ndarray) -> float:
    if len(values) != len(reference):
        return float("inf")
    return float((np.abs(values - reference) / np.maximum(1.0, np.abs(reference))).max())


def compare(bench: Bench, mesh: str, count: int, solvers: Sequence[str], runs: int) -> list[dict]:
    """Prints a table; a row for each solver."""
    print(f"\n{mesh}, {count} harmonics, medians of {runs}", flush=True)
    print(f"{'solver':<28}{'seconds':>10}{'min':>9}{'max':>9}{'ratio':>8}{'peak MiB':>10}"
          f"{'residual':>11}{'difference':>12}  BLAS")
    results: dict[str, list[dict]] = {solver: [] for solver in solvers}
    for _ in range(runs):
        for solver in solvers:
            results[solver].append(bench.solve(solver, mesh, count))
    ours = results[solvers[0]]
    fastest = statistics.median(run["seconds"] for run in ours)
    largest_residual = LARGEST_RESIDUAL + max(run["rounding"] for run in ours)
    rows = []
    for solver, taken in results.items():
        seconds = [run["seconds"] for run in taken]
        row = {
            "mesh": mesh, "harmonics": count, "solver": NAMES[solver], "runs": runs,
            "seconds": statistics.median(seconds), "fastest": min(seconds),
            "slowest": max(seconds), "ratio": statistics.median(seconds) / fastest,
            "peak_mib": max(run["peak_mib"] for run in taken),
            "residual": max(run["residual"] for run in taken),
            "difference": max(disagreement(run["values"], ours[0]["values"]) for run in taken),
            "blas": taken[0].get("blas", "none"),  # our program and Spectra link none
        }
        rows.append(row)
        wrong = row["difference"] > AGREEMENT or row["residual"] > largest_residual
        print(f"{row['solver']:<28}{row['seconds']:>10.2f}{row['fastest']:>9.2f}"
              f"{row['slowest']:>9.2f}{row['ratio']:>8.1f}{row['peak_mib']:>10.0f}"
              f"{row['residual']:>11.1e}{row['difference']:>12.1e}  {row['blas']}{'  WRONG' if wrong else ''}",
              flush=True)
    return rows


def write_rows(path: Path, rows: Sequence[dict]) -> None:
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def exponent(x: Iterable[float], y: Iterable[float]) -> float:
    return float(np.polyfit(np.log(list(x)), np.log(list(y)), 1)[0])


def series(bench: Bench, cases: Iterable[tuple[str, int, int]], runs: int, name: str) -> list[dict]:
    rows = []
    for mesh, subdivisions, count in cases:
        taken = [bench.ours(mesh, count, "--subdivide", str(subdivisions)) for _ in range(runs)]
        rows.append({
            "series": name, "mesh": mesh + "+" * subdivisions, "vertices": taken[0]["vertices"],
            "harmonics": count, "seconds": statistics.median(run["seconds"] for run in taken),
            "peak_mib": max(run["peak_mib"] for run in taken),
            "residual": max(run["residual"] for run in taken),
        })
        print("{series:<10}{mesh:<12}{vertices:>9,}{harmonics:>6}{seconds:>10.2f} s{peak_mib:>8.0f}"
              " MiB{residual:>10.1e}".format(**rows[-1]), flush=True)
    return rows


def scale(bench: Bench, folder: Path, runs: int) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    by_size = series(bench, ((mesh, level, 100) for mesh, level in SERIES_MESHES), runs, "vertices")
    by_count = series(bench, (("bunny", 0, count) for count in SERIES_HARMONICS), runs, "harmonics")
    write_rows(folder / "scaling.csv", by_size + by_count)
    for rows, axis in ((by_size, "vertices"), (by_count, "harmonics")):
        for figure in ("seconds", "peak_mib"):
            grown = exponent((row[axis] for row in rows), (row[figure] for row in rows))
            print(f"{figure} grows with {axis} to the power of {grown:.2f}")
    draw(folder / "scaling-vertices.png", by_size, "vertices", "100 harmonics of growing meshes")
    draw(folder / "scaling-harmonics.png", by_count, "harmonics", "More harmonics of the bunny")


def draw(path: Path, rows: Sequence[dict], axis: str, title: str) -> None:
    """Draws time against vertices or harmonics, both axes logarithmic."""
    from spectralwatermark.report.charts import chart

    x, seconds = (np.array([float(row[name]) for row in rows]) for name in (axis, "seconds"))
    slope, offset = np.polyfit(np.log(x), np.log(seconds), 1)
    with chart(path, title, axis, "seconds") as axes:
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.plot(x, seconds, "o-", color="steelblue", label="measured")
        axes.plot(x, np.exp(offset) * x**slope, "--", color="0.5", label=f"fit: {axis}$^{{{slope:.2f}}}$")


def parse(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    comparing = commands.add_parser("compare", help="all solvers on some meshes")
    comparing.add_argument("meshes", nargs="+", metavar="MESH", help="bunny, igea, ...")
    comparing.add_argument("--harmonics", nargs="+", type=int, default=[100], metavar="M")
    comparing.add_argument("--solvers", nargs="+", choices=list(NAMES), default=None)
    comparing.add_argument("--csv", type=Path, help="the table as a file")
    scaling = commands.add_parser("scale", help="growth with vertices and with harmonics")
    scaling.add_argument("--output", type=Path, default=Path("scaling"))
    for command in (comparing, scaling):
        command.add_argument("--runs", type=int, default=5)
        command.add_argument("--threads", type=int, default=os.cpu_count() or 1)
        command.add_argument("--program", type=Path,
                             default=SOURCE / "build" / "bin" / "SolveHarmonics")
        command.add_argument("--meshes-folder", type=Path, default=Path(
            os.environ.get("SPECTRALWATERMARK_MESH_DIR") or SOURCE.parent / "shared" / "meshes"))
    solving = commands.add_parser("solve", help="one solve, in this process")
    solving.add_argument("solver", choices=["scipy", "slepc"])
    solving.add_argument("folder", type=Path)
    solving.add_argument("count", type=int)
    solving.add_argument("values", type=Path)
    return parser.parse_args(arguments)


def main() -> None:
    arguments = parse()
    if arguments.command == "solve":
        solve_here(arguments.solver, arguments.folder, arguments.count, arguments.values)
        return
    with tempfile.TemporaryDirectory() as work:
        bench = Bench(arguments, Path(work))
        if arguments.command == "scale":
            scale(bench, arguments.output, arguments.runs)
            return
        solvers = arguments.solvers or [name for name in NAMES if name != "slepc" or
                                        importlib.util.find_spec("slepc4py") is not None]
        rows = []
        for mesh in arguments.meshes:
            bench.write_matrices(mesh)
            for count in arguments.harmonics:
                rows += compare(bench, mesh, count, solvers, arguments.runs)
                if arguments.csv:
                    write_rows(arguments.csv, rows)


if __name__ == "__main__":
    main()
