// SPDX-License-Identifier: BSD-3-Clause
/// Adds the results of a filter to the field data of an output, where applications that cannot call
/// getters (ParaView's Information panel and spreadsheets) find them.
#ifndef SpectralWatermark_Private_Results_h
#define SpectralWatermark_Private_Results_h

#include <initializer_list>
#include <string>
#include <utility>

class vtkDataObject;

namespace spectralwatermark
{

/// Adds an array of one value for each figure.
void AddResults(vtkDataObject* output,
  std::initializer_list<std::pair<const char*, double>> figures);

/// Adds an array of one string.
void AddResult(vtkDataObject* output, const char* name, const std::string& text);

} // namespace spectralwatermark

#endif
