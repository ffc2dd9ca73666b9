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
 * | Similarity        | a random rotation, scale and translation        | Seed                |
 * | NoiseAlongNormals | v + s N(0, 1) e n(v) (paper, 3.3.3)             | NoiseFactor, Seed   |
 * | NoiseUniform      | every coordinate + U[-1, 1] a (benchmark)       | NoisePercent, Seed  |
 * | SpectralSmoothing | damps high harmonics (paper, 3.3.4)             | NumberOfHarmonics, CutoffComponent, SmoothingGain, KeepResidual |
 * | LaplacianSmoothing | v + f (mean of neighbours - v) (benchmark)     | SmoothingFactor, SmoothingIterations |
 * | Quantization      | rounds coordinates (benchmark)                  | QuantizationBits    |
 * | Simplification    | quadric edge collapse (vtkQuadricDecimation)    | SimplificationPercent |
 * | Subdivision       | more triangles                                  | SubdivisionType, NumberOfSubdivisions |
 * | VertexReordering  | shuffles points and polygons                    | Seed                |
 * | Cropping          | cuts a part off, by a plane                     | CroppingPercent, Seed |
 * | Remeshing         | other triangles on the same surface             | RemeshingMethod, RemeshingPercent, IsosurfaceResolution |
 * | NonUniformScaling | multiplies each coordinate by a factor          | AxisScaleFactors    |
 *
 * "Benchmark": K. Wang, G. Lavoue, F. Denis, A. Baskurt, X. He, "A Benchmark for 3-D Mesh
 * Watermarking" (2010); its unit of length is the mean distance of the vertices to their centre.
 *
 * Deterministic: the same input and parameters give the same output, whatever the number of
 * threads. Noise depends on (Seed, vertex) alone.
 *
 * Most attacks keep cells, attributes and unused points, and move points only; normals and vectors
 * turn with a rotation. Points at the same place stay together. VertexReordering and Cropping keep
 * the attributes of what is there. Simplification, Subdivision and Remeshing return triangles and
 * no attributes, since those belong to points and cells that are gone. Arrays of a basis
 * (vtkManifoldHarmonics) are dropped.
 *
 * Errors (vtkErrorMacro, an error code, an empty output): as for vtkManifoldHarmonics; an unknown
 * attack or method; an axis of length 0; parameters that are not finite; more harmonics than
 * vertices; an isosurface of a surface that is not closed; a surface that Loop's rule cannot
 * divide; an attack that leaves no triangle, or makes more of them than memory holds.
 *
 * @sa
 * vtkSpectralWatermarkDetect vtkMeshDistortion
 */
