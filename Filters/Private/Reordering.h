// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Private_Reordering_h
#define SpectralWatermark_Private_Reordering_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkPolyData;

namespace spectralwatermark
{

/// The points with these ids, in this order, with the cells that have all of theirs among them, and
/// the attributes of both. Polygons come in the order of `polygons` (numbers from 0, all of them),
/// other cells as they are.
vtkSmartPointer<vtkPolyData> ExtractPoints(vtkPolyData* input, const std::vector<vtkIdType>& points,
  const std::vector<vtkIdType>& polygons);

/// The numbers from 0 to count - 1.
std::vector<vtkIdType> IdentityOrder(vtkIdType count);

} // namespace spectralwatermark

#endif
