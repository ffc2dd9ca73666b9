// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkManifoldHarmonicsReconstruction
 * @brief   Reconstructs a mesh from its spectrum, with gains (inverse manifold harmonics transform)
 *
 * Moves every point to (paper, eq. 7)
 *
 *     x = sum_{k <= m} g_k x~_k H^k,
 *
 * the sum of the first m harmonics, where each descriptor is multiplied by a gain g_k (1 by
 * default). With KeepResidual, the part of the geometry outside these harmonics is added back, so
 * that nothing moves while all gains are 1. For example, a gain of 2 on component 50 is the change
 * that the paper's Figures 3 to 7 show.
 *
 * The filter uses the basis of its input (see vtkManifoldHarmonics), lumped or consistent, if it
 * still fits the geometry. Otherwise, if NumberOfHarmonics is set, it computes a lumped one. The
 * output has the input's cells and attributes and new points. The arrays of the basis are removed,
 * because they no longer fit. Points used by no polygon stay where they are.
 *
 * The errors (vtkErrorMacro, an error code, an empty output) are those of vtkManifoldHarmonics. It
 * is also an error if the input has no usable basis while NumberOfHarmonics is 0, or if a gain is
 * set for a component beyond the harmonics used.
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
   * Set/Get the number of harmonics m to sum. Default 0: all that the input carries.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  ///@{
  /**
   * Set/Get the gain of one component, a factor on its descriptor. Components are 1-based like the
   * paper's; component 1 is the constant harmonic. Default 1 for every component; any finite
   * number.
   */
  void SetGain(int component, double gain);
  double GetGain(int component) const;
  void RemoveAllGains();
  ///@}

  ///@{
  /**
   * Set/Get whether the part of the geometry outside the m harmonics is added back unchanged.
   * Default off.
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
   * Get the number of bases that the last update computed: 0 if it used the input's.
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
