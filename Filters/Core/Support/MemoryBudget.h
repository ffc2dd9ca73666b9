// SPDX-License-Identifier: BSD-3-Clause
/// Whether work fits into memory, asked before it starts: Linux grants what is not there, and kills the
/// process that uses it.
#ifndef SpectralWatermark_Core_Support_MemoryBudget_h
#define SpectralWatermark_Core_Support_MemoryBudget_h

#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// Bytes that this process may still take: the least of what the machine has free (with swap), what is
/// left of RLIMIT_AS (`ulimit -v`), and what is left to its control groups, as of containers. Infinite
/// where nothing is known of them, as on other systems than Linux.
double AvailableMemory();

/// What is left to the control groups of this process, of both versions; `root` stands for "/".
double AvailableMemoryOfGroups(const std::string& root = "");

/// Throws InvalidInput when `bytes` are more than that. `work` is what needs them, in the plural; `advice` is
/// what the user can do, about `parameter` if one decides.
void RequireMemory(double bytes, const std::string& work, const std::string& advice,
  const std::string& parameter = "");

/// The same, where so many bytes are needed for each triangle.
void RequireMemoryForTriangles(Index triangles, double bytesOfTriangle,
  const std::string& advice = "simplify the mesh first", const std::string& parameter = "");

} // namespace spectralwatermark

#endif
