// SPDX-License-Identifier: BSD-3-Clause
/// Points of one mesh's surface that are closest to points elsewhere.
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

/// What a locator finds.
struct NearestPoint
{
  Index Triangle = -1; ///< -1: none has an area
  Eigen::RowVector3d Point = Eigen::RowVector3d::Zero();
};

/// `cell` is where the locator works.
NearestPoint FindNearest(vtkStaticCellLocator* locator, vtkGenericCell* cell,
  const Eigen::RowVector3d& from);

/// A point of a surface: in a triangle, as a mean of its corners.
struct SurfacePoint
{
  Index Triangle = -1;
  Eigen::RowVector3d Weights; ///< of the corners, with sum 1
  double Distance = 0.0;      ///< from the point that was asked for
};

class ClosestPoints
{
public:
  explicit ClosestPoints(const TriangleMesh& surface);
  ~ClosestPoints();
  ClosestPoints(const ClosestPoints&) = delete;
  void operator=(const ClosestPoints&) = delete;

  const TriangleMesh& Mesh() const { return this->Surface; }

  /// One for each row of `points`. Throws InvalidInput when the surface has only triangles without area.
  std::vector<SurfacePoint> To(const TriangleMesh::PointMatrix& points, int threads,
    const Progress& progress) const;

  /// `values` has a row for each vertex of the surface; the result one for each of the points.
  Eigen::MatrixXd Interpolate(const Eigen::MatrixXd& values,
    const std::vector<SurfacePoint>& points) const;

private:
  const TriangleMesh& Surface;
  vtkSmartPointer<vtkPolyData> PolyData;
  vtkNew<vtkStaticCellLocator> Locator;
};

} // namespace spectralwatermark

#endif
