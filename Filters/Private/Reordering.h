// SPDX-License-Identifier: BSD-3-Clause
/// Copies of a vtkPolyData with points and polygons reordered or left out.
#ifndef SpectralWatermark_Private_Reordering_h
#define SpectralWatermark_Private_Reordering_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkPolyData;

namespace spectralwatermark
{

/// A copy with the points of these ids, in this order, the cells whose points are all among them,
/// and the attributes of both. Polygons come in the order of `polygons`, which are the numbers of
/// all polygons from 0; other cells keep their order.
vtkSmartPointer<vtkPolyData> ExtractPoints(vtkPolyData* input, const std::vector<vtkIdType>& points,
  const std::vector<vtkIdType>& polygons);

/// The numbers from 0 to count - 1 in ascending order.
std::vector<vtkIdType> IdentityOrder(vtkIdType count);

} // namespace spectralwatermark

#endif
