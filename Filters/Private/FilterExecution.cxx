// SPDX-License-Identifier: BSD-3-Clause
#include "Private/FilterExecution.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cmath>
#include <memory>
#include <new>
#include <string>

namespace spectralwatermark
{

namespace
{

// Observers can be slow (a window, a terminal): they hear of every half percent.
constexpr double ProgressStep = 0.005;

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
    throw InvalidInput("this filter needs the whole mesh at once and was asked for one of several "
                       "pieces: gather the mesh on one rank first");
  }
}

} // namespace

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
      return !filter->GetAbortExecute();
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
    throw InvalidInput(std::string(property) + " must be finite");
  }
}

int RunFilter(vtkAlgorithm* filter, unsigned long& errorCode, vtkInformationVector* outputs,
  const std::function<void()>& recipe)
{
  const auto fail = [&](unsigned long code, const char* what)
  {
    errorCode = code;
    EmptyOutputs(outputs);
    vtkErrorWithObjectMacro(filter, << what);
    return 0;
  };
  errorCode = vtkErrorCode::NoError;
  try
  {
    CheckPieces(outputs);
    recipe();
    return 1;
  }
  catch (const Aborted&)
  {
    EmptyOutputs(outputs);
    return 1;
  }
  catch (const InvalidInput& error)
  {
    return fail(vtkErrorCode::UserError, error.what());
  }
  catch (const std::bad_alloc&)
  {
    return fail(vtkErrorCode::UnknownError,
      "not enough memory: close other programs, or simplify the mesh first");
  }
  catch (const std::exception& error)
  {
    return fail(vtkErrorCode::UnknownError, error.what());
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
      if (to.Outer->GetAbortExecute())
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
  if (outer->GetAbortExecute())
  {
    throw Aborted();
  }
}

} // namespace spectralwatermark
