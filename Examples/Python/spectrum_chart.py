#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Charts a mesh's spectrum with VTK: in a window, or into a PNG file.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/spectrum_chart.py \
        MESH [OUTPUT.png]

Debian's VTK draws through X; without a screen, put `xvfb-run -a -s -noreset` before it.
"""

import sys

import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 - registers the chart's device
import vtkmodules.vtkRenderingFreeType  # noqa: F401 - registers text
from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import read_mesh
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

if len(sys.argv) < 2:
    sys.exit(__doc__)

mesh = read_mesh(sys.argv[1])
harmonics = vtkManifoldHarmonics()
harmonics.SetInputData(mesh)
harmonics.SetNumberOfHarmonics(min(200, mesh.GetNumberOfPoints() // 2))
harmonics.Update()
spectrum = harmonics.GetOutputDataObject(1)
spectrum.RemoveRow(0)  # the constant harmonic's: the position

chart = vtkChartXY()
chart.SetTitle("Spectrum")
chart.GetAxis(vtkAxis.BOTTOM).SetTitle("component")
chart.GetAxis(vtkAxis.LEFT).SetTitle("magnitude")
chart.GetAxis(vtkAxis.LEFT).SetLogScale(True)
line = chart.AddPlot(vtkChart.LINE)
line.SetInputData(spectrum, "Component", "Magnitude")
line.SetWidth(2.0)

view = vtkContextView()
view.GetScene().AddItem(chart)
view.GetRenderWindow().SetSize(1000, 500)
view.GetRenderWindow().SetMultiSamples(0)
if len(sys.argv) > 2:
    view.GetRenderWindow().SetOffScreenRendering(True)
    view.GetRenderWindow().Render()
    image = vtkWindowToImageFilter()
    image.SetInput(view.GetRenderWindow())
    writer = vtkPNGWriter()
    writer.SetFileName(sys.argv[2])
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
else:
    view.GetRenderWindow().Render()
    view.GetInteractor().Start()
