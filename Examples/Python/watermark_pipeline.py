#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Marks a mesh, simplifies the copy and looks for the mark, in one VTK pipeline.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/watermark_pipeline.py [MESH.ply]
"""

import sys
from pathlib import Path

from spectralwatermark import (
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from vtkmodules.vtkIOPLY import vtkPLYReader

PEBBLE = Path(__file__).resolve().parents[2] / "Data" / "pebble.ply"

reader = vtkPLYReader()
reader.SetFileName(sys.argv[1] if len(sys.argv) > 1 else str(PEBBLE))

embed = vtkSpectralWatermarkEmbed()
embed.SetInputConnection(reader.GetOutputPort())
embed.SetSecretKey("only an example: keep yours in a file, with SetSecretKeyFile()")

attack = vtkMeshAttack()
attack.SetInputConnection(embed.GetOutputPort())
attack.SetAttackToSimplification()
attack.SetSimplificationPercent(60.0)

detect = vtkSpectralWatermarkDetect()
detect.SetInputConnection(attack.GetOutputPort())
detect.SetSecretKey("only an example: keep yours in a file, with SetSecretKeyFile()")
detect.UseDerivedMessageOn()
detect.Update()  # reads, marks, simplifies, detects

distortion = vtkMeshDistortion()
distortion.SetInputConnection(0, reader.GetOutputPort())
distortion.SetInputConnection(1, embed.GetOutputPort())
distortion.Update()

print(f"marked: converged {bool(embed.GetConverged())}, moved by {embed.GetDistortion():.3f} % of the "
      f"diagonal, visible distortion (MSDM2) {distortion.GetMSDM2():.2f}")
print(f"simplified to {attack.GetOutput().GetNumberOfPoints():,} points: "
      f"{'mine' if detect.GetDetected() else 'not mine'}, p-value {detect.GetPValue():.2g}")
sys.exit(0 if detect.GetDetected() else 1)
