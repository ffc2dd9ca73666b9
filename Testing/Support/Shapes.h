// SPDX-License-Identifier: BSD-3-Clause
/// Meshes whose spectra are known, for the tests.
#ifndef SpectralWatermark_Testing_Shapes_h
#define SpectralWatermark_Testing_Shapes_h

#include "Core/Mesh/TriangleMesh.h"

#include <vector>

namespace shapes
{

using spectralwatermark::Index;
using spectralwatermark::TriangleMesh;

/// An icosahedron subdivided `level` times (each triangle into four) onto the sphere.
TriangleMesh Icosphere(int level, double radius = 1.0);

/// The rectangle [0, a] x [0, b] in the plane z = 0, with nx x ny cells of two triangles.
TriangleMesh Rectangle(Index nx, Index ny, double a, double b);

/// Radii 1 and 0.4, about the z axis.
TriangleMesh Torus(Index around, Index across);

/// The unit cube, with so many squares of two triangles along each edge.
TriangleMesh Cube(Index steps);

/// A ball without symmetry: the cube's squares, none of which are flat any more.
TriangleMesh SquaresOnABall(Index steps);

/// A closed surface without symmetry: a sphere with bumps of several sizes.
TriangleMesh Bumpy(int level);

/// The meshes beside each other as one, the k-th moved by k * offset along x.
TriangleMesh Union(const std::vector<TriangleMesh>& parts, double offset);

/// A box about the origin with these sides: twelve triangles.
TriangleMesh Box(double a, double b, double c);

/// Point k at k^power * direction, and a triangle of any three that follow one another: no area.
TriangleMesh PointsInARow(Index count, int power, const Eigen::RowVector3d& direction);

/// The mesh with further points, and triangles of any of its points: for degenerate cases.
TriangleMesh WithTriangles(TriangleMesh mesh, const std::vector<Eigen::RowVector3d>& points,
  const std::vector<std::vector<Index>>& triangles);

} // namespace shapes

#endif
