// SPDX-License-Identifier: BSD-3-Clause
/// The tables on port 1 of the watermarking filters, for the robust scheme.
#ifndef SpectralWatermark_Private_CarrierTable_h
#define SpectralWatermark_Private_CarrierTable_h

#include "Core/RobustScheme/RobustReader.h"
#include "Core/RobustScheme/SurfaceMotion.h"

class vtkTable;

namespace spectralwatermark
{

/// A row per round: Iteration, Distortion (percent of the diagonal), LargestError (steps).
void FillRoundsTable(vtkTable* table, const std::vector<RobustEmbeddingRound>& rounds);

/// A row per carrier: Carrier (1-based), Value, Margin, Bit.
void FillCarriersTable(vtkTable* table, const RobustReading& reading);

} // namespace spectralwatermark

#endif
