# SPDX-License-Identifier: BSD-3-Clause
"""The Python face of every class: constructors, properties, enumerations, documentation."""

import subprocess
import sys
import unittest

import spectralwatermark
from spectralwatermark import (
    vtkManifoldHarmonics,
    vtkManifoldHarmonicsReconstruction,
    vtkMeshAttack,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm

FILTERS = tuple(getattr(spectralwatermark, name) for name in (
    "vtkManifoldHarmonics", "vtkManifoldHarmonicsReconstruction", "vtkManifoldHarmonicsSimilarity",
    "vtkMeshAttack", "vtkMeshDistortion", "vtkSpectralWatermarkDetect", "vtkSpectralWatermarkEmbed"))


class WrappingTest(unittest.TestCase):
    def test_filters_are_debians_vtk_algorithms(self):
        for cls in FILTERS:
            self.assertIsInstance(cls(), vtkPolyDataAlgorithm)

    def test_every_class_is_documented(self):
        for cls in FILTERS:
            self.assertGreater(len(cls.__doc__), 200, cls.__name__)

    def test_integer_properties_take_integers(self):
        embed = vtkSpectralWatermarkEmbed()
        embed.SetBitEmbedding(1)
        self.assertEqual(embed.GetBitEmbeddingAsString(), "NonAggressive")
        embed.SetBitEmbeddingToAggressive()
        self.assertEqual(embed.GetBitEmbedding(), vtkSpectralWatermarkEmbed.Aggressive)
        embed.SetSlotDivision(vtkSpectralWatermarkEmbed.InterleavedNarrow)
        self.assertEqual(embed.GetSlotDivisionAsString(), "InterleavedNarrow")
        self.assertEqual(embed.GetSchemeAsString(), "Robust")
        embed.SetScheme(0)
        self.assertEqual(embed.GetSchemeAsString(), "PaperSlots")
        attack = vtkMeshAttack()
        attack.SetAttack(vtkMeshAttack.Simplification)
        self.assertEqual(attack.GetAttackAsString(), "Simplification")

    def test_strings_are_never_none(self):
        embed = vtkSpectralWatermarkEmbed()
        embed.SetMessage(None)
        self.assertEqual(embed.GetMessage(), "")
        self.assertEqual(embed.GetExtractedMessage(), "")
        self.assertEqual(vtkSpectralWatermarkDetect().GetExpectedMessage(), "")
        self.assertEqual(vtkManifoldHarmonics().GetArrayName(), "ManifoldHarmonics")

    def test_vectors_and_gains(self):
        attack = vtkMeshAttack()
        attack.SetRotationAxis(1, 2, 3)
        self.assertEqual(attack.GetRotationAxis(), (1.0, 2.0, 3.0))
        reconstruction = vtkManifoldHarmonicsReconstruction()
        reconstruction.SetGain(50, 2.0)
        self.assertEqual(reconstruction.GetGain(50), 2.0)
        self.assertEqual(reconstruction.GetGain(51), 1.0)

    def test_star_import_gives_the_filters(self):
        given: dict = {}
        exec("from spectralwatermark import *", given)
        for cls in FILTERS:
            self.assertIs(given[cls.__name__], cls)

    def test_print_names_properties(self):
        self.assertIn("TurbulenceFactor: 1", str(vtkSpectralWatermarkEmbed()))

    def test_a_python_without_vtk_says_which_one_has_it(self):
        done = subprocess.run([sys.executable, "-c", "import sys; sys.modules['vtkmodules'] = None; "
                               "import spectralwatermark"], capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("belongs to /usr/bin/python3; run that one", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
