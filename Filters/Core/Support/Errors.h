// SPDX-License-Identifier: BSD-3-Clause
/// The errors that Core throws. Misuse throws; a computation that does not converge is a status.
#ifndef SpectralWatermark_Core_Support_Errors_h
#define SpectralWatermark_Core_Support_Errors_h

#include <stdexcept>
#include <string>
#include <utility>

namespace spectralwatermark
{

/// An error in parts, so that whoever reports it can put its own name to the parameter.
struct Failure : std::runtime_error
{
  Failure(std::string parameter, std::string reason, std::string advice)
    : std::runtime_error(TextOf(parameter, reason, advice))
    , Parameter(std::move(parameter))
    , Reason(std::move(reason))
    , Advice(std::move(advice))
  {
  }

  /// "parameter: reason; advice", without what is empty.
  static std::string TextOf(const std::string& parameter, const std::string& reason,
    const std::string& advice)
  {
    return (parameter.empty() ? "" : parameter + ": ") + reason +
      (advice.empty() ? "" : "; " + advice);
  }

  /// The option at fault, by its name in the options struct; empty if it is the mesh.
  std::string Parameter;
  /// What is wrong, without the parameter's name.
  std::string Reason;
  /// What the user can do; may be empty.
  std::string Advice;
};

/// An error that the caller can correct: a bad mesh, or parameters that contradict each other or do
/// not fit the mesh.
struct InvalidInput : Failure
{
  using Failure::Failure;
};

/// The numerics gave up: a singular factorisation, or eigenpairs that could not be completed.
struct SolverFailure : Failure
{
  explicit SolverFailure(std::string reason, std::string advice = "")
    : Failure("", std::move(reason), std::move(advice))
  {
  }
};

/// The progress callback asked to stop. Not an error.
struct Aborted : std::exception
{
  const char* what() const noexcept override { return "aborted"; }
};

} // namespace spectralwatermark

#endif
