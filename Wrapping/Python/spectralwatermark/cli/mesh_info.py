# SPDX-License-Identifier: BSD-3-Clause
"""Mesh statistics."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

from spectralwatermark import vtkSpectralWatermarkEmbed
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersCore import (
    vtkCleanPolyData,
    vtkFeatureEdges,
    vtkMassProperties,
    vtkPolyDataConnectivityFilter,
    vtkTriangleFilter,
)


class Statistics(TypedDict):
    points: int
    polygons: int
    vertices: int
    triangles: int
    components: int
    open_edges: int
    non_manifold_edges: int
    size: list[float]
    diagonal: float
    area: float
    volume: float | None  # None for an open surface
    arrays: list[str]


def describe(mesh: vtkPolyData) -> Statistics:
    """Counts, sizes, and whether the surface is closed. Points at the same place count as one vertex, as
    they do for the filters."""
    triangles = vtkTriangleFilter()
    triangles.SetInputData(mesh)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    clean = vtkCleanPolyData()
    clean.SetInputConnection(triangles.GetOutputPort())
    clean.PointMergingOn()
    clean.SetTolerance(0.0)
    clean.Update()
    surface = clean.GetOutput()
    regions = vtkPolyDataConnectivityFilter()
    regions.SetInputData(surface)
    regions.SetExtractionModeToAllRegions()
    regions.Update()
    size = vtkMassProperties()
    size.SetInputData(surface)
    size.Update()
    open_edges = _edges(surface, "BoundaryEdges")
    bounds = mesh.GetBounds()
    arrays = mesh.GetPointData()
    return {
        "points": mesh.GetNumberOfPoints(), "polygons": mesh.GetNumberOfPolys(),
        "vertices": surface.GetNumberOfPoints(), "triangles": surface.GetNumberOfPolys(),
        "components": regions.GetNumberOfExtractedRegions(),
        "open_edges": open_edges, "non_manifold_edges": _edges(surface, "NonManifoldEdges"),
        "size": [bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)],
        "diagonal": mesh.GetLength(), "area": size.GetSurfaceArea(),
        "volume": size.GetVolume() if open_edges == 0 else None,
        "arrays": [arrays.GetArrayName(i) or "" for i in range(arrays.GetNumberOfArrays())],
    }


def _edges(surface: vtkPolyData, kind: str) -> int:
    """The number of edges of one kind of vtkFeatureEdges."""
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    for each in ("BoundaryEdges", "NonManifoldEdges", "FeatureEdges", "ManifoldEdges"):
        getattr(edges, f"Set{each}")(each == kind)
    edges.Update()
    return edges.GetOutput().GetNumberOfLines()


def capacity_of(mesh: vtkPolyData, distortion: float, run: Callable[[vtkAlgorithm], object]) -> int:
    """The length in bits of the longest message that fits at this distortion."""
    embed = vtkSpectralWatermarkEmbed()
    embed.SetInputData(mesh)
    embed.SetMessage("1")
    embed.SetMaximumDistortion(distortion)
    embed.ReportCapacityOn()
    run(embed)
    return embed.GetCapacity()
