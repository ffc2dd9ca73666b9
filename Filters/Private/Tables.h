// SPDX-License-Identifier: BSD-3-Clause
/// The tables that the filters have on output port 1, and the columns that they are made of.
#ifndef SpectralWatermark_Private_Tables_h
#define SpectralWatermark_Private_Tables_h

#include "Core/Harmonics/ManifoldHarmonics.h"
#include "Core/PaperScheme/Slots.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/RobustScheme/SurfaceMotion.h"
#include "Private/PolyDataMesh.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkTable;

namespace spectralwatermark
{

/// A column with the value valueOf(row) for each row, counted from 0. ArrayType is vtkIntArray or
/// vtkDoubleArray.
template <typename ArrayType, typename Function>
vtkSmartPointer<ArrayType> Column(const char* name, Index rows, const Function& valueOf)
{
  auto column = vtkSmartPointer<ArrayType>::New();
  column->SetName(name);
  for (Index row = 0; row < rows; ++row)
  {
    column->InsertNextValue(valueOf(row));
  }
  return column;
}

/// The spectrum of a mesh, a row per harmonic: Component (1-based), Eigenvalue (1/length^2), X, Y,
/// Z, Magnitude (length^2).
void FillSpectrumTable(vtkTable* table, const ManifoldHarmonics& harmonics,
  const PolyDataMesh& mesh);

/// The history of an embedding of the paper's scheme, a row per iteration and slot: Iteration (0:
/// the input), Slot and Component (1-based), Magnitude, Average, Deviation (length^2), BitWanted,
/// BitRead.
void FillEmbeddingTable(vtkTable* table, const std::vector<std::vector<SlotReading>>& history,
  const std::string& message);

/// A reading of the paper's scheme, a row per bit: Slot and Component (1-based), Magnitude,
/// Average, Deviation (length^2), Margin, Bit, LogLikelihoodRatio0, LogLikelihoodRatio1,
/// Confidence.
void FillDetectionTable(vtkTable* table, const std::vector<SlotReading>& readings,
  const SlotOptions& options);

/// The rounds of an embedding of the robust scheme, a row per round: Iteration (0: the input),
/// Distortion (percent of the bounding-box diagonal), LargestError (steps).
void FillRoundsTable(vtkTable* table, const std::vector<RobustEmbeddingRound>& rounds);

/// A reading of the robust scheme, a row per carrier: Carrier (1-based), Value, Margin (from -1,
/// certainly 0, to 1, certainly 1), Bit.
void FillCarriersTable(vtkTable* table, const RobustReading& reading);

} // namespace spectralwatermark

#endif
