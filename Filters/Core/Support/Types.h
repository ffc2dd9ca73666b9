// SPDX-License-Identifier: BSD-3-Clause
/// Types and constants that all of Core uses.
#ifndef SpectralWatermark_Core_Support_Types_h
#define SpectralWatermark_Core_Support_Types_h

#include <Eigen/SparseCore>

namespace spectralwatermark
{

/// A signed index or count, as wide as a pointer.
using Index = Eigen::Index;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double Pi = 3.14159265358979323846;

} // namespace spectralwatermark

#endif
