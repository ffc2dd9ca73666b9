# SPDX-License-Identifier: BSD-3-Clause
"""Manifold harmonics and blind spectral watermarking of triangle meshes, as VTK filters.

The classes are ordinary VTK algorithms and chain with those of vtkmodules:

    from spectralwatermark import vtkSpectralWatermarkEmbed
    from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

    reader = vtkPLYReader()
    reader.SetFileName("model.ply")
    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputConnection(reader.GetOutputPort())
    embed.Update()
"""

# The classes that ours derive from must be registered before ours.
import vtkmodules.vtkCommonExecutionModel  # noqa: F401

from .vtkFiltersSpectralWatermark import *  # noqa: F401,F403
