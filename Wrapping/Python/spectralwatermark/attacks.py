# SPDX-License-Identifier: BSD-3-Clause
"""What happens to meshes: attacks of common strengths, to see whether a mark survives them."""

from __future__ import annotations

from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import vtkMeshAttack

__all__ = ["attack_on", "attacks_on"]


def attacks_on(mesh: vtkPolyData) -> list[tuple[str, vtkMeshAttack | None]]:
    """What happens to meshes, by name."""
    return [
        ("none", None),
        ("turned, scaled and moved", attack_on(mesh, vtkMeshAttack.Similarity)),
        ("vertices shuffled", attack_on(mesh, vtkMeshAttack.VertexReordering)),
        *((f"noise, {percent:g} %",
           attack_on(mesh, vtkMeshAttack.NoiseUniform, NoisePercent=percent))
          for percent in (0.1, 0.3, 0.5)),
        *((f"smoothing, {iterations} times",
           attack_on(mesh, vtkMeshAttack.LaplacianSmoothing, SmoothingIterations=iterations))
          for iterations in (10, 50)),
        *((f"quantized to {bits} bits",
           attack_on(mesh, vtkMeshAttack.Quantization, QuantizationBits=bits)) for bits in (9, 8)),
        *((f"simplification, {percent:g} % of the edges",
           attack_on(mesh, vtkMeshAttack.Simplification, SimplificationPercent=percent))
          for percent in (50.0, 90.0)),
        ("subdivision (Loop)",
         attack_on(mesh, vtkMeshAttack.Subdivision, SubdivisionType=vtkMeshAttack.Loop)),
        ("remeshing", attack_on(mesh, vtkMeshAttack.Remeshing)),
        ("cropping, 10 % of the vertices",
         attack_on(mesh, vtkMeshAttack.Cropping, CroppingPercent=10.0)),
    ]


def attack_on(mesh: vtkPolyData, kind: int, **properties) -> vtkMeshAttack:
    attack = vtkMeshAttack()
    attack.SetInputData(mesh)
    attack.SetAttack(kind)
    for name, value in properties.items():
        getattr(attack, f"Set{name}")(value)
    return attack
