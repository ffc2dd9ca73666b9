# SPDX-License-Identifier: BSD-3-Clause
"""Pipelines with Debian's vtkmodules and numpy, as a user of VTK from Python builds them."""

import unittest

import numpy as np
from spectralwatermark import (
    vtkManifoldHarmonics,
    vtkManifoldHarmonicsReconstruction,
    vtkMeshAttack,
    vtkMeshDistortion,
    vtkSpectralWatermarkDetect,
    vtkSpectralWatermarkEmbed,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSuperquadricSource


def superquadric():
    """A closed surface without repeated eigenvalues, from a VTK source."""
    source = vtkSuperquadricSource()
    source.SetScale(1.0, 1.3, 0.7)
    source.SetPhiRoundness(0.8)
    source.SetThetaRoundness(1.2)
    source.SetThetaResolution(64)
    source.SetPhiResolution(64)
    source.ToroidalOff()
    return source


class ErrorText:
    """Collects what a filter says through vtkErrorMacro."""

    def __init__(self, algorithm):
        self.text = ""

        def listen(_caller, _event, message):
            self.text += message

        listen.CallDataType = "string0"
        algorithm.AddObserver(vtkCommand.ErrorEvent, listen)
        algorithm.GetExecutive().AddObserver(vtkCommand.ErrorEvent, lambda *_: None)


class PipelineTest(unittest.TestCase):
    def setUp(self):
        self.source = superquadric()  # a port does not keep its producer alive
        self.triangles = vtkTriangleFilter()
        self.triangles.SetInputConnection(self.source.GetOutputPort())

    def harmonics(self, count):
        harmonics = vtkManifoldHarmonics()
        harmonics.SetInputConnection(self.triangles.GetOutputPort())
        harmonics.SetNumberOfHarmonics(count)
        harmonics.Update()
        return harmonics.GetOutput()

    def test_basis_is_an_n_by_m_array(self):
        output = self.harmonics(40)
        basis = vtk_to_numpy(output.GetPointData().GetArray("ManifoldHarmonics"))
        mass = vtk_to_numpy(output.GetPointData().GetArray("VertexMass"))
        self.assertEqual(basis.shape, (output.GetNumberOfPoints(), 40))
        self.assertEqual(basis.dtype, np.float64)
        # The source's poles and seam repeat points, each with its vertex's mass: count them once.
        points = vtk_to_numpy(output.GetPoints().GetData())
        _, first = np.unique(points, axis=0, return_index=True)
        gram = basis[first].T @ (mass[first, None] * basis[first])
        np.testing.assert_allclose(gram, np.eye(40), atol=1e-10)

        eigenvalues = vtk_to_numpy(output.GetFieldData().GetArray("Eigenvalues"))
        self.assertEqual(eigenvalues[0], 0.0)
        self.assertTrue(np.all(np.diff(eigenvalues) >= 0.0))
        self.assertLess(vtk_to_numpy(output.GetFieldData().GetArray("Residuals")).max(), 1e-8)

        spectrum = vtk_to_numpy(output.GetFieldData().GetArray("Spectrum"))
        by_hand = basis[first].T @ (mass[first, None] * points[first].astype(float))
        np.testing.assert_allclose(spectrum[1:], by_hand[1:], atol=1e-10)
        magnitude = vtk_to_numpy(output.GetFieldData().GetArray("SpectrumMagnitude"))
        np.testing.assert_allclose(magnitude, np.linalg.norm(spectrum, axis=1), rtol=1e-14)

    def test_embed_attack_detect(self):
        embed = vtkSpectralWatermarkEmbed()
        embed.SetInputConnection(self.triangles.GetOutputPort())
        embed.SetSchemeToPaperSlots()
        embed.SetMessage("0110")
        attack = vtkMeshAttack()
        attack.SetInputConnection(embed.GetOutputPort())
        attack.SetAttackToRotation()
        detect = vtkSpectralWatermarkDetect()
        detect.SetInputConnection(attack.GetOutputPort())
        detect.SetSchemeToPaperSlots()
        detect.SetNumberOfBits(4)
        detect.Update()
        # One pipeline: the update reached the embedding.
        self.assertIn(embed.GetConverged(), (0, 1))
        self.assertEqual(detect.GetExtractedMessage(), embed.GetExtractedMessage())

        distortion = vtkMeshDistortion()
        distortion.SetInputConnection(0, self.triangles.GetOutputPort())
        distortion.SetInputConnection(1, embed.GetOutputPort())
        distortion.Update()
        self.assertGreater(distortion.GetGeomDiff(), 0.0)
        table = embed.GetOutputDataObject(1)
        self.assertEqual(table.GetNumberOfRows() % 4, 0)
        self.assertEqual(vtk_to_numpy(table.GetColumnByName("Component"))[0], 25)

    def test_reconstruction_from_numpy_gains(self):
        reconstruction = vtkManifoldHarmonicsReconstruction()
        reconstruction.SetInputData(self.harmonics(60))
        for component in range(31, 61):
            reconstruction.SetGain(component, 0.0)
        reconstruction.Update()
        smooth = vtk_to_numpy(reconstruction.GetOutput().GetPoints().GetData())
        self.assertTrue(np.all(np.isfinite(smooth)))

    def test_errors_reach_python(self):
        detect = vtkSpectralWatermarkDetect()
        errors = ErrorText(detect)
        detect.SetInputData(vtkPolyData())
        detect.Update()
        self.assertIn("no points", errors.text)
        self.assertNotEqual(detect.GetErrorCode(), 0)
        self.assertEqual(detect.GetExtractedMessage(), "")

    def test_progress_and_abort(self):
        harmonics = vtkManifoldHarmonics()
        harmonics.SetInputConnection(self.triangles.GetOutputPort())
        seen = []

        def listen(caller, _event):
            seen.append(caller.GetProgress())
            if seen[-1] > 0.5:
                caller.SetAbortExecute(1)

        harmonics.AddObserver(vtkCommand.ProgressEvent, listen)
        harmonics.Update()
        self.assertGreater(len(seen), 10)
        self.assertEqual(seen, sorted(seen))
        self.assertLess(seen[-1], 0.7)
        self.assertEqual(harmonics.GetOutput().GetNumberOfPoints(), 0)


if __name__ == "__main__":
    unittest.main()
