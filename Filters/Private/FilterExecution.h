// SPDX-License-Identifier: BSD-3-Clause
/// Progress, aborts and checks that all filters share in their RequestData.
#ifndef SpectralWatermark_Private_FilterExecution_h
#define SpectralWatermark_Private_FilterExecution_h

#include "Core/Support/Progress.h"

class vtkAlgorithm;
class vtkInformationVector;

namespace spectralwatermark
{

/// A Progress that invokes the filter's progress events, and throws Aborted when the filter is
/// aborted.
Progress ProgressOf(vtkAlgorithm* filter);

/// The number of threads that VTK's own filters would use (vtkSMPTools).
int ThreadsOfVtk();

/// Throws InvalidInput if the value is not finite, because VTK's clamping lets such values pass.
void CheckFinite(const char* property, double value);

/// Resets AbortExecute at the start of an execution, as VTK before 9.3 does by itself: an observer
/// of the last progress event can set it when an execution is over.
void ResetAbort(vtkAlgorithm* filter);

/// Empties the data objects of all output ports.
void EmptyOutputs(vtkInformationVector* outputs);

/// Throws InvalidInput if one of several pieces was requested, because the filters need the whole
/// mesh.
void CheckPieces(vtkInformationVector* outputs);

/// Runs a VTK filter as a step of ours. Its progress becomes the range [begin, end] of ours, and an
/// abort of ours stops it and throws Aborted. Its error events are not passed on: the caller
/// examines its output and reports what an error means for our filter.
void RunInternalFilter(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end);

} // namespace spectralwatermark

#endif
