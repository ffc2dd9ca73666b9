// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkManifoldHarmonics
 * @brief   Fourier-like basis of a triangle mesh, and the mesh's spectrum in it
 *
 * Computes the first m manifold harmonics H^k of a surface: the solutions of
 *
 *     S h = lambda D h,   0 = lambda_1 <= lambda_2 <= ...
 *
 * with S the cotangent stiffness matrix (symmetric positive semi-definite, natural boundary
 * condition) and D the mass matrix (paper, section 2.1, eqs. 4 and 5), and with them the
 * coordinates' spectrum (eq. 6) and its magnitudes (eq. 9). The basis is orthonormal in D, its
 * signs are fixed, and every residual is reported.
 *
 * The input is any vtkPolyData with polygons or strips, which are triangulated internally. The
 * surface may be open, closed, non-manifold, or of several components. Points at exactly the same
 * place count as one vertex. Triangles without area are allowed. Harmonics are 0 at points used by
 * no polygon.
 *
 * Output port 0 has the input's points, cells and attributes, and these arrays of doubles:
 *
 * | array               | data  | tuples x components | meaning                      | unit       |
 * |---------------------|-------|---------------------|------------------------------|------------|
 * | `ManifoldHarmonics` | point | n x m               | H^k, component 0 is H^1      | 1/length   |
 * | `VertexMass`        | point | n x 1               | lumped mass D of the vertex  | length^2   |
 * | `Eigenvalues`       | field | m x 1               | lambda_k, ascending          | 1/length^2 |
 * | `Spectrum`          | field | m x 3               | x~, y~, z~ (eq. 6)           | length^2   |
 * | `SpectrumMagnitude` | field | m x 1               | c (eq. 9)                    | length^2   |
 * | `Residuals`         | field | m x 1               | relative, see Tolerance      | none       |
 *
 * Output port 1 has the spectrum as a vtkTable for charts, with a row per harmonic: `Component`
 * (1-based), `Eigenvalue`, `X`, `Y`, `Z`, `Magnitude`.
 *
 * Downstream, vtkSpectralWatermarkEmbed, vtkSpectralWatermarkDetect, vtkMeshAttack,
 * vtkManifoldHarmonicsReconstruction and vtkManifoldHarmonicsSimilarity find the basis in these
 * arrays. They use it only if it is a basis for the geometry of their own input.
 *
 * It is an error (vtkErrorMacro, an error code, empty outputs) if the input has no points, no
 * polygons, no area, coordinates that are not finite, or fewer vertices than harmonics are asked
 * for; if the solver does not reach the tolerance; if the dense solver is asked for more than
 * 10,000 vertices; if the memory does not suffice; or if the input is one piece of a distributed
 * mesh.
 *
 * @code{.cpp}
 * vtkNew<vtkManifoldHarmonics> harmonics;
 * harmonics->SetInputConnection(reader->GetOutputPort());
 * harmonics->SetNumberOfHarmonics(300);
 * harmonics->Update();
 * vtkDataArray* basis = harmonics->GetOutput()->GetPointData()->GetArray("ManifoldHarmonics");
 * @endcode
 *
 * The paper is Y. Liu, B. Prabhakaran and X. Guo, "A Robust Spectral Approach for Blind
 * Watermarking of Manifold Surfaces" (2008), here and in all classes.
 *
 * @warning
 * Where an eigenvalue repeats (spheres, symmetric models), the harmonics span the right space, but
 * the single harmonics are not determined.
 *
 * @sa
 * vtkManifoldHarmonicsReconstruction vtkSpectralWatermarkEmbed
 *
 * B. Vallet and B. Levy, "Spectral Geometry Processing with Manifold Harmonics", Computer
 * Graphics Forum 27(2), 2008.
 */
#ifndef vtkManifoldHarmonics_h
#define vtkManifoldHarmonics_h

#include "vtkFiltersSpectralWatermarkModule.h" // for export macro
#include "vtkTriangleMeshAlgorithm.h"

#include <string> // for ArrayName

