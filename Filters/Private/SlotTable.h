// SPDX-License-Identifier: BSD-3-Clause
/// The tables on port 1 of the watermarking filters.
#ifndef SpectralWatermark_Private_SlotTable_h
#define SpectralWatermark_Private_SlotTable_h

#include "Core/PaperScheme/Slots.h"

class vtkTable;

namespace spectralwatermark
{

/// A row per iteration and slot: Iteration, Slot, Component, Magnitude, Average, Deviation,
/// BitWanted, BitRead.
void FillEmbeddingTable(vtkTable* table, const std::vector<std::vector<SlotReading>>& history,
  const std::string& message);

/// A row per bit: Slot, Component, Magnitude, Average, Deviation, Margin, Bit,
/// LogLikelihoodRatio0, LogLikelihoodRatio1, Confidence.
void FillDetectionTable(vtkTable* table, const std::vector<SlotReading>& readings,
  const SlotOptions& options);

} // namespace spectralwatermark

#endif
