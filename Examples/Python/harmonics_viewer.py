#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Shows a mesh coloured by its harmonics, with a slider to choose one.

    PYTHONPATH=build/lib/python3/dist-packages /usr/bin/python3 Examples/Python/harmonics_viewer.py \
        MESH [--number M] [--show K --picture OUTPUT.png]

With --picture it draws harmonic K into a file and ends.
"""

import argparse
from pathlib import Path

import vtkmodules.vtkInteractionStyle  # noqa: F401 - registers the interactor's style
import vtkmodules.vtkRenderingFreeType  # noqa: F401 - registers text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers OpenGL
from spectralwatermark import vtkManifoldHarmonics
from spectralwatermark.io import read_mesh
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkInteractionWidgets import vtkSliderRepresentation2D, vtkSliderWidget
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkRenderWindowInteractor,
    vtkWindowToImageFilter,
)

NAME = "ManifoldHarmonics"


class Viewer:
    def __init__(self, path: Path, count: int):
        harmonics = vtkManifoldHarmonics()
        harmonics.SetInputData(read_mesh(path))
        harmonics.SetNumberOfHarmonics(count)
        harmonics.Update()
        self.mesh = harmonics.GetOutput()

        self.mapper = vtkPolyDataMapper()
        self.mapper.SetInputData(self.mesh)
        self.mapper.SetScalarModeToUsePointFieldData()
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        renderer = vtkRenderer()
        renderer.SetBackground(1.0, 1.0, 1.0)
        renderer.AddActor(actor)
        self.window = vtkRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetSize(900, 700)
        self.window.SetWindowName(f"Manifold harmonics of {path.name}")
        self.window.AddRenderer(renderer)
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.slider = self._slider(count)

    def show(self, number: int) -> None:
        """Colours the mesh by a harmonic, counted from 1: blue below 0, red above."""
        limit = max(abs(value) for value in
                    self.mesh.GetPointData().GetArray(NAME).GetRange(number - 1)) or 1.0
        colours = vtkColorTransferFunction()
        colours.AddRGBPoint(-limit, 0.23, 0.30, 0.75)
        colours.AddRGBPoint(0.0, 0.87, 0.87, 0.87)
        colours.AddRGBPoint(limit, 0.71, 0.02, 0.15)
        colours.SetVectorModeToComponent()
        colours.SetVectorComponent(number - 1)
        self.mapper.SetLookupTable(colours)
        self.mapper.SelectColorArray(NAME)
        self.slider.GetRepresentation().SetValue(number)
        self.window.Render()

    def _slider(self, count: int) -> vtkSliderWidget:
        bar = vtkSliderRepresentation2D()
        bar.SetMinimumValue(1)
        bar.SetMaximumValue(count)
        bar.SetLabelFormat("%.0f")
        bar.SetTitleText("harmonic")
        bar.GetPoint1Coordinate().SetCoordinateSystemToNormalizedDisplay()
        bar.GetPoint1Coordinate().SetValue(0.2, 0.08)
        bar.GetPoint2Coordinate().SetCoordinateSystemToNormalizedDisplay()
        bar.GetPoint2Coordinate().SetValue(0.8, 0.08)
        for text in (bar.GetTitleProperty(), bar.GetLabelProperty()):
            text.SetColor(0.2, 0.2, 0.2)
            text.ShadowOff()
        bar.GetTubeProperty().SetColor(0.75, 0.75, 0.75)
        bar.GetCapProperty().SetColor(0.75, 0.75, 0.75)
        bar.GetSliderProperty().SetColor(0.2, 0.4, 0.7)
        slider = vtkSliderWidget()
        slider.SetInteractor(self.interactor)
        slider.SetRepresentation(bar)
        slider.AddObserver(vtkCommand.InteractionEvent,
                           lambda *_: self.show(round(bar.GetValue())))
        slider.EnabledOn()
        return slider

    def write(self, path: Path) -> None:
        image = vtkWindowToImageFilter()
        image.SetInput(self.window)
        writer = vtkPNGWriter()
        writer.SetFileName(str(path))
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", type=Path)
    parser.add_argument("--number", type=int, default=100, help="number of harmonics (default: 100)")
    parser.add_argument("--show", type=int, default=10, help="the harmonic to show first (default: 10)")
    parser.add_argument("--picture", type=Path, help="draw the harmonic into this PNG file and end")
    arguments = parser.parse_args()
    viewer = Viewer(arguments.mesh, arguments.number)
    viewer.interactor.Initialize()
    viewer.show(min(arguments.show, arguments.number))
    if arguments.picture is not None:
        viewer.write(arguments.picture)
    else:
        viewer.interactor.Start()


if __name__ == "__main__":
    main()
