// SPDX-License-Identifier: BSD-3-Clause
/// How far a mesh moved, vertex by vertex (paper, 3.2.2).
#ifndef SpectralWatermark_Core_Distortion_PointDifferences_h
#define SpectralWatermark_Core_Distortion_PointDifferences_h

#include "Core/Mesh/EdgeTopology.h"
#include "Core/Mesh/Measures.h"

namespace spectralwatermark
{

/// Eq. 14 at every vertex: v minus the mean of its neighbours, weighted by inverse edge length.
/// 0 at a vertex without neighbours, and at one that coincides with a neighbour (the limit of
/// the equation as the edge shrinks). n x 3, in length.
TriangleMesh::PointMatrix GeometricLaplacian(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& points);

/// The terms of eq. 13: the distance between corresponding vertices. In length.
Eigen::VectorXd GeometricDifference(const TriangleMesh::PointMatrix& reference,
  const TriangleMesh::PointMatrix& distorted);

/// The terms of eq. 15: the distance between geometric Laplacians. In length.
Eigen::VectorXd CurvatureDifference(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& reference, const TriangleMesh::PointMatrix& distorted);

/// Diagonal of the points' bounding box: the unit of distortion.
double BoundingBoxDiagonal(const TriangleMesh::PointMatrix& points);

} // namespace spectralwatermark

#endif
