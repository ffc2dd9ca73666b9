// SPDX-License-Identifier: BSD-3-Clause
/// The differences between two versions of a mesh, vertex by vertex (paper, 3.2.2).
#ifndef SpectralWatermark_Core_Distortion_PointDifferences_h
#define SpectralWatermark_Core_Distortion_PointDifferences_h

#include "Core/Mesh/EdgeTopology.h"

namespace spectralwatermark
{

/// The geometric Laplacian of every vertex (eq. 14): the vertex minus the mean of its neighbours,
/// weighted by inverse edge length. It is 0 at a vertex without neighbours, and at one that
/// coincides with a neighbour (the limit of the equation as the edge shrinks). n x 3, in length.
TriangleMesh::PointMatrix GeometricLaplacian(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& points);

/// The terms of eq. 13: the distance between corresponding vertices, in length.
Eigen::VectorXd GeometricDifference(const TriangleMesh::PointMatrix& reference,
  const TriangleMesh::PointMatrix& distorted);

/// The terms of eq. 15: the distance between the geometric Laplacians of corresponding vertices, in
/// length. `edges` are the edges of the reference.
Eigen::VectorXd CurvatureDifference(const std::vector<Edge>& edges,
  const TriangleMesh::PointMatrix& reference, const TriangleMesh::PointMatrix& distorted);

} // namespace spectralwatermark

#endif
