// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkManifoldHarmonicsReconstruction
 * @brief   Geometry from its spectrum: the inverse manifold harmonics transform, with gains
 *
 * Moves every point to (paper, eq. 7)
 *
 *     x = sum_{k <= m} g_k x~_k H^k,
 *
 * the sum of the first m harmonics, each descriptor multiplied by a gain (1 unless set). With
 * KeepResidual the part of the geometry outside these harmonics is added back, so that with all
 * gains at 1 nothing moves: a gain of 2 on component 50 is the change of the paper's Figures 3
 * to 7.
 *
 * The basis is taken from the input (see vtkManifoldHarmonics) when it still fits its geometry,
 * lumped or consistent. Otherwise, if NumberOfHarmonics is set, a lumped one is computed. Output:
 * the input's cells and attributes with new points, without the basis arrays, which no longer
 * fit. Points used by no polygon stay where they are.
 *
 * Errors (vtkErrorMacro, an error code, an empty output): as for vtkManifoldHarmonics; no usable
 * basis on the input while NumberOfHarmonics is 0; a gain beyond the harmonics used.
 *
 * @sa
 * vtkManifoldHarmonics
 */
#ifndef vtkManifoldHarmonicsReconstruction_h
#define vtkManifoldHarmonicsReconstruction_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

#include <map>    // for Gains
#include <string> // for ArrayName

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkManifoldHarmonicsReconstruction
  : public vtkTriangleMeshAlgorithm
{
public:
  static vtkManifoldHarmonicsReconstruction* New();
  vtkTypeMacro(vtkManifoldHarmonicsReconstruction, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the number of harmonics m to add up. Default 0: all that the input carries.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  ///@{
  /**
   * Set/Get the factor on one component's descriptor. Components are 1-based like the paper's:
   * component 1 is the constant. Default 1 for every component; any finite number.
   */
  void SetGain(int component, double gain);
  double GetGain(int component) const;
  void RemoveAllGains();
  ///@}

  ///@{
  /**
   * Set/Get whether what lies outside the m harmonics is added back unchanged. Default off.
   */
  vtkSetMacro(KeepResidual, bool);
  vtkGetMacro(KeepResidual, bool);
  vtkBooleanMacro(KeepResidual, bool);
  ///@}

  ///@{
  /**
   * Set/Get the name of the basis array on the input. Default "ManifoldHarmonics".
   */
  void SetArrayName(const char* name);
  const char* GetArrayName() const { return this->ArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Set/Get the precision of the output points, a vtkAlgorithm::DesiredOutputPrecision. Default
   * DEFAULT_PRECISION: the input's.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  /**
   * Get how many bases the last update had to compute: 0 when the input's was used.
   */
  vtkGetMacro(NumberOfEigensolves, int);

protected:
  vtkManifoldHarmonicsReconstruction();
  ~vtkManifoldHarmonicsReconstruction() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkManifoldHarmonicsReconstruction(const vtkManifoldHarmonicsReconstruction&) = delete;
  void operator=(const vtkManifoldHarmonicsReconstruction&) = delete;

  void ResetResults() override;

  int NumberOfHarmonics = 0;
  std::map<int, double> Gains; // by 1-based component; 1 where absent
  bool KeepResidual = false;
  std::string ArrayName = "ManifoldHarmonics";
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfEigensolves = 0;
};

#endif
