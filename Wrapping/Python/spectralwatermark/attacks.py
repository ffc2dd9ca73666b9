# SPDX-License-Identifier: BSD-3-Clause
"""The attacks on meshes, in one table.

The command line takes its options from the table, the report and the robustness benchmark take their attacks from it,
and a test compares ParaView's XML with it. A new attack needs a row here, its computation in vtkMeshAttack, and a test.

The table holds names of vtkMeshAttack's constants and properties, which are looked up when an attack is set up, so that
this module imports no VTK. Ranges are the class's own.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    from . import vtkMeshAttack

__all__ = ["ATTACKS", "PROPERTIES_OF_EVERY_ATTACK", "Attack", "attacks_on"]

PROPERTIES_OF_EVERY_ATTACK = ("Attack", "Seed", "OutputPointsPrecision")


@dataclass(frozen=True)
class Attack:
    """One attack of vtkMeshAttack, with one property that a user chooses."""

    #: The command-line option, without its dashes.
    name: str
    #: The name of the constant in vtkMeshAttack.
    kind: str
    help: str
    #: The property that the option's value sets; "" when the option takes no value.
    property: str = ""
    #: The placeholder of the value in --help; one for each number of a vector.
    metavar: str | tuple[str, ...] = ()
    type: type = float
    #: The words that the option takes instead of a number, and the constants they stand for.
    choices: Mapping[str, str] = field(default_factory=dict)
    #: Properties with one value in this attack; a string is the name of a constant.
    fixed: Mapping[str, Any] = field(default_factory=dict)
    #: Properties that concern this attack and stay at the class's defaults.
    defaults: tuple[str, ...] = ()

    def properties(self) -> tuple[str, ...]:
        """All properties of vtkMeshAttack that concern this attack alone."""
        return (*([self.property] if self.property else []), *self.fixed, *self.defaults)

    def on(self, mesh: vtkPolyData, value: Any = None, seed: int = 0) -> vtkMeshAttack:
        """The filter, ready to be updated. Raises FilterError for a value out of the property's range."""
        from . import vtkMeshAttack

        attack = vtkMeshAttack()
        attack.SetInputData(mesh)
        attack.SetAttack(_constant(self.kind))
        attack.SetSeed(seed)
        for name, fixed in self.fixed.items():
            getattr(attack, f"Set{name}")(_constant(fixed) if isinstance(fixed, str) else fixed)
        if value is not None:
            _set_in_range(attack, self.property, _constant(self.choices[value]) if self.choices else value)
        return attack


def _constant(name: str) -> int:
    from . import vtkMeshAttack

    return getattr(vtkMeshAttack, name)


def _set_in_range(attack: vtkMeshAttack, name: str, value: Any) -> None:
    """Refuses a value that VTK would silently replace by the nearest one in range."""
    from .execution import FilterError

    getattr(attack, f"Set{name}")(value)
    taken = getattr(attack, f"Get{name}")()
    if taken != (tuple(value) if isinstance(value, list) else value):
        reason, advice = f"cannot be {value}", f"the nearest is {taken}"
        raise FilterError(f"{name}: {reason}; {advice}", name, reason, advice)


ATTACKS = {attack.name: attack for attack in (
    Attack("similarity", "Similarity", "apply a random rotation, scale and translation"),
    Attack("rotate", "Rotation", "rotate about the z axis", "RotationAngle", "DEGREES", defaults=("RotationAxis",)),
    Attack("scale", "UniformScaling", "scale by a factor", "ScaleFactor", "FACTOR"),
    Attack("translate", "Translation", "move by a vector", "TranslationVector", ("X", "Y", "Z")),
    Attack("stretch", "NonUniformScaling", "scale each axis by its own factor", "AxisScaleFactors", ("X", "Y", "Z")),
    Attack("noise", "NoiseUniform", "add uniform noise to every coordinate, in percent of the mean distance of the "
           "vertices to their centre", "NoisePercent", "PERCENT"),
    Attack("noise-along-normals", "NoiseAlongNormals", "add Gaussian noise along the normals, with a standard "
           "deviation of S mean edge lengths (the paper's noise)", "NoiseFactor", "S"),
    Attack("smooth", "LaplacianSmoothing", "apply Laplacian smoothing with factor 0.1 that many times",
           "SmoothingIterations", "TIMES", int, defaults=("SmoothingFactor",)),
    Attack("low-pass", "SpectralSmoothing", "keep only the first M manifold harmonics", "NumberOfHarmonics", "M", int,
           fixed={"SmoothingGain": 1}, defaults=("CutoffComponent", "KeepResidual")),
    Attack("quantize", "Quantization", "round coordinates to 2^BITS levels of the bounding box", "QuantizationBits",
           "BITS", int),
    Attack("simplify", "Simplification", "remove that percentage of the edges", "SimplificationPercent", "PERCENT"),
    Attack("subdivide", "Subdivision", "subdivide every triangle by the rule midpoint, loop or sqrt3",
           "SubdivisionType", "RULE", str, {"midpoint": "Midpoint", "loop": "Loop", "sqrt3": "Sqrt3"},
           defaults=("NumberOfSubdivisions",)),
    Attack("remesh", "Remeshing", "remesh uniformly, to that percentage of the vertices", "RemeshingPercent",
           "PERCENT", fixed={"RemeshingMethod": "Uniform"}),
    Attack("isosurface", "Remeshing", "remesh through a distance field with that many grid steps along the longest "
           "side", "IsosurfaceResolution", "STEPS", int, fixed={"RemeshingMethod": "Isosurface"}),
    Attack("crop", "Cropping", "cut off that percentage of the vertices by a plane", "CroppingPercent", "PERCENT"),
    Attack("shuffle", "VertexReordering", "shuffle the order of vertices and triangles"),
)}

# Name in tables, attack, and value: common strengths, milder ones first.
_COMMON = (
    ("turned, scaled and moved", "similarity", None),
    ("vertices shuffled", "shuffle", None),
    *((f"noise, {percent:g} %", "noise", percent) for percent in (0.1, 0.3, 0.5)),
    *((f"smoothing, {times} times", "smooth", times) for times in (10, 50)),
    *((f"quantized to {bits} bits", "quantize", bits) for bits in (9, 8)),
    *((f"simplification, {percent:g} % of the edges", "simplify", percent) for percent in (50.0, 90.0)),
    ("subdivision (Loop)", "subdivide", "loop"),
    ("remeshing", "remesh", 100.0),
    ("cropping, 10 % of the vertices", "crop", 10.0),
)


def attacks_on(mesh: vtkPolyData) -> list[tuple[str, vtkMeshAttack | None]]:
    """Common attacks at common strengths, by name; first "none", which leaves the mesh unchanged."""
    return [("none", None), *((name, ATTACKS[attack].on(mesh, value)) for name, attack, value in _COMMON)]
