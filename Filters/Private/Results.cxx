// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Results.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

namespace spectralwatermark
{

void AddResults(vtkDataObject* output,
  std::initializer_list<std::pair<const char*, double>> figures)
{
  for (const auto& [name, value] : figures)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    output->GetFieldData()->AddArray(array);
  }
}

void AddResult(vtkDataObject* output, const char* name, const std::string& text)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(text);
  output->GetFieldData()->AddArray(array);
}

} // namespace spectralwatermark
