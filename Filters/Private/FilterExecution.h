// SPDX-License-Identifier: BSD-3-Clause
/// What every filter's RequestData does around its own recipe.
#ifndef SpectralWatermark_Private_FilterExecution_h
#define SpectralWatermark_Private_FilterExecution_h

#include "Core/Support/Progress.h"

#include <functional>

class vtkAlgorithm;
class vtkInformationVector;

namespace spectralwatermark
{

/// Core progress that becomes the filter's progress events, and stops when AbortExecute is set.
Progress ProgressOf(vtkAlgorithm* filter);

/// How many threads VTK's own filters would use (vtkSMPTools).
int ThreadsOfVtk();

/// Throws InvalidInput for a value that is not finite: VTK's clamping lets those pass.
void CheckFinite(const char* property, double value);

/// Runs `recipe` and turns what it throws into VTK's terms; the return value is RequestData's.
///
/// - An error: vtkErrorMacro with its text, every output emptied, `errorCode` set to
///   vtkErrorCode::UserError (bad input: the user can mend it) or vtkErrorCode::UnknownError (the
///   solver failed or memory ran out); returns 0.
/// - An abort: every output emptied, no error; returns 1.
/// - Several pieces asked for (parallel runs): an error, since the harmonics are global.
int RunFilter(vtkAlgorithm* filter, unsigned long& errorCode, vtkInformationVector* outputs,
  const std::function<void()>& recipe);

/// Runs a VTK filter inside ours: its progress becomes the range [begin, end] of ours, and an
/// abort of ours stops it (and throws Aborted). What it says of errors stays inside: its caller looks at
/// its output, and says what they mean for ours.
void RunInternalFilter(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end);

} // namespace spectralwatermark

#endif
