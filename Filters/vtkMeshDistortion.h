// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshDistortion
 * @brief   Measures how a mesh was changed: point by point, as a surface, and to the eye
 *
 * Input port 0 is the reference mesh. Input port 1 is the distorted mesh (a marked, noised,
 * smoothed or remeshed copy). Lengths are fractions of the diagonal of the reference's bounding
 * box. A figure is -1 before the first update, after an error, and if it was not or could not be
 * measured.
 *
 * Point by point, if both meshes have the same points and polygons in the same order (means are
 * over the points that polygons use):
 *
 * - GetGeomDiff(): the mean distance between corresponding points (paper, eq. 13), with point data
 *   `GeometricDifference`.
 * - GetCurvDiff(): the mean distance between their geometric Laplacians (eqs. 14 and 15), with the
 *   reference's neighbours in both meshes; point data `CurvatureDifference`.
 * - GetMSDM(): the structural distortion of Lavoue and others (2006) between corresponding
 *   vertices. With the longest side of the bounding box as unit, its curvatures are from balls of
 *   radius 0.005 and its windows have a radius of 0.015.
 *
 * Between the surfaces, whatever their points and polygons (ComputeSurfaceDistances):
 *
 * - GetMRMS(): the root mean square distance to the closest point of the other surface, over the
 *   area; the larger of both directions ("maximum root mean square error": Cignoni, Rocchini and
 *   Scopigno, 1998).
 * - GetHausdorff(): the largest such distance in either direction at the places measured, which are
 *   the vertices and 50,000 or more points all over each surface. It is at most the Hausdorff
 *   distance.
 * - Point data `SurfaceDistance`: the distance of each point of the output from the reference.
 *
 * To the eye (ComputePerceptualDistances):
 *
 * - GetMSDM2(): the multiscale measure of Lavoue (2011), the mean of both directions, from 0
 *   (identical) towards 1, with point data `LocalMSDM2`.
 *
 * The output is the distorted mesh with these point data (double; 0 at points used by no polygon)
 * and with the figures as field data: `GeomDiff`, `CurvDiff`, `MRMS`, `Hausdorff`, `MSDM`, `MSDM2`.
 *
 * It is an error (vtkErrorMacro, an error code, an empty output) if one of the meshes has no
 * points, no polygons, or coordinates that are not finite; and, for the measures between surfaces,
 * if no triangle of one mesh has an area.
 *
 * @warning
 * In the paper's tables CurvDiff is 98 to 100 % of GeomDiff in every row. Eq. 15 as printed does
 * not give that: expect a few percent of GeomDiff.
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
   * Set/Get whether the distances between the surfaces are measured. Default on. A million
   * triangles take some seconds.
   */
  vtkSetMacro(ComputeSurfaceDistances, bool);
  vtkGetMacro(ComputeSurfaceDistances, bool);
  vtkBooleanMacro(ComputeSurfaceDistances, bool);
  ///@}

  ///@{
  /**
   * Set/Get whether MSDM and MSDM2 are measured. Default on. They take the longest.
   */
  vtkSetMacro(ComputePerceptualDistances, bool);
  vtkGetMacro(ComputePerceptualDistances, bool);
  vtkBooleanMacro(ComputePerceptualDistances, bool);
  ///@}

  /**
   * Get the mean distance between corresponding points (eq. 13), as a fraction of the reference's
   * bounding-box diagonal; -1 if points do not correspond.
   */
  vtkGetMacro(GeomDiff, double);

  /**
   * Get the mean distance between geometric Laplacians (eq. 15), as a fraction of the reference's
   * bounding-box diagonal; -1 if points do not correspond.
   */
  vtkGetMacro(CurvDiff, double);

  /**
   * Get the larger of both root mean square distances between the surfaces, as a fraction of the
   * reference's bounding-box diagonal; -1 if not measured.
   */
  vtkGetMacro(MRMS, double);

  /**
   * Get the largest distance between the surfaces, as a fraction of the reference's bounding-box
   * diagonal; -1 if not measured.
   */
  vtkGetMacro(Hausdorff, double);

  /**
   * Get the structural distortion MSDM (Lavoue and others, 2006), from 0 (identical) towards 1; -1
   * if not measured or if points do not correspond.
   */
  vtkGetMacro(MSDM, double);

  /**
   * Get the multiscale structural distortion MSDM2 (Lavoue, 2011), from 0 (identical) towards 1; -1
   * if not measured.
   */
  vtkGetMacro(MSDM2, double);

protected:
  vtkMeshDistortion();
  ~vtkMeshDistortion() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshDistortion(const vtkMeshDistortion&) = delete;
  void operator=(const vtkMeshDistortion&) = delete;

  // Both meshes, prepared for the measures that are switched on.
  struct Surfaces;
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
