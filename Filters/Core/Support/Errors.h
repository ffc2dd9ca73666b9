// SPDX-License-Identifier: BSD-3-Clause
/// What the Core throws. Misuse throws; a computation that does not converge is a status.
#ifndef SpectralWatermark_Core_Support_Errors_h
#define SpectralWatermark_Core_Support_Errors_h

#include <stdexcept>

namespace spectralwatermark
{

/// The caller can mend it: a bad mesh or parameters that do not fit it. what() says how.
struct InvalidInput : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The numerics gave up: a singular factorisation, or eigenpairs that could not be completed.
struct SolverFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The progress callback asked to stop. Not an error.
struct Aborted : std::exception
{
  const char* what() const noexcept override { return "aborted"; }
};

} // namespace spectralwatermark

#endif