#ifndef vtkMeshAttack_h
#define vtkMeshAttack_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkMeshAttack : public vtkTriangleMeshAlgorithm
{
public:
  static vtkMeshAttack* New();
  vtkTypeMacro(vtkMeshAttack, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Attacks. The numbers are stable.
   */
  enum AttackType
  {
    Rotation = 0,
    UniformScaling = 1,
    Translation = 2,
    Similarity = 3,
    NoiseAlongNormals = 4,
    NoiseUniform = 5,
    SpectralSmoothing = 6,
    LaplacianSmoothing = 7,
    Quantization = 8,
    Simplification = 9,
    Subdivision = 10,
    VertexReordering = 11,
    Cropping = 12,
    Remeshing = 13,
    NonUniformScaling = 14
  };

  /**
   * Rules for Subdivision.
   */
  enum SubdivisionTypes
  {
    Midpoint = 0, ///< four triangles for each, in its plane
    Loop = 1,     ///< Loop's, which smooths
    Sqrt3 = 2     ///< Kobbelt's √3, which smooths: three triangles for each
  };

  /**
   * Ways of Remeshing.
   */
  enum RemeshingMethods
  {
    Uniform = 0,   ///< vertices about equally far apart (vtkQuadricClustering)
    Isosurface = 1 ///< the zero level of the signed distance, sampled on a grid
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
  void SetAttackToSimilarity() { this->SetAttack(Similarity); }
  void SetAttackToNoiseUniform() { this->SetAttack(NoiseUniform); }
  void SetAttackToLaplacianSmoothing() { this->SetAttack(LaplacianSmoothing); }
  void SetAttackToQuantization() { this->SetAttack(Quantization); }
  void SetAttackToSubdivision() { this->SetAttack(Subdivision); }
  void SetAttackToVertexReordering() { this->SetAttack(VertexReordering); }
  void SetAttackToCropping() { this->SetAttack(Cropping); }
  void SetAttackToRemeshing() { this->SetAttack(Remeshing); }
  void SetAttackToNonUniformScaling() { this->SetAttack(NonUniformScaling); }
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
   * Set/Get a of NoiseUniform, in percent of the mean distance of the vertices to their centre.
   * Default 0.3, at least 0.
   */
  vtkSetClampMacro(NoisePercent, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NoisePercent, double);
  ///@}

  ///@{
  /**
   * Set/Get f of LaplacianSmoothing. Default 0.1, as in the benchmark; from 0 to 1.
   */
  vtkSetClampMacro(SmoothingFactor, double, 0.0, 1.0);
  vtkGetMacro(SmoothingFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get how often LaplacianSmoothing moves all vertices. Those on boundaries stay. Default 10,
   * at least 0.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /**
   * Set/Get R of Quantization: each axis has 2^R levels, evenly from one side of the bounding box to
   * the other. Default 9, from 1 to 30.
   */
  vtkSetClampMacro(QuantizationBits, int, 1, 30);
  vtkGetMacro(QuantizationBits, int);
  ///@}

  ///@{
  /**
   * Set/Get the rule of Subdivision, a SubdivisionTypes. Default Midpoint.
   */
  vtkSetMacro(SubdivisionType, int);
  vtkGetMacro(SubdivisionType, int);
  void SetSubdivisionTypeToMidpoint() { this->SetSubdivisionType(Midpoint); }
  void SetSubdivisionTypeToLoop() { this->SetSubdivisionType(Loop); }
  void SetSubdivisionTypeToSqrt3() { this->SetSubdivisionType(Sqrt3); }
  const char* GetSubdivisionTypeAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get how often Subdivision divides. Default 1, from 1 to 6.
   */
  vtkSetClampMacro(NumberOfSubdivisions, int, 1, 6);
  vtkGetMacro(NumberOfSubdivisions, int);
  ///@}

  ///@{
  /**
   * Set/Get how many percent of the points Cropping cuts off, by a plane in a random direction.
   * Default 10, from 0 to 99.
   */
  vtkSetClampMacro(CroppingPercent, double, 0.0, 99.0);
  vtkGetMacro(CroppingPercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the way of Remeshing, a RemeshingMethods. Default Uniform.
   */
  vtkSetMacro(RemeshingMethod, int);
  vtkGetMacro(RemeshingMethod, int);
  void SetRemeshingMethodToUniform() { this->SetRemeshingMethod(Uniform); }
  void SetRemeshingMethodToIsosurface() { this->SetRemeshingMethod(Isosurface); }
  const char* GetRemeshingMethodAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get how many vertices the uniform Remeshing makes, about, in percent of those there are.
   * Default 100, from 0.1 to 1000. Triangles are split to half a cell of a grid over the bounding
   * box, and gathered in its cells; both take memory: an error where there is not enough, and for a
   * mesh that is very thin for its box, or of triangles thousands of times as long as wide.
   */
  vtkSetClampMacro(RemeshingPercent, double, 0.1, 1000.0);
  vtkGetMacro(RemeshingPercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the steps of the isosurface's grid along the longest side of the bounding box. Default
   * 256, from 8 to 1024.
   */
  vtkSetClampMacro(IsosurfaceResolution, int, 8, 1024);
  vtkGetMacro(IsosurfaceResolution, int);
  ///@}

  ///@{
  /**
   * Set/Get the factors of NonUniformScaling for x, y and z. Default (1, 1, 1.1); any but 0.
   */
  vtkSetVector3Macro(AxisScaleFactors, double);
  vtkGetVector3Macro(AxisScaleFactors, double);
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

  void ResetResults() override;

  // One entry for each attack: its number, its name and what applies it.
  struct Entry
  {
    int Type;
    const char* Name;
    void (vtkMeshAttack::*Apply)(vtkPolyData* input, vtkPolyData* output);
  };
  static const Entry* Find(int attack);

  void Rotate(vtkPolyData* input, vtkPolyData* output);
  void ScaleUniformly(vtkPolyData* input, vtkPolyData* output);
  void Translate(vtkPolyData* input, vtkPolyData* output);
  void TransformAtRandom(vtkPolyData* input, vtkPolyData* output);
  void AddNoiseAlongNormals(vtkPolyData* input, vtkPolyData* output);
  void AddUniformNoise(vtkPolyData* input, vtkPolyData* output);
  void SmoothSpectrally(vtkPolyData* input, vtkPolyData* output);
  void SmoothByUmbrella(vtkPolyData* input, vtkPolyData* output);
  void Quantize(vtkPolyData* input, vtkPolyData* output);
  void Simplify(vtkPolyData* input, vtkPolyData* output);
  void Subdivide(vtkPolyData* input, vtkPolyData* output);
  void Shuffle(vtkPolyData* input, vtkPolyData* output);
  void Crop(vtkPolyData* input, vtkPolyData* output);
  void Remesh(vtkPolyData* input, vtkPolyData* output);
  void ScaleAxes(vtkPolyData* input, vtkPolyData* output);

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
  double NoisePercent = 0.3;
  double SmoothingFactor = 0.1;
  int SmoothingIterations = 10;
  int QuantizationBits = 9;
  int SubdivisionType = Midpoint;
  int NumberOfSubdivisions = 1;
  double CroppingPercent = 10.0;
  int RemeshingMethod = Uniform;
  double RemeshingPercent = 100.0;
  int IsosurfaceResolution = 256;
  double AxisScaleFactors[3] = { 1.0, 1.0, 1.1 };
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfEigensolves = 0;
};

#endif
