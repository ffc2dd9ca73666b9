// SPDX-License-Identifier: BSD-3-Clause
/// Stores manifold harmonics in the arrays of a vtkPolyData, in which they travel down a pipeline,
/// and finds them there.
#ifndef SpectralWatermark_Private_HarmonicsArrays_h
#define SpectralWatermark_Private_HarmonicsArrays_h

#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Support/Progress.h"
#include "Private/PolyDataMesh.h"

namespace spectralwatermark
{

/// The default name of the basis array.
extern const char* const DefaultBasisName;

/// Adds the basis, the vertex masses, eigenvalues, residuals, spectrum and its magnitudes to the
/// output (the arrays are those that vtkManifoldHarmonics documents).
void AttachHarmonics(vtkPolyData* output, const char* basisName, const PolyDataMesh& mesh,
  const ManifoldHarmonics& harmonics);

/// The first `count` harmonics (0: all) that the input carries, if they still are a basis for its
/// geometry under this mass matrix. Nothing if there are none, too few, or stale ones. Throws
/// InvalidInput if the memory does not suffice.
std::optional<ManifoldHarmonics> FindHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, MassMatrix mass, Index count);

/// The first `count` harmonics under the lumped mass matrix: those of the input if FindHarmonics()
/// finds them, else newly computed ones. Each computation increments `eigensolves`.
ManifoldHarmonics FindOrComputeHarmonics(vtkPolyData* input, const PolyDataMesh& mesh, Index count,
  const Progress& progress, int& eigensolves);

/// The first `count` harmonics (0: all) under either mass matrix: those of the input if
/// FindHarmonics() finds them, else newly computed lumped ones. Each computation increments
/// `eigensolves`. Throws InvalidInput if none are found and `count` is 0.
ManifoldHarmonics FindAnyOrComputeHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, Index count, const Progress& progress, int& eigensolves);

/// Removes every array that AttachHarmonics() adds, from an output whose points have moved.
void DropHarmonics(vtkPolyData* output, const char* basisName = DefaultBasisName);

} // namespace spectralwatermark

#endif
