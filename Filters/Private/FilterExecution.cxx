// SPDX-License-Identifier: BSD-3-Clause
#include "Private/FilterExecution.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkVersionMacros.h>

#include <cmath>
#include <memory>

namespace spectralwatermark
{

namespace
{

// The progress from one event to the next. Observers can be slow (a window, a terminal).
constexpr double ProgressStep = 0.005;

// VTK 9.3, and the VTK of ParaView 5.11 before it, leave aborts to the caller: CheckAbort() also
// asks upstream, and executions no longer reset AbortExecute.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
#define CALLER_RESETS_ABORT
#endif

bool MustStop(vtkAlgorithm* filter)
{
#ifdef CALLER_RESETS_ABORT
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}

} // namespace

void ResetAbort(vtkAlgorithm* filter)
{
#ifdef CALLER_RESETS_ABORT
  filter->SetAbortExecute(0);
#else
  static_cast<void>(filter); // its executive did
#endif
}

void EmptyOutputs(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* output = vtkDataObject::GetData(outputs, port))
    {
      output->Initialize();
    }
  }
}

void CheckPieces(vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const auto* key = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  if (info != nullptr && info->Has(const_cast<vtkInformationIntegerKey*>(key)) &&
    info->Get(const_cast<vtkInformationIntegerKey*>(key)) > 1)
  {
    throw InvalidInput("",
      "this filter needs the whole mesh at once and was asked for one of several pieces",
      "gather the mesh on one rank first");
  }
}

Progress ProgressOf(vtkAlgorithm* filter)
{
  const auto reported = std::make_shared<double>(-1.0);
  return Progress(
    [filter, reported](double fraction)
    {
      if (fraction >= *reported + ProgressStep)
      {
        *reported = fraction;
        filter->UpdateProgress(fraction);
      }
      return !MustStop(filter);
    });
}

int ThreadsOfVtk()
{
  return vtkSMPTools::GetEstimatedNumberOfThreads();
}

void CheckFinite(const char* property, double value)
{
  if (!std::isfinite(value))
  {
    throw InvalidInput(property, "the value is not finite", "give a finite number");
  }
}

void RunInternalFilter(vtkAlgorithm* inner, vtkAlgorithm* outer, double begin, double end)
{
  struct Forwarding
  {
    vtkAlgorithm* Outer;
    double Begin;
    double End;
  } forwarding{ outer, begin, end };
  vtkNew<vtkCallbackCommand> forward;
  forward->SetClientData(&forwarding);
  forward->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      const auto& to = *static_cast<Forwarding*>(data);
      auto* from = static_cast<vtkAlgorithm*>(caller);
      to.Outer->UpdateProgress(to.Begin + from->GetProgress() * (to.End - to.Begin));
      if (MustStop(to.Outer))
      {
        from->SetAbortExecute(1);
      }
    });
  const unsigned long tag = inner->AddObserver(vtkCommand::ProgressEvent, forward);
  vtkNew<vtkCallbackCommand> ignore;
  inner->AddObserver(vtkCommand::ErrorEvent, ignore);
  inner->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ignore);
  inner->Update();
  inner->RemoveObserver(tag);
  if (MustStop(outer))
  {
    throw Aborted();
  }
}

} // namespace spectralwatermark
