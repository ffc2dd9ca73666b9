# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes side by side, drawn off screen with VTK.

Drawing needs a display: Debian's VTK draws through X, and a virtual display (xvfb-run) is enough.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401 - registers text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers OpenGL
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

TEXT_COLOUR = (0.15, 0.17, 0.2)
CLAY = (0.86, 0.82, 0.76)
CAPTION_HEIGHT = 0.14  # the caption's share of a panel's height
BAR_HEIGHT = 0.15  # the colour bar's share, in pictures that have one
PANEL_ASPECT = 1.0 / (1.0 - CAPTION_HEIGHT)  # smallest width by height of the room for the mesh


@dataclass
class Panel:
    """One mesh of a picture, plain or coloured by one component of a point array."""

    mesh: vtkPolyData
    caption: str
    array: str | None = None
    component: int = 0
    colours: vtkColorTransferFunction | None = None
    bar_title: str | None = None


def diverging(limit: float) -> vtkColorTransferFunction:
    """Blue below 0, white at 0, red above."""
    return _ramp([(-limit, 0.13, 0.30, 0.62), (0.0, 0.96, 0.96, 0.96), (limit, 0.70, 0.09, 0.17)])


def heat(limit: float) -> vtkColorTransferFunction:
    """From pale at 0 to dark red at the limit."""
    steps = [(1.0, 0.97, 0.88), (0.99, 0.80, 0.50), (0.94, 0.48, 0.26), (0.70, 0.09, 0.12)]
    return _ramp([(limit * i / 3.0, *colour) for i, colour in enumerate(steps)])


def _ramp(points: list[tuple[float, float, float, float]]) -> vtkColorTransferFunction:
    ramp = vtkColorTransferFunction()
    ramp.SetColorSpaceToLab()
    for point in points:
        ramp.AddRGBPoint(*point)
    return ramp


def view_of(
    mesh: vtkPolyData,
    front: tuple[float, float, float] = (0.0, 0.0, 1.0),
    up: tuple[float, float, float] = (0.0, 1.0, 0.0),
) -> vtkCamera:
    """A camera in front of the mesh, a little above and to the right; the mesh just fills its view."""
    renderer = vtkRenderer()
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(up)
    camera.SetPosition(np.array(front) + 0.35 * np.cross(up, front) + 0.25 * np.array(up))
    camera.SetViewAngle(20.0)
    renderer.ResetCamera(mesh.GetBounds())
    to_camera = np.array([[camera.GetViewTransformMatrix().GetElement(row, column)
                           for column in range(4)] for row in range(3)])
    points = vtk_to_numpy(mesh.GetPoints().GetData()) @ to_camera[:, :3].T + to_camera[:, 3]
    seen = np.abs(points[:, :2] / -points[:, 2:]) / np.tan(np.radians(camera.GetViewAngle()) / 2.0)
    camera.Zoom(0.95 / max(seen[:, 0].max() / PANEL_ASPECT, seen[:, 1].max()))
    return camera


def write_panels(
    path: Path, panels: list[Panel], columns: int, size: int, camera: vtkCamera | None = None,
    cameras: Sequence[vtkCamera] = (),
) -> None:
    """Draws the panels in a grid; each is size pixels wide and high.

    One camera for all panels, one for each, or by default a view that fits each mesh.
    """
    rows = -(-len(panels) // columns)
    window = _window(columns * size, rows * size)
    window.SetNumberOfLayers(2)
    bottom = BAR_HEIGHT if any(panel.bar_title for panel in panels) else 0.0
    for i in range(rows * columns):
        row, column = divmod(i, columns)
        left, right = column / columns, (column + 1) / columns
        low, high = 1.0 - (row + 1) / rows, 1.0 - row / rows
        paper = vtkRenderer()  # the white background, also where the grid has no panel
        paper.SetBackground(1.0, 1.0, 1.0)
        paper.SetViewport(left, low, right, high)
        window.AddRenderer(paper)
        if i >= len(panels):
            continue
        panel = panels[i]
        mapper = _mapper(panel)
        picture = _mesh_renderer(
            mapper, cameras[i] if cameras else camera or view_of(panel.mesh))
        picture.SetViewport(
            left, low + bottom / rows, right, high - CAPTION_HEIGHT / rows)
        window.AddRenderer(picture)
        text = _text_renderer(panel, mapper, size)
        text.SetViewport(left, low, right, high)
        window.AddRenderer(text)
    _write(window, path)


def _mesh_renderer(mapper: vtkPolyDataMapper, camera: vtkCamera) -> vtkRenderer:
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.UseFXAAOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*CLAY)
    actor.GetProperty().SetAmbient(0.12)
    actor.GetProperty().SetDiffuse(0.85)
    actor.GetProperty().SetSpecular(0.08)
    renderer.AddActor(actor)
    own = vtkCamera()
    own.DeepCopy(camera)
    renderer.SetActiveCamera(own)
    renderer.ResetCameraClippingRange()
    return renderer