class VTKFILTERSSPECTRALWATERMARK_EXPORT vtkManifoldHarmonics : public vtkTriangleMeshAlgorithm
{
public:
  static vtkManifoldHarmonics* New();
  vtkTypeMacro(vtkManifoldHarmonics, vtkTriangleMeshAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set/Get the number of harmonics m, including the constant one. Default 100, at least 1. More
   * harmonics than the mesh has distinct vertices with area are an error.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  /**
   * Mass matrices. Lumped is diagonal (the paper's D), Consistent is <phi_i, phi_j> (the paper's
   * B).
   */
  enum MassMatrixType
  {
    Lumped = 0,
    Consistent = 1
  };

  ///@{
  /**
   * Set/Get the mass matrix, which defines the inner product. Default Lumped. The watermarking
   * filters use a basis of their input only if it is a lumped one.
   */
  vtkSetClampMacro(MassMatrix, int, Lumped, Consistent);
  vtkGetMacro(MassMatrix, int);
  void SetMassMatrixToLumped() { this->SetMassMatrix(Lumped); }
  void SetMassMatrixToConsistent() { this->SetMassMatrix(Consistent); }
  const char* GetMassMatrixAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get the number of harmonics per shift-invert band. Default 0: the solver chooses; at
   * least 0. A smaller
   * band needs less memory but more factorisations. The result depends on it only within the
   * tolerance.
   */
  vtkSetClampMacro(BandSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(BandSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the largest admissible relative residual,
   * ||S h - lambda D h|| / ((lambda + 1 / area) ||D h||). Default 1e-8, from 1e-14 to 1e-2. On
   * meshes with extremely thin triangles, the rounding error is admitted in addition.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 1e-2);
  vtkGetMacro(Tolerance, double);
  ///@}

  /**
   * Eigensolvers. Automatic takes the fastest one that is safe for the mesh: BlockLanczos as a
   * rule, Spectra if the harmonics are many for the number of vertices, Dense for small meshes.
   * BlockLanczos is this library's own shift-invert block Lanczos method, which works band by band.
   * Spectra is the library of that name (implicitly restarted Lanczos, one vector at a time). Dense
   * is a direct method for up to 10,000 vertices.
   */
  enum SolverType
  {
    Automatic = 0,
    BlockLanczos = 1,
    Spectra = 2,
    Dense = 3
  };

  ///@{
  /**
   * Set/Get the eigensolver. Default Automatic. All solvers give the same spectrum within the
   * tolerance; the other choices serve comparisons.
   */
  vtkSetClampMacro(Solver, int, Automatic, Dense);
  vtkGetMacro(Solver, int);
  void SetSolverToAutomatic() { this->SetSolver(Automatic); }
  void SetSolverToBlockLanczos() { this->SetSolver(BlockLanczos); }
  void SetSolverToSpectra() { this->SetSolver(Spectra); }
  void SetSolverToDense() { this->SetSolver(Dense); }
  const char* GetSolverAsString() const;
  ///@}

  /**
   * Get whether the spectrum of the last update is proven complete: no eigenvalue below the last
   * one is missing, and every repeated eigenvalue has its full multiplicity. Sylvester's law of
   * inertia gives the count. False before the first update and after a failed one. An incomplete
   * spectrum is an error.
   */
  vtkGetMacro(SpectrumIsComplete, bool);

  ///@{
  /**
   * Set/Get the name of the basis array. Default "ManifoldHarmonics", the name under which the
   * other filters look for a basis. An empty name or nullptr restores the default.
   */
  void SetArrayName(const char* name);
  const char* GetArrayName() const { return this->ArrayName.c_str(); }
  ///@}

protected:
  vtkManifoldHarmonics();
  ~vtkManifoldHarmonics() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkManifoldHarmonics(const vtkManifoldHarmonics&) = delete;
  void operator=(const vtkManifoldHarmonics&) = delete;

  void ResetResults() override;

  int NumberOfHarmonics = 100;
  int MassMatrix = Lumped;
  int BandSize = 0;
  double Tolerance = 1e-8;
  int Solver = Automatic;
  bool SpectrumIsComplete = false;
  std::string ArrayName = "ManifoldHarmonics";
};

#endif
