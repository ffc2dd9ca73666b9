#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Filters geometry like sound: removes high frequencies, or amplifies the middle ones.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/filter_geometry.py \
        MESH OUTPUT_FOLDER [HARMONICS]

Writes smooth.ply (a low-pass filter that keeps only the first tenth of the harmonics) and enhanced.ply (the middle
frequencies amplified by half, with all detail kept).
"""

import sys
from pathlib import Path

from spectralwatermark import vtkManifoldHarmonics, vtkManifoldHarmonicsReconstruction
from spectralwatermark.io import read_mesh, write_mesh


def main(mesh: str, folder: str, count: str = "300") -> None:
    count = int(count)
    output = Path(folder)
    output.mkdir(parents=True, exist_ok=True)

    harmonics = vtkManifoldHarmonics()
    harmonics.SetInputData(read_mesh(mesh))
    harmonics.SetNumberOfHarmonics(count)

    low_pass = vtkManifoldHarmonicsReconstruction()
    low_pass.SetInputConnection(harmonics.GetOutputPort())
    low_pass.SetNumberOfHarmonics(count // 10)

    enhance = vtkManifoldHarmonicsReconstruction()
    enhance.SetInputConnection(harmonics.GetOutputPort())  # the basis is computed once for both
    enhance.KeepResidualOn()
    for component in range(count // 10, count + 1):  # counted from 1; the first is the position
        rising = min(1.0, (component - count // 10) / (0.1 * count))  # gradually, because a step would ring
        enhance.SetGain(component, 1.0 + 0.5 * rising)

    for filter_, name in ((low_pass, "smooth.ply"), (enhance, "enhanced.ply")):
        filter_.Update()
        write_mesh(filter_.GetOutput(), output / name)
        print(f"wrote {output / name}; bases computed: {filter_.GetNumberOfEigensolves()}")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
