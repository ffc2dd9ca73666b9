#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times embedding and detection of five bits with the paper's settings; prints medians.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Benchmark/embed_detect.py \
        MESH.ply [MESH.ply ...] [--runs N]
"""

import argparse
import statistics
import time
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from vtkmodules.vtkCommonCore import vtkCommand
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
    print(f"{'mesh':<20}{'points':>9}{'iterations':>12}{'embed, s':>10}{'detect, s':>11}"
          f"   medians of {arguments.runs}")
    for path in arguments.meshes:
        reader = vtkPLYReader()
        reader.SetFileName(str(path))
        reader.Update()
        embed = vtkSpectralWatermarkEmbed()
        embed.AddObserver(vtkCommand.WarningEvent, lambda *_: None)
        embed.SetInputData(reader.GetOutput())
        embedding = [seconds(embed) for _ in range(arguments.runs)]
        detect = vtkSpectralWatermarkDetect()
        detect.SetInputData(embed.GetOutput())
        detection = [seconds(detect) for _ in range(arguments.runs)]
        print(f"{path.stem:<20}{reader.GetOutput().GetNumberOfPoints():>9,}"
              f"{embed.GetNumberOfIterationsUsed():>12}{statistics.median(embedding):>10.2f}"
              f"{statistics.median(detection):>11.2f}", flush=True)


if __name__ == "__main__":
    main()
