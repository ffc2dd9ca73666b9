// SPDX-License-Identifier: BSD-3-Clause
/// Finds the points of a surface that are closest to given points, and interpolates functions
/// there.
#ifndef SpectralWatermark_Private_ClosestPoints_h
#define SpectralWatermark_Private_ClosestPoints_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkGenericCell;
class vtkPolyData;
class vtkStaticCellLocator;

namespace spectralwatermark
{

/// The closest point of a surface that a locator finds.
struct NearestPoint
{
  Index Triangle = -1; ///< the triangle that contains the point; -1 if no triangle has an area
  Eigen::RowVector3d Point = Eigen::RowVector3d::Zero();
  double Distance = 0.0; ///< from the point asked about
};

/// The point of the locator's surface that is closest to `from`. The locator uses `cell` as
/// workspace.
NearestPoint FindNearest(vtkStaticCellLocator* locator, vtkGenericCell* cell,
  const Eigen::RowVector3d& from);

/// A point of a surface, in barycentric coordinates.
struct SurfacePoint
{
  Index Triangle = -1;
  Eigen::RowVector3d Weights; ///< the weights of the triangle's corners, with sum 1
  double Distance = 0.0;      ///< from the point asked about
};

/// Finds closest points of one surface, for which it builds a locator. The surface must outlive it.
class ClosestPoints
{
public:
  explicit ClosestPoints(const TriangleMesh& surface);
  ~ClosestPoints();
  ClosestPoints(const ClosestPoints&) = delete;
  void operator=(const ClosestPoints&) = delete;

  const TriangleMesh& Mesh() const { return this->Surface; }

  /// The closest surface point for each row of `points`. Throws InvalidInput if no triangle of the
  /// surface has an area, Aborted.
  std::vector<SurfacePoint> To(const TriangleMesh::PointMatrix& points, int threads,
    const Progress& progress) const;

  /// Interpolates functions on the surface linearly: `values` has a row per vertex of the surface,
  /// the result a row per surface point.
  Eigen::MatrixXd Interpolate(const Eigen::MatrixXd& values,
    const std::vector<SurfacePoint>& points) const;

private:
  const TriangleMesh& Surface;
  vtkSmartPointer<vtkPolyData> PolyData;
  vtkNew<vtkStaticCellLocator> Locator;
};

/// Transfers functions from the vertices of one mesh to those of another. `values` has a row per
/// vertex of `from`, the result a row per vertex of `to`. Meshes with the same triangles share
/// their rows; otherwise the values are interpolated linearly at the closest point of the surface
/// of `from`. Throws InvalidInput if no triangle of `from` has an area.
Eigen::MatrixXd TransferToVertices(const TriangleMesh& from, const Eigen::MatrixXd& values,
  const TriangleMesh& to);

} // namespace spectralwatermark

#endif
