// SPDX-License-Identifier: BSD-3-Clause
/// Functions of one mesh on the vertices of another.
#ifndef SpectralWatermark_Private_BasisTransfer_h
#define SpectralWatermark_Private_BasisTransfer_h

#include "Core/Mesh/TriangleMesh.h"

#include "Private/PolyDataMesh.h"

namespace spectralwatermark
{

/// `values`, a row per vertex of `from`, as a row per vertex of `to`: row by row when both have
/// the same triangles, else linearly interpolated at the closest point of the surface of `from`.
Eigen::MatrixXd TransferToVertices(const TriangleMesh& from, const Eigen::MatrixXd& values,
  const TriangleMesh& to);

} // namespace spectralwatermark

#endif