def _text_renderer(panel: Panel, mapper: vtkPolyDataMapper, size: int) -> vtkRenderer:
    """The caption and colour bar, drawn over the whole panel."""
    renderer = vtkRenderer()
    renderer.SetLayer(1)
    renderer.AddViewProp(_text(panel.caption, max(12, size // 24), 0.97))
    if panel.bar_title:
        renderer.AddViewProp(_bar(mapper, size))
        renderer.AddViewProp(_text(panel.bar_title, max(11, size // 34), 0.055))
    return renderer


def _mapper(panel: Panel) -> vtkPolyDataMapper:
    normals = vtkPolyDataNormals()
    normals.SetInputData(_coloured(panel))
    normals.SplittingOff()
    normals.NonManifoldTraversalOff()  # traversing non-manifold edges would flip whole patches
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    if panel.array is None:
        mapper.ScalarVisibilityOff()
        return mapper
    mapper.SetScalarModeToUsePointData()
    mapper.SetLookupTable(panel.colours)
    mapper.SetScalarRange(*panel.colours.GetRange())
    mapper.InterpolateScalarsBeforeMappingOn()
    return mapper


def _coloured(panel: Panel) -> vtkPolyData:
    """A copy of the panel's mesh whose only scalars are the component to show."""
    mesh = vtkPolyData()
    mesh.SetPoints(panel.mesh.GetPoints())
    mesh.SetPolys(panel.mesh.GetPolys())
    mesh.SetStrips(panel.mesh.GetStrips())
    if panel.array is not None:
        values = vtk_to_numpy(panel.mesh.GetPointData().GetArray(panel.array))
        one = values if values.ndim == 1 else values[:, panel.component]
        mesh.GetPointData().SetScalars(numpy_to_vtk(one, deep=True))
    return mesh


def _text(text: str, font_size: int, top: float) -> vtkTextActor:
    """Centred lines that begin at this height of the viewport, from 0 to 1."""
    actor = vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetColor(*TEXT_COLOUR)
    style.SetFontSize(font_size)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToTop()
    style.SetLineSpacing(1.2)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.GetPositionCoordinate().SetValue(0.5, top)
    return actor


def _bar(mapper: vtkPolyDataMapper, size: int) -> vtkScalarBarActor:
    bar = vtkScalarBarActor()
    bar.SetLookupTable(mapper.GetLookupTable())
    bar.SetTitle("")
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(4)
    bar.SetLabelFormat("%.3g")
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetPosition(0.15, 0.06)
    bar.SetWidth(0.7)
    bar.SetHeight(0.08)
    bar.UnconstrainedFontSizeOn()
    style = bar.GetLabelTextProperty()
    style.SetColor(*TEXT_COLOUR)
    style.SetFontSize(max(11, size // 34))
    style.BoldOff()
    style.ItalicOff()
    style.ShadowOff()
    return bar


def _window(width: int, height: int) -> vtkRenderWindow:
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(width, height)
    return window


def _write(window: vtkRenderWindow, path: Path) -> None:
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    # VTK reports no error when the disk is full; Python does.
    writer.WriteToMemoryOn()
    writer.Write()
    # Renaming a complete file makes sure that no partial picture is left.
    partial = path.with_suffix(".partial.png")
    partial.write_bytes(vtk_to_numpy(writer.GetResult()))
    partial.replace(path)
