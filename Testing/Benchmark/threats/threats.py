# SPDX-License-Identifier: BSD-3-Clause
"""Measures what an opponent who knows the method can do: add marks, average marked copies, and try keys on a mesh
without a mark.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Testing/Benchmark/threats/threats.py MESH...

For each case, prints the number of meshes on which each party's mark is found (at one in a million), and the smallest
and largest p-value. Filters/Documentation/threat-model.md quotes the figures.
"""

import sys
from collections import defaultdict

import numpy as np

from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from spectralwatermark.io import read_mesh
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

STRENGTH = 0.07
FAINTER = (0.07, 0.05, 0.035, 0.02)
COLLUDERS = (2, 3, 5)
GUESSES = 50


def marked(mesh, key, strength=STRENGTH):
    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(mesh)
    embed.SetSecretKey(key)
    embed.SetMaximumDistortion(strength)
    embed.Update()
    if not embed.GetConverged():
        raise RuntimeError(f"{key}: not embedded")
    return embed.GetOutput()


def p_value(mesh, key):
    detect = vtkSpectralWatermarkDetect()
    detect.SetInputData(mesh)
    detect.SetSecretKey(key)
    detect.UseDerivedMessageOn()
    detect.Update()
    return detect.GetPValue()


def average(meshes):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.mean([vtk_to_numpy(mesh.GetPoints().GetData()) for mesh in meshes], axis=0),
                                deep=True))
    mean = vtkPolyData()
    mean.ShallowCopy(meshes[0])
    mean.SetPoints(points)
    return mean


def cases(original):
    """Yields the name of each case with the p-value of each party."""
    yield f"no mark, best of {GUESSES} keys", {
        "who searches": min(p_value(original, f"guess {k}") for k in range(GUESSES))}
    first = marked(original, "owner")
    yield "one mark", {"owner": p_value(first, "owner"), "another key": p_value(first, "second")}
    for strength in FAINTER:
        both = marked(first, "second", strength)
        yield f"a second key's mark of {strength} % over it", {
            "owner": p_value(both, "owner"), "second": p_value(both, "second")}
    again = marked(first, "owner")
    yield "marked once more under the same key", {"owner": p_value(again, "owner")}

    for count in COLLUDERS:
        keys = [f"buyer {k}" for k in range(count)]
        mean = average([marked(original, key) for key in keys])
        yield f"average of {count} copies, a key each", {
            "best buyer": min(p_value(mean, key) for key in keys)}
        mean = average([marked(first, key, FAINTER[-1]) for key in keys])
        yield f"average of {count} copies, the owner's mark and a buyer's of {FAINTER[-1]} % over it", {
            "owner": p_value(mean, "owner"), "best buyer": min(p_value(mean, key) for key in keys)}


def main(paths):
    seen = defaultdict(list)
    for path in paths:
        for case, values in cases(read_mesh(path)):
            for party, value in values.items():
                seen[case, party].append(value)
                print(f"{path}: {case}: {party}: p = {value:.2g}", file=sys.stderr, flush=True)
    print(f"{'case':<80}{'party':<14}found   p, smallest and largest")
    for (case, party), values in seen.items():
        found = sum(value <= 1e-6 for value in values)
        print(f"{case:<80}{party:<14}{found} of {len(values)}  {min(values):.2g}  {max(values):.2g}")


if __name__ == "__main__":
    main(sys.argv[1:] or sys.exit(__doc__))
