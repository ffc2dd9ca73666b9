// SPDX-License-Identifier: BSD-3-Clause
/// Progress, abort and checks that the filters' RequestData share.
#ifndef SpectralWatermark_Private_FilterExecution_h
#define SpectralWatermark_Private_FilterExecution_h

#include "Core/Support/Progress.h"

class vtkAlgorithm;
class vtkInformationVector;

namespace spectralwatermark
{

/// Core progress that becomes the filter's progress events, and stops when the filter is aborted.
Progress ProgressOf(vtkAlgorithm* filter);

/// How many threads VTK's own filters would use (vtkSMPTools).
int ThreadsOfVtk();

/// Throws InvalidInput for a value that is not finite: VTK's clamping lets those pass.
void CheckFinite(const char* property, double value);

/// Empties the data objects of all output ports.
void EmptyOutputs(vtkInformationVector* outputs);

/// Throws InvalidInput when one of several pieces was requested: the filters need the whole mesh.
void CheckPieces(vtkInformationVector* outputs);

/// Runs a VTK filter inside ours: its progress becomes the range [begin, end] of ours, and an abort of ours
/// stops it (and throws Aborted). Its error events stay inside: the caller examines its output and reports
/// what an error means for ours.
void RunInternalFilter(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end);

} // namespace spectralwatermark

#endif
