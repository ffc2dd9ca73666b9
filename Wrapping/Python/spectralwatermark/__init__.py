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
try:
    import vtkmodules.vtkCommonExecutionModel  # noqa: F401
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(f"{error}: VTK's Python modules are Debian's python3-vtk9, which belongs to "
                              "/usr/bin/python3; run that one") from None

from .vtkFiltersSpectralWatermark import *  # noqa: F401,F403
