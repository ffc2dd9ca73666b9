// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Private_SignedDistances_h
#define SpectralWatermark_Private_SignedDistances_h

#include "Core/Mesh/TriangleMesh.h"
#include "Core/Support/Progress.h"

#include <vtkSmartPointer.h>

class vtkImageData;

namespace spectralwatermark
{

/// Distances from a closed, oriented surface on a regular grid around it, negative inside: in a narrow
/// band about the surface, and a constant beyond it. `resolution` is the number of the grid's steps
/// along the longest side. Inside is what the surface winds around, so that parts may overlap.
vtkSmartPointer<vtkImageData> SignedDistances(const TriangleMesh& oriented, int resolution,
  const Progress& progress);

} // namespace spectralwatermark

#endif
