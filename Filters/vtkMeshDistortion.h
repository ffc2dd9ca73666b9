// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshDistortion
 * @brief   How much a mesh was changed, vertex by vertex and on average
 *
 * Input port 0: the reference mesh. Input port 1: the distorted mesh, with the same points in the
 * same order (a marked, noised or smoothed copy).
 *
 * Output: the distorted mesh with point data (double, fractions of the reference's bounding-box
 * diagonal, 0 at points used by no polygon)
 *
 * - `GeometricDifference`: the distance to the point's original, a term of GeomDiff (paper,
 *   eq. 13);
 * - `CurvatureDifference`: the distance between geometric Laplacians (eq. 14), a term of CurvDiff
 *   (eq. 15). Neighbours are those of the reference's triangles, in both meshes.
 *
 * GetGeomDiff() and GetCurvDiff() are the means of these arrays over the points that polygons
 * use.
 *
 * Errors (vtkErrorMacro, an error code, an empty output): no points or polygons in the reference,
 * coordinates that are not finite, different numbers of points.
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
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkMeshDistortion : public vtkPolyDataAlgorithm
{
public:
  static vtkMeshDistortion* New();
  vtkTypeMacro(vtkMeshDistortion, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Get the mean distance between corresponding points (eq. 13), as a fraction of the reference's
   * bounding-box diagonal; -1 before the first update and after an error.
   */
  vtkGetMacro(GeomDiff, double);

  /**
   * Get the mean distance between geometric Laplacians (eq. 15), as a fraction of the reference's
   * bounding-box diagonal; -1 before the first update and after an error.
   */
  vtkGetMacro(CurvDiff, double);

protected:
  vtkMeshDistortion();
  ~vtkMeshDistortion() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshDistortion(const vtkMeshDistortion&) = delete;
  void operator=(const vtkMeshDistortion&) = delete;

  double GeomDiff = -1.0;
  double CurvDiff = -1.0;
};

#endif
