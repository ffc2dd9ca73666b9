// SPDX-License-Identifier: BSD-3-Clause
/// Signed distances from a surface, sampled on a regular grid.
#ifndef SpectralWatermark_Private_SignedDistances_h
#define SpectralWatermark_Private_SignedDistances_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include <vtkSmartPointer.h>

class vtkImageData;

namespace spectralwatermark
{

/// The distances from a closed, oriented surface on a regular grid around it, negative inside, in
/// the model's units (float). They are correct in a narrow band around the surface and constant
/// beyond it. `resolution` is the number of grid steps along the longest side of the bounding box.
/// A point is inside if the surface winds around it, so parts may overlap. Throws Aborted.
vtkSmartPointer<vtkImageData> SignedDistances(const TriangleMesh& oriented, int resolution,
  const Progress& progress);

} // namespace spectralwatermark

#endif
