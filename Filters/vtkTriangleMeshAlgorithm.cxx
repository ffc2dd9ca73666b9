// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTriangleMeshAlgorithm.h"

#include "Core/Support/Errors.h"
#include "Private/FilterExecution.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>

#include <new>

namespace sw = spectralwatermark;

vtkTriangleMeshAlgorithm::vtkTriangleMeshAlgorithm() = default;
vtkTriangleMeshAlgorithm::~vtkTriangleMeshAlgorithm() = default;

int vtkTriangleMeshAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillOutputPortInformation(port, info);
  }
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
  return 1;
}

namespace
{

// Where Core's options have other names than the filters' properties.
std::string PropertyOf(const std::string& parameter)
{
  return parameter == "Count" ? "NumberOfHarmonics" : parameter;
}

} // namespace

int vtkTriangleMeshAlgorithm::Fail(unsigned long code, const sw::Failure& failure)
{
  this->ErrorCode = code;
  this->ErrorParameter = PropertyOf(failure.Parameter);
  this->ErrorReason = failure.Reason;
  this->ErrorAdvice = failure.Advice;
  vtkErrorMacro(<< sw::Failure::TextOf(this->ErrorParameter, this->ErrorReason, this->ErrorAdvice));
  return 0;
}

int vtkTriangleMeshAlgorithm::Run(vtkInformationVector* outputs, const std::function<void()>& body)
{
  const auto clear = [&]()
  {
    this->ResetResults();
    sw::EmptyOutputs(outputs);
  };
  this->ErrorCode = vtkErrorCode::NoError;
  this->ErrorParameter.clear();
  this->ErrorReason.clear();
  this->ErrorAdvice.clear();
  this->ResetResults();
  try
  {
    sw::CheckPieces(outputs);
    body();
    sw::ResetAbort(this);
    return 1;
  }
  catch (const sw::Aborted&)
  {
    clear();
    sw::ResetAbort(this);
    return 1;
  }
  catch (const sw::InvalidInput& error)
  {
    clear();
    return this->Fail(vtkErrorCode::UserError, error);
  }
  catch (const sw::SolverFailure& error)
  {
    clear();
    return this->Fail(vtkErrorCode::UnknownError, error);
  }
  catch (const std::bad_alloc&)
  {
    clear();
    return this->Fail(vtkErrorCode::UnknownError,
      sw::SolverFailure("not enough memory", "close other programs, or simplify the mesh first"));
  }
  catch (const std::exception& error)
  {
    clear();
    return this->Fail(vtkErrorCode::UnknownError, sw::SolverFailure(error.what()));
  }
}

void vtkTriangleMeshAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorParameter: " << this->ErrorParameter << "\n";
  os << indent << "ErrorReason: " << this->ErrorReason << "\n";
  os << indent << "ErrorAdvice: " << this->ErrorAdvice << "\n";
}
