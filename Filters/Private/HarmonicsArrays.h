// SPDX-License-Identifier: BSD-3-Clause
/// How a basis travels down a pipeline in the arrays of a vtkPolyData.
#ifndef SpectralWatermark_Private_HarmonicsArrays_h
#define SpectralWatermark_Private_HarmonicsArrays_h

#include "Core/Harmonics/LaplaceOperator.h"
#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/Support/Progress.h"
#include "Private/PolyDataMesh.h"

class vtkTable;

namespace spectralwatermark
{

/// Name of the basis array unless a filter's ArrayName says otherwise.
extern const char* const DefaultBasisName;

/// Adds the basis, masses, eigenvalues, residuals, spectrum and magnitudes.
void AttachHarmonics(vtkPolyData* output, const char* basisName, const PolyDataMesh& mesh,
  const ManifoldHarmonics& harmonics);

/// A row per harmonic: Component, Eigenvalue, X, Y, Z, Magnitude.
void FillSpectrumTable(vtkTable* table, const ManifoldHarmonics& harmonics,
  const PolyDataMesh& mesh);

/// The first `count` harmonics (0: all) that the input carries, if they are a basis of its
/// geometry as it is now; nothing when there are none, too few, or stale ones.
std::optional<ManifoldHarmonics> FindHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, MassMatrix mass, Index count);

/// FindHarmonics() with lumped masses, or computed afresh; `eigensolves` counts the latter.
ManifoldHarmonics FindOrComputeHarmonics(vtkPolyData* input, const PolyDataMesh& mesh, Index count,
  const Progress& progress, int& eigensolves);

/// A basis under either mass matrix: the first `count` harmonics (0: all) that the input carries,
/// else, unless `count` is 0, lumped ones computed afresh. Throws InvalidInput when there are none
/// and `count` is 0.
ManifoldHarmonics FindAnyOrComputeHarmonics(vtkPolyData* input, const char* basisName,
  const PolyDataMesh& mesh, Index count, const Progress& progress, int& eigensolves);

/// Removes every array that AttachHarmonics() adds: for outputs whose points moved.
void DropHarmonics(vtkPolyData* output, const char* basisName = DefaultBasisName);

} // namespace spectralwatermark

#endif
