// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshAttack
 * @brief   What people and software do to a mesh, to see whether a mark survives it
 *
 * | Attack            | what it does                                    | parameters          |
 * |-------------------|-------------------------------------------------|---------------------|
 * | Rotation          | turns the mesh about an axis through the origin | RotationAxis, RotationAngle |
 * | UniformScaling    | multiplies all coordinates                      | ScaleFactor         |
 * | Translation       | adds a vector                                   | TranslationVector   |
 * | NoiseAlongNormals | v + s N(0, 1) e n(v) (paper, 3.3.3)             | NoiseFactor, Seed   |
 * | SpectralSmoothing | damps high harmonics (paper, 3.3.4)             | NumberOfHarmonics, CutoffComponent, SmoothingGain, KeepResidual |
 * | Simplification    | quadric edge collapse (vtkQuadricDecimation)    | SimplificationPercent |
 *
 * Deterministic: the same input and parameters give the same output, whatever the number of
 * threads. Noise depends on (Seed, vertex) alone.
 *
 * All attacks but Simplification keep cells, attributes and unused points, and move points only;
 * normals and vectors turn with a rotation. Points at the same place stay together.
 * Simplification returns the triangles that are left and no attributes, since they belong to
 * points and cells that are gone. Arrays of a basis (vtkManifoldHarmonics) are dropped.
 *
 * Errors (vtkErrorMacro, an error code, an empty output): as for vtkManifoldHarmonics; an unknown
 * attack; an axis of length 0; parameters that are not finite; more harmonics than vertices.
 *
 * @sa
 * vtkSpectralWatermarkDetect vtkMeshDistortion
 */
#ifndef vtkMeshAttack_h
#define vtkMeshAttack_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkMeshAttack : public vtkPolyDataAlgorithm
{
public:
  static vtkMeshAttack* New();
  vtkTypeMacro(vtkMeshAttack, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Attacks. The numbers are stable; those left out are for attacks of later versions.
   */
  enum AttackType
  {
    Rotation = 0,
    UniformScaling = 1,
    Translation = 2,
    NoiseAlongNormals = 4,
    SpectralSmoothing = 6,
    Simplification = 9
  };

  ///@{
  /**
   * Set/Get the attack. Default NoiseAlongNormals. An unknown number is an error when the filter
   * runs.
   */
  vtkSetMacro(Attack, int);
  vtkGetMacro(Attack, int);
  void SetAttackToRotation() { this->SetAttack(Rotation); }
  void SetAttackToUniformScaling() { this->SetAttack(UniformScaling); }
  void SetAttackToTranslation() { this->SetAttack(Translation); }
  void SetAttackToNoiseAlongNormals() { this->SetAttack(NoiseAlongNormals); }
  void SetAttackToSpectralSmoothing() { this->SetAttack(SpectralSmoothing); }
  void SetAttackToSimplification() { this->SetAttack(Simplification); }
  const char* GetAttackAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the seed of random attacks. Default 0, any integer.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Set/Get the axis of Rotation. Default (0, 0, 1); any length but 0.
   */
  vtkSetVector3Macro(RotationAxis, double);
  vtkGetVector3Macro(RotationAxis, double);
  ///@}

  ///@{
  /**
   * Set/Get the angle of Rotation, in degrees. Default 30.
   */
  vtkSetMacro(RotationAngle, double);
  vtkGetMacro(RotationAngle, double);
  ///@}

  ///@{
  /**
   * Set/Get the factor of UniformScaling. Default 2, positive.
   */
  vtkSetClampMacro(ScaleFactor, double, VTK_DBL_MIN, VTK_DOUBLE_MAX);
  vtkGetMacro(ScaleFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get the vector of Translation, in the model's units. Default (1, 0, 0).
   */
  vtkSetVector3Macro(TranslationVector, double);
  vtkGetVector3Macro(TranslationVector, double);
  ///@}

  ///@{
  /**
   * Set/Get the paper's s_noise for NoiseAlongNormals: the standard deviation of the displacement
   * in mean edge lengths. Default 0.5, at least 0. Normals are weighted by area.
   */
  vtkSetClampMacro(NoiseFactor, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NoiseFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get m for SpectralSmoothing: the harmonics that the smoothed mesh is made of. Default
   * 300 (the paper does not give its m), at least 1.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  ///@{
  /**
   * Set/Get the last component that SpectralSmoothing leaves alone, 1-based. Default 200, as in
   * the paper; at least 1.
   */
  vtkSetClampMacro(CutoffComponent, int, 1, VTK_INT_MAX);
  vtkGetMacro(CutoffComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the factor on the components after CutoffComponent. Default 0.5, as in the paper.
   */
  vtkSetMacro(SmoothingGain, double);
  vtkGetMacro(SmoothingGain, double);
  ///@}

  ///@{
  /**
   * Set/Get whether SpectralSmoothing keeps what lies outside its m harmonics. Default off: it is
   * dropped, as in the paper's formula, which smooths far more than the gain does.
   */
  vtkSetMacro(KeepResidual, bool);
  vtkGetMacro(KeepResidual, bool);
  vtkBooleanMacro(KeepResidual, bool);
  ///@}

  ///@{
  /**
   * Set/Get how much Simplification removes, in percent of the edges (on a closed mesh the same
   * percentage of triangles and, nearly, of vertices). Default 50, from 0 to 99.9.
   */
  vtkSetClampMacro(SimplificationPercent, double, 0.0, 99.9);
  vtkGetMacro(SimplificationPercent, double);
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
   * Get how many bases the last update computed: 0 unless SpectralSmoothing found none on its
   * input.
   */
  vtkGetMacro(NumberOfEigensolves, int);

protected:
  vtkMeshAttack();
  ~vtkMeshAttack() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkMeshAttack(const vtkMeshAttack&) = delete;
  void operator=(const vtkMeshAttack&) = delete;

  void Transform(vtkPolyData* input, vtkPolyData* output);
  void AddNoise(vtkPolyData* input, vtkPolyData* output);
  void Smooth(vtkPolyData* input, vtkPolyData* output);
  void Simplify(vtkPolyData* input, vtkPolyData* output);

  int Attack = NoiseAlongNormals;
  int Seed = 0;
  double RotationAxis[3] = { 0.0, 0.0, 1.0 };
  double RotationAngle = 30.0;
  double ScaleFactor = 2.0;
  double TranslationVector[3] = { 1.0, 0.0, 0.0 };
  double NoiseFactor = 0.5;
  int NumberOfHarmonics = 300;
  int CutoffComponent = 200;
  double SmoothingGain = 0.5;
  bool KeepResidual = false;
  double SimplificationPercent = 50.0;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfEigensolves = 0;
};

#endif
