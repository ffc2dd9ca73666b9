// SPDX-License-Identifier: BSD-3-Clause
/// Checks, before work starts, whether it fits into memory. Linux grants more memory than there is
/// and kills the process that uses it.
#ifndef SpectralWatermark_Core_Support_MemoryBudget_h
#define SpectralWatermark_Core_Support_MemoryBudget_h

#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// The bytes that this process may still allocate: the least of the machine's free memory (with
/// swap), what RLIMIT_AS (`ulimit -v`) leaves, and what the process's control groups, such as a
/// container's, leave. Infinite where nothing is known about these, as on systems other than Linux.
double AvailableMemory();

/// The bytes that the control groups of this process leave, of versions 1 and 2; `root` stands for
/// "/".
double AvailableMemoryOfGroups(const std::string& root = "");

/// Throws InvalidInput when `bytes` exceed AvailableMemory(). `work` is what needs them, in the
/// plural; `advice` is what the user can do, about `parameter` if one decides.
void RequireMemory(double bytes, const std::string& work, const std::string& advice,
  const std::string& parameter = "");

/// Throws InvalidInput when that many triangles, each of which needs `bytesOfTriangle`, do not fit.
void RequireMemoryForTriangles(Index triangles, double bytesOfTriangle,
  const std::string& advice = "simplify the mesh first", const std::string& parameter = "");

} // namespace spectralwatermark

#endif
