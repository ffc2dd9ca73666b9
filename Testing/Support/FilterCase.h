// SPDX-License-Identifier: BSD-3-Clause
/// A filter with any properties on any mesh, and what must hold whatever they are.
#ifndef SpectralWatermark_Testing_FilterCase_h
#define SpectralWatermark_Testing_FilterCase_h

#include "Support/Bytes.h"

#include <array>
#include <string>

namespace fuzzing
{

/// The classes, without vtk.
constexpr std::array<const char*, 7> FilterNames{ "ManifoldHarmonics",
  "ManifoldHarmonicsReconstruction", "ManifoldHarmonicsSimilarity", "MeshAttack", "MeshDistortion",
  "SpectralWatermarkDetect", "SpectralWatermarkEmbed" };

/// How a case went.
struct Outcome
{
  std::string Wrong; ///< what does not hold; "" when all does
  std::string Error; ///< what the filter said, when it refused
};

/// Runs one of them. Must hold: the inputs stay as they were; there is either an error, with a text and
/// empty outputs, or an output of finite numbers, with the cells and the data of the input where the
/// filter only moves points; and what embedding says that it read back, a detector reads.
///
/// What a property costs is in proportion (iterations, subdivisions) is kept small.
Outcome RunFilterCase(const std::string& name, Bytes& bytes);

} // namespace fuzzing

#endif
