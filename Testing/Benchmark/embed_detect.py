#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times embedding and detection in both schemes with their default settings and prints medians.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Benchmark/embed_detect.py \
        MESH.ply [MESH.ply ...] [--runs N]
"""

import argparse
import statistics
import time
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkIOPLY import vtkPLYReader


def seconds(algorithm: vtkAlgorithm) -> float:
    algorithm.Modified()
    started = time.perf_counter()
    algorithm.Update()
    return time.perf_counter() - started


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="+", type=Path, metavar="MESH.ply")
    parser.add_argument("--runs", type=int, default=5, help="runs of each (default: %(default)s)")
    arguments = parser.parse_args()
    print(f"{'mesh':<16}{'points':>9}  {'scheme':<12}{'iterations':>10}{'embed, s':>10}{'detect, s':>11}"
          f"   medians of {arguments.runs}")
    for path in arguments.meshes:
        reader = vtkPLYReader()
        reader.SetFileName(str(path))
        reader.Update()
        for scheme in (vtkSpectralWatermarkEmbed.Robust, vtkSpectralWatermarkEmbed.PaperSlots):
            measure(path.stem, reader.GetOutput(), scheme, arguments.runs)


def measure(name: str, mesh: vtkPolyData, scheme: int, runs: int) -> None:
    embed = vtkSpectralWatermarkEmbed()
    embed.AddObserver(vtkCommand.WarningEvent, lambda *_: None)
    embed.SetInputData(mesh)
    embed.SetScheme(scheme)
    detect = vtkSpectralWatermarkDetect()
    detect.SetScheme(scheme)
    if scheme == vtkSpectralWatermarkEmbed.Robust:
        embed.SetSecretKey("benchmark")
        detect.SetSecretKey("benchmark")
    embedding = [seconds(embed) for _ in range(runs)]
    detect.SetInputData(embed.GetOutput())
    detection = [seconds(detect) for _ in range(runs)]
    print(f"{name:<16}{mesh.GetNumberOfPoints():>9,}  {embed.GetSchemeAsString():<12}"
          f"{embed.GetNumberOfIterationsUsed():>10}{statistics.median(embedding):>10.2f}"
          f"{statistics.median(detection):>11.2f}", flush=True)


if __name__ == "__main__":
    main()
