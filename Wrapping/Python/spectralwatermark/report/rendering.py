# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of meshes side by side, drawn off screen with VTK.

Importing this module needs a display: Debian's VTK draws through X, and a virtual one
(xvfb-run) is enough.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 - registers the chart's device
import vtkmodules.vtkRenderingFreeType  # noqa: F401 - registers text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers OpenGL
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonColor import vtkNamedColors
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkTable
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingContext2D import vtkContextActor
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
CAPTION_HEIGHT = 0.14  # share of a panel that its caption gets
BAR_HEIGHT = 0.15  # and its colour bar, in pictures that have one
PANEL_ASPECT = 1.0 / (1.0 - CAPTION_HEIGHT)  # width by height of what is left, at the least


@dataclass
class Panel:
    """One mesh of a picture: plain, or coloured by one component of a point array."""

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
    """Pale at 0 to dark red at the limit."""
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
    """A camera from the front, a little above and to the right, that the mesh just fills."""
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
    """Draws the panels in a grid, size pixels to a side each, seen by one camera or by one each if
    given."""
    rows = -(-len(panels) // columns)
    window = _window(columns * size, rows * size)
    window.SetNumberOfLayers(2)
    bottom = BAR_HEIGHT if any(panel.bar_title for panel in panels) else 0.0
    for i in range(rows * columns):
        row, column = divmod(i, columns)
        left, right = column / columns, (column + 1) / columns
        low, high = 1.0 - (row + 1) / rows, 1.0 - row / rows
        paper = vtkRenderer()  # white to the edge, also where no panel is left
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
    """What is written over the whole panel."""
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
    normals.NonManifoldTraversalOff()  # its loops would turn whole patches over
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
    """The panel's mesh with the component to show as its only scalars."""
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
    """Centred lines that begin at this height of the viewport."""
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


def table_of(**columns: Sequence[float] | np.ndarray) -> vtkTable:
    """Numbers for curves, a column for each name."""
    table = vtkTable()
    for name, values in columns.items():
        column = numpy_to_vtk(np.asarray(values, dtype=float), deep=True)
        column.SetName(name)
        table.AddColumn(column)
    return table


@dataclass
class Curve:
    """One line or set of markers of a chart; columns by name."""

    table: vtkTable
    x: str
    y: str
    label: str
    colour: str
    markers_only: bool = False


def write_chart(
    path: Path,
    curves: list[Curve],
    title: str,
    labels: tuple[str, str],
    size: tuple[int, int] = (1200, 560),
    logarithmic: bool = False,
    whole_numbers: bool = False,
    logarithmic_x: bool = False,
) -> None:
    """Draws curves over a common x axis, which can be one of counts."""
    chart = vtkChartXY()
    chart.SetTitle(title)
    chart.GetTitleProperties().SetFontSize(20)
    chart.SetShowLegend(True)
    chart.GetLegend().SetLabelSize(16)
    chart.GetLegend().SetInline(False)  # beside the plot, not over its curves
    for position, label in zip((vtkAxis.BOTTOM, vtkAxis.LEFT), labels):
        axis = chart.GetAxis(position)
        axis.SetTitle(label)
        axis.GetTitleProperties().SetFontSize(17)
        axis.GetTitleProperties().BoldOff()
        axis.GetLabelProperties().SetFontSize(15)
        axis.GetGridPen().SetColorF(0.9, 0.9, 0.9)
    chart.GetAxis(vtkAxis.LEFT).SetLogScale(logarithmic)
    chart.GetAxis(vtkAxis.BOTTOM).SetLogScale(logarithmic_x)
    if whole_numbers:
        _tick_whole_numbers(chart.GetAxis(vtkAxis.BOTTOM), curves)
    for curve in curves:
        plot = chart.AddPlot(vtkChart.POINTS if curve.markers_only else vtkChart.LINE)
        plot.SetInputData(curve.table, curve.x, curve.y)
        plot.SetLabel(curve.label)
        colour = vtkNamedColors().GetColor3ub(curve.colour)
        plot.SetColor(colour.GetRed(), colour.GetGreen(), colour.GetBlue(), 255)
        plot.SetWidth(2.0)
        if curve.markers_only:
            plot.SetMarkerStyle(vtkPlotPoints.CIRCLE)
            plot.SetMarkerSize(11.0)

    window = _window(*size)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    renderer.AddActor(actor)
    actor.GetScene().SetRenderer(renderer)
    window.AddRenderer(renderer)
    _write(window, path)


def _tick_whole_numbers(axis: vtkAxis, curves: list[Curve]) -> None:
    columns = [vtk_to_numpy(curve.table.GetColumnByName(curve.x)) for curve in curves]
    first = min(column.min() for column in columns)
    last = max(column.max() for column in columns)
    ticks = vtkDoubleArray()
    for tick in range(int(first), int(last) + 1):
        ticks.InsertNextValue(tick)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(float(first), max(float(last), float(first) + 1.0))
    axis.SetCustomTickPositions(ticks)


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
    writer.WriteToMemoryOn()  # to a full disk VTK would write nothing, and raise nothing
    writer.Write()
    # Written beside and renamed: a picture is there whole or not at all.
    partial = path.with_suffix(".partial.png")
    partial.write_bytes(vtk_to_numpy(writer.GetResult()))
    partial.replace(path)
