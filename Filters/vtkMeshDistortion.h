// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshDistortion
 * @brief   How much a mesh was changed: point by point, as a surface, and to the eye
 *
 * Input port 0: the reference mesh. Input port 1: the distorted mesh (a marked, noised, smoothed or
 * remeshed copy). Lengths are fractions of the diagonal of the reference's bounding box. All figures
 * are -1 before the first update, after an error, and where they could not be or were not measured.
 *
 * When both have the same points and polygons in the same order, point by point (means over the
 * points that polygons use):
 *
 * - GetGeomDiff(): distance to the point's original (paper, eq. 13); point data
 *   `GeometricDifference`;
 * - GetCurvDiff(): distance between geometric Laplacians (eqs. 14, 15), with the reference's
 *   neighbours in both meshes; point data `CurvatureDifference`;
 * - GetMSDM(): the structural distortion of Lavoue and others (2006): curvature from balls of 0.005
 *   of the longest box side, windows of 0.015, corresponding vertices.
 *
 * Between surfaces, whatever their points and polygons (ComputeSurfaceDistances):
 *
 * - GetMRMS(): root mean square of the distance to the closest point of the other surface, over the
 *   area, the larger of both directions ("maximum root mean square error": Cignoni, Rocchini and
 *   Scopigno, 1998);
 * - GetHausdorff(): the largest such distance, of both directions, at the places measured (the
 *   vertices and 50,000 or more all over each surface): at most the Hausdorff distance;
 * - point data `SurfaceDistance`: from each point of the output to the reference.
 *
 * To the eye (ComputePerceptualDistances):
 *
 * - GetMSDM2(): the multiscale measure of Lavoue (2011), the mean of both directions, from 0 (alike)
 *   towards 1; point data `LocalMSDM2`.
 *
 * The output is the distorted mesh with these point data (double; 0 at points used by no polygon), and
 * with the figures as field data: `GeomDiff`, `CurvDiff`, `MRMS`, `Hausdorff`, `MSDM`, `MSDM2`.
 *
 * Errors (vtkErrorMacro, an error code, an empty output): no points or polygons in one of the
 * meshes, coordinates that are not finite; for what is measured between surfaces, one whose
 * triangles all have no area.
 *
 * @warning
 * In the paper's tables CurvDiff is 98 to 100 % of GeomDiff in every row, which eq. 15 as printed
 * does not give: expect a few percent of GeomDiff.
 *
 * @sa
 * vtkSpectralWatermarkEmbed vtkMeshAttack
 */
#ifndef vtkMeshDistortion_h
#define vtkMeshDistortion_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkMeshDistortion : public vtkTriangleMeshAlgorithm
{
public:
  static vtkMeshDistortion* New();
  vtkTypeMacro(vtkMeshDistortion, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/get whether distances between the surfaces are measured (default on). On a million triangles
   * that takes some seconds.
   */
  vtkSetMacro(ComputeSurfaceDistances, bool);
  vtkGetMacro(ComputeSurfaceDistances, bool);
  vtkBooleanMacro(ComputeSurfaceDistances, bool);
  ///@}

  ///@{
  /**
   * Set/get whether MSDM and MSDM2 are measured (default on). They take the longest.
   */
  vtkSetMacro(ComputePerceptualDistances, bool);
  vtkGetMacro(ComputePerceptualDistances, bool);
  vtkBooleanMacro(ComputePerceptualDistances, bool);
  ///@}

  /**
   * Get the mean distance between corresponding points (eq. 13), as a fraction of the reference's
   * bounding-box diagonal; -1 when points do not correspond.
   */
  vtkGetMacro(GeomDiff, double);

  /**
   * Get the mean distance between geometric Laplacians (eq. 15), as a fraction of the reference's
   * bounding-box diagonal; -1 when points do not correspond.
   */
  vtkGetMacro(CurvDiff, double);

  /**
   * Get the larger of both root mean square distances between the surfaces, as a fraction of the
   * reference's bounding-box diagonal; -1 when not measured.
   */
  vtkGetMacro(MRMS, double);

  /**
   * Get the largest distance between the surfaces, as a fraction of the reference's bounding-box
   * diagonal; -1 when not measured.
   */
  vtkGetMacro(Hausdorff, double);

  /**
   * Get the structural distortion of 2006, 0 (alike) towards 1; -1 when not measured or when points
   * do not correspond.
   */
  vtkGetMacro(MSDM, double);

  /**
   * Get the multiscale structural distortion of 2011, 0 (alike) towards 1; -1 when not measured.
   */
  vtkGetMacro(MSDM2, double);

protected:
  vtkMeshDistortion();
  ~vtkMeshDistortion() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshDistortion(const vtkMeshDistortion&) = delete;
  void operator=(const vtkMeshDistortion&) = delete;

  struct Surfaces; // both meshes, prepared for what is asked of them
  void ResetResults() override;
  void ComparePoints(vtkPolyData* reference, vtkPolyData* distorted, vtkPolyData* output);
  void CompareSurfaces(const Surfaces& surfaces, vtkPolyData* output);
  void CompareAppearance(const Surfaces& surfaces, vtkPolyData* output);

  bool ComputeSurfaceDistances = true;
  bool ComputePerceptualDistances = true;
  double GeomDiff = -1.0;
  double CurvDiff = -1.0;
  double MRMS = -1.0;
  double Hausdorff = -1.0;
  double MSDM = -1.0;
  double MSDM2 = -1.0;
};

#endif
