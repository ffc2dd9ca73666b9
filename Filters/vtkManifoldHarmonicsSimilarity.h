// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkManifoldHarmonicsSimilarity
 * @brief   How much the harmonics of two meshes have in common, component by component
 *
 * Input port 0: the reference mesh. Input port 1: the other mesh, a version of the same surface in
 * the same place (marked, noised, simplified, remeshed). Computes for every component k (paper,
 * 2.2.1, eq. 8, in absolute value, with the reference's masses)
 *
 *     similarity_k = |<G^k, H^k>| / (||G^k|| ||H^k||),   from 0 to 1,
 *
 * where H^k are the harmonics of the reference and G^k those of the other mesh. Meshes with the
 * same triangles are compared vertex by vertex; otherwise G^k is interpolated at the point of the
 * other surface that is closest to each vertex of the reference. Where eigenvalues of the
 * reference repeat (see ClusterTolerance), H^k is the space that they span: single harmonics are
 * not determined there.
 *
 * Each input's basis is taken from its arrays (see vtkManifoldHarmonics) when it still fits its
 * geometry. Otherwise, if NumberOfHarmonics is set, a lumped one is computed.
 *
 * Output port 0: the reference mesh with field data `Similarity` (double, m x 1, no unit). Output
 * port 1: a vtkTable with a row per component: `Component` (1-based), `Eigenvalue`,
 * `OtherEigenvalue` (1/length^2), `Similarity`.
 *
 * Errors (vtkErrorMacro, an error code, empty outputs): as for vtkManifoldHarmonics, for either
 * input; no usable basis on an input while NumberOfHarmonics is 0.
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
   * Set/Get how close two neighbouring eigenvalues of the reference must be, relative to their
   * size, to count as one that repeats. Default 1e-6, from 0 to 1.
   */
  vtkSetClampMacro(ClusterTolerance, double, 0.0, 1.0);
  vtkGetMacro(ClusterTolerance, double);
  ///@}

  /**
   * Get the mean similarity over all components; -1 before the first update and after an error.
   */
  vtkGetMacro(MeanSimilarity, double);

  /**
   * Get how many bases the last update computed: 0 when both inputs brought theirs.
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
