// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkManifoldHarmonicsSimilarity
 * @brief   Measures the similarity of the harmonics of two meshes, component by component
 *
 * Input port 0 is the reference mesh. Input port 1 is the other mesh, a version of the same surface
 * in the same place (marked, noised, simplified, remeshed). For every component k the filter
 * computes (paper, 2.2.1, eq. 8, in absolute value, with the masses of the reference)
 *
 *     similarity_k = |<G^k, H^k>| / (||G^k|| ||H^k||),   from 0 to 1,
 *
 * where H^k are the harmonics of the reference and G^k those of the other mesh. Meshes with the
 * same triangles are compared vertex by vertex. Otherwise G^k is interpolated at the point of the
 * other surface that is closest to each vertex of the reference. Where eigenvalues of the reference
 * repeat (see ClusterTolerance), single harmonics are not determined, and G^k is compared with the
 * space that the harmonics span.
 *
 * The filter uses the basis of each input (see vtkManifoldHarmonics) if it still fits the geometry.
 * Otherwise, if NumberOfHarmonics is set, it computes a lumped one.
 *
 * Output port 0 is the reference mesh with the field data `Similarity` (double, m x 1, no unit).
 * Output port 1 is a vtkTable with a row per component: `Component` (1-based), `Eigenvalue` and
 * `OtherEigenvalue` (1/length^2), `Similarity`.
 *
 * The errors (vtkErrorMacro, an error code, empty outputs) are those of vtkManifoldHarmonics, for
 * either input. It is also an error if an input has no usable basis while NumberOfHarmonics is 0.
 *
 * @sa
 * vtkManifoldHarmonics vtkMeshDistortion
 */
#ifndef vtkManifoldHarmonicsSimilarity_h
#define vtkManifoldHarmonicsSimilarity_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkManifoldHarmonicsSimilarity
  : public vtkTriangleMeshAlgorithm
{
public:
  static vtkManifoldHarmonicsSimilarity* New();
  vtkTypeMacro(vtkManifoldHarmonicsSimilarity, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the number of harmonics m to compare. Default 0: all that both inputs carry.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  ///@{
  /**
   * Set/Get the relative difference of two neighbouring eigenvalues of the reference up to which
   * they count as one that repeats. Default 1e-6, from 0 to 1.
   */
  vtkSetClampMacro(ClusterTolerance, double, 0.0, 1.0);
  vtkGetMacro(ClusterTolerance, double);
  ///@}

  /**
   * Get the mean similarity over all components, from 0 to 1; -1 before the first update and after
   * an error.
   */
  vtkGetMacro(MeanSimilarity, double);

  /**
   * Get the number of bases that the last update computed: 0 if it used those of both inputs.
   */
  vtkGetMacro(NumberOfEigensolves, int);

protected:
  vtkManifoldHarmonicsSimilarity();
  ~vtkManifoldHarmonicsSimilarity() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkManifoldHarmonicsSimilarity(const vtkManifoldHarmonicsSimilarity&) = delete;
  void operator=(const vtkManifoldHarmonicsSimilarity&) = delete;

  void ResetResults() override;

  int NumberOfHarmonics = 0;
  double ClusterTolerance = 1e-6;
  double MeanSimilarity = -1.0;
  int NumberOfEigensolves = 0;
};

#endif
