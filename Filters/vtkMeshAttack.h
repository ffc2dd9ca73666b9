// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshAttack
 * @brief   Attacks a mesh as people and software do, to test whether a mark survives
 *
 * The attacks, and the properties that they use:
 *
 * - Rotation rotates the mesh about an axis through the origin (RotationAxis, RotationAngle).
 * - UniformScaling multiplies all coordinates by a factor (ScaleFactor).
 * - Translation adds a vector (TranslationVector).
 * - Similarity applies a random rotation, scaling and translation (Seed).
 * - NoiseAlongNormals moves each vertex v to v + s N(0, 1) e n(v), where e is the mean edge length
 *   and n(v) the normal (paper, 3.3.3; NoiseFactor is s, Seed).
 * - NoiseUniform adds U[-1, 1] a to every coordinate (benchmark; NoisePercent is a, Seed).
 * - SpectralSmoothing damps the high harmonics (paper, 3.3.4; NumberOfHarmonics, CutoffComponent,
 *   SmoothingGain, KeepResidual).
 * - LaplacianSmoothing moves each vertex v to v + f (mean of its neighbours - v), several times
 *   (benchmark; SmoothingFactor is f, SmoothingIterations).
 * - Quantization rounds the coordinates (benchmark; QuantizationBits).
 * - Simplification collapses edges by the quadric error (vtkQuadricDecimation;
 *   SimplificationPercent).
 * - Subdivision divides the triangles (SubdivisionType, NumberOfSubdivisions).
 * - VertexReordering shuffles points and polygons (Seed).
 * - Cropping cuts a part off by a plane (CroppingPercent, Seed).
 * - Remeshing replaces the triangles of the surface by others (RemeshingMethod, RemeshingPercent,
 *   IsosurfaceResolution).
 * - NonUniformScaling multiplies each coordinate by a factor of its own (AxisScaleFactors).
 *
 * "Benchmark" stands for K. Wang, G. Lavoue, F. Denis, A. Baskurt, X. He, "A Benchmark for 3-D Mesh
 * Watermarking" (2010). Its unit of length is the mean distance of the vertices to their centre.
 *
 * The filter is deterministic: the same input and properties give the same output, whatever the
 * number of threads. Noise depends on (Seed, vertex) alone.
 *
 * Most attacks move the points and change nothing else: cells, attributes and unused points stay.
 * Normals and vectors rotate with the mesh. Points at the same place stay together.
 * VertexReordering and Cropping keep the attributes of what remains. Simplification, Subdivision
 * and Remeshing return triangles without attributes, because their points and cells are new. The
 * arrays of a basis (vtkManifoldHarmonics) are removed.
 *
 * The errors (vtkErrorMacro, an error code, an empty output) are those of vtkManifoldHarmonics. It
 * is also an error if the attack or method is unknown; an axis has length 0; a property is not
 * finite; more harmonics than vertices are asked for; the isosurface of a surface that is not
 * closed is asked for; Loop's rule cannot divide the surface; no triangle is left; or there would
 * be more triangles than memory holds.
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
   * Attacks. The numbers will not change.
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
   * The rules of Subdivision.
   */
  enum SubdivisionTypes
  {
    Midpoint = 0, ///< divides each triangle into four, in its plane
    Loop = 1,     ///< Loop's rule: divides each triangle into four and smooths
    Sqrt3 = 2     ///< Kobbelt's √3 rule: makes three triangles of each and smooths
  };

  /**
   * The methods of Remeshing.
   */
  enum RemeshingMethods
  {
    Uniform = 0,   ///< vertices at about equal distances (vtkQuadricClustering)
    Isosurface = 1 ///< the zero level of the signed distance, sampled on a grid
  };

  ///@{
  /**
   * Set/Get the attack, an AttackType. Default NoiseAlongNormals. Any other number is an error when
   * the filter runs.
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
   * Set/Get the seed of the random attacks. Default 0; any integer.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Set/Get the axis of Rotation. Default (0, 0, 1); any length except 0.
   */
  vtkSetVector3Macro(RotationAxis, double);
  vtkGetVector3Macro(RotationAxis, double);
  ///@}

  ///@{
  /**
   * Set/Get the angle of Rotation, in degrees. Default 30; any finite number.
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
   * Set/Get the vector of Translation, in the model's units. Default (1, 0, 0); any finite numbers.
   */
  vtkSetVector3Macro(TranslationVector, double);
  vtkGetVector3Macro(TranslationVector, double);
  ///@}

  ///@{
  /**
   * Set/Get the paper's s_noise for NoiseAlongNormals: the standard deviation of the displacement,
   * in mean edge lengths. Default 0.5, at least 0. The vertex normals are weighted by triangle
   * area.
   */
  vtkSetClampMacro(NoiseFactor, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NoiseFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get the number of harmonics m of which SpectralSmoothing makes the smoothed mesh. Default
   * 300 (the paper does not give its m), at least 1.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  ///@{
  /**
   * Set/Get the last component that SpectralSmoothing leaves unchanged, 1-based. Default 200, as in
   * the paper; at least 1.
   */
  vtkSetClampMacro(CutoffComponent, int, 1, VTK_INT_MAX);
  vtkGetMacro(CutoffComponent, int);
  ///@}

  ///@{
  /**
   * Set/Get the factor by which SpectralSmoothing multiplies the components after CutoffComponent.
   * Default 0.5, as in the paper; any finite number.
   */
  vtkSetMacro(SmoothingGain, double);
  vtkGetMacro(SmoothingGain, double);
  ///@}

  ///@{
  /**
   * Set/Get whether SpectralSmoothing keeps the part of the geometry outside its m harmonics.
   * Default off: that part is dropped, as in the paper's formula, which smooths far more than the
   * gain does.
   */
  vtkSetMacro(KeepResidual, bool);
  vtkGetMacro(KeepResidual, bool);
  vtkBooleanMacro(KeepResidual, bool);
  ///@}

  ///@{
  /**
   * Set/Get the share of the edges that Simplification removes, in percent. On a closed mesh it
   * removes the same percentage of the triangles and nearly the same of the vertices. Default 50,
   * from 0 to 99.9.
   */
  vtkSetClampMacro(SimplificationPercent, double, 0.0, 99.9);
  vtkGetMacro(SimplificationPercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the amplitude a of NoiseUniform, in percent of the mean distance of the vertices to
   * their centre. Default 0.3, at least 0.
   */
  vtkSetClampMacro(NoisePercent, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(NoisePercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the factor f of LaplacianSmoothing. Default 0.1, as in the benchmark; from 0 to 1.
   */
  vtkSetClampMacro(SmoothingFactor, double, 0.0, 1.0);
  vtkGetMacro(SmoothingFactor, double);
  ///@}

  ///@{
  /**
   * Set/Get the number of times that LaplacianSmoothing moves all vertices. Vertices on boundaries
   * stay. Default 10, at least 0.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, VTK_INT_MAX);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  ///@{
  /**
   * Set/Get the number of bits R of Quantization: 2^R levels divide each axis evenly from one side
   * of the bounding box to the other. Default 9, from 1 to 30.
   */
  vtkSetClampMacro(QuantizationBits, int, 1, 30);
  vtkGetMacro(QuantizationBits, int);
  ///@}

  ///@{
  /**
   * Set/Get the rule of Subdivision, one of SubdivisionTypes. Default Midpoint. Any other number is
   * an error when the filter runs.
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
   * Set/Get the number of times that Subdivision divides all triangles. Default 1, from 1 to 6.
   */
  vtkSetClampMacro(NumberOfSubdivisions, int, 1, 6);
  vtkGetMacro(NumberOfSubdivisions, int);
  ///@}

  ///@{
  /**
   * Set/Get the share of the points that Cropping cuts off by a plane in a random direction, in
   * percent. Default 10, from 0 to 99.
   */
  vtkSetClampMacro(CroppingPercent, double, 0.0, 99.0);
  vtkGetMacro(CroppingPercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the method of Remeshing, one of RemeshingMethods. Default Uniform. Any other number is
   * an error when the filter runs.
   */
  vtkSetMacro(RemeshingMethod, int);
  vtkGetMacro(RemeshingMethod, int);
  void SetRemeshingMethodToUniform() { this->SetRemeshingMethod(Uniform); }
  void SetRemeshingMethodToIsosurface() { this->SetRemeshingMethod(Isosurface); }
  const char* GetRemeshingMethodAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the approximate number of vertices after the uniform Remeshing, in percent of their
   * number before. Default 100, from 0.1 to 1000. Triangles are split down to half the size of a
   * cell of a grid over the bounding box, and the vertices in each cell are merged. Both take
   * memory. It is an error if the memory does not suffice, if the mesh is very thin for its
   * bounding box, or if its triangles are thousands of times as long as wide.
   */
  vtkSetClampMacro(RemeshingPercent, double, 0.1, 1000.0);
  vtkGetMacro(RemeshingPercent, double);
  ///@}

  ///@{
  /**
   * Set/Get the number of grid steps of the isosurface Remeshing along the longest side of the
   * bounding box. Default 256, from 8 to 1024.
   */
  vtkSetClampMacro(IsosurfaceResolution, int, 8, 1024);
  vtkGetMacro(IsosurfaceResolution, int);
  ///@}

  ///@{
  /**
   * Set/Get the factors of NonUniformScaling for x, y and z. Default (1, 1, 1.1); any finite
   * numbers except 0.
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
   * Get the number of bases that the last update computed: 0 unless SpectralSmoothing found no
   * usable basis on its input.
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
