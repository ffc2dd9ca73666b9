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
 * The input is any vtkPolyData with polygons or strips (triangulated on the fly): open, closed,
 * non-manifold, of several components. Points at exactly the same place count as one vertex.
 * Triangles without area are allowed. Points used by no polygon get a harmonic of 0.
 *
 * Output port 0: the input's points, cells and attributes, and
 *
 * | array               | data  | tuples x components | meaning                      | unit       |
 * |---------------------|-------|---------------------|------------------------------|------------|
 * | `ManifoldHarmonics` | point | n x m               | H^k, component 0 is H^1      | 1/length   |
 * | `VertexMass`        | point | n x 1               | lumped mass D of its vertex  | length^2   |
 * | `Eigenvalues`       | field | m x 1               | lambda_k, ascending          | 1/length^2 |
 * | `Spectrum`          | field | m x 3               | x~, y~, z~ (eq. 6)           | length^2   |
 * | `SpectrumMagnitude` | field | m x 1               | c (eq. 9)                    | length^2   |
 * | `Residuals`         | field | m x 1               | relative, see Tolerance      | none       |
 *
 * All are double. Output port 1: a vtkTable, the spectrum as charts take it, with a row per harmonic:
 * `Component` (1-based), `Eigenvalue`, `X`, `Y`, `Z`, `Magnitude`. Downstream, vtkSpectralWatermarkEmbed, vtkSpectralWatermarkDetect,
 * vtkManifoldHarmonicsReconstruction and vtkMeshAttack find the basis in these arrays and use it
 * as long as it is still one for the geometry that they see.
 *
 * Errors (vtkErrorMacro, an error code, empty outputs): no points, no polygons, coordinates
 * that are not finite, no area, fewer vertices than harmonics asked for, a solver that does not
 * reach the tolerance, the dense solver on more than 10,000 vertices, less memory than it would take, a
 * piece of a distributed mesh.
 *
 * @code{.cpp}
 * vtkNew<vtkManifoldHarmonics> harmonics;
 * harmonics->SetInputConnection(reader->GetOutputPort());
 * harmonics->SetNumberOfHarmonics(300);
 * harmonics->Update();
 * vtkDataArray* basis = harmonics->GetOutput()->GetPointData()->GetArray("ManifoldHarmonics");
 * @endcode
 *
 * @warning
 * Within a repeated eigenvalue (spheres, symmetric models) the basis vectors span the right
 * space, but which of them come out is not determined.
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
   * Set/Get the number of harmonics m, the constant one included. Default 100, at least 1. More
   * than the mesh has distinct vertices with area is an error.
   */
  vtkSetClampMacro(NumberOfHarmonics, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfHarmonics, int);
  ///@}

  /**
   * Mass matrices: Lumped is diagonal (the paper's D), Consistent is <phi_i, phi_j> (its B).
   */
  enum MassMatrixType
  {
    Lumped = 0,
    Consistent = 1
  };

  ///@{
  /**
   * Set/Get the mass matrix, which defines the inner product. Default Lumped. The watermarking
   * filters use a basis only when it is a lumped one.
   */
  vtkSetClampMacro(MassMatrix, int, Lumped, Consistent);
  vtkGetMacro(MassMatrix, int);
  void SetMassMatrixToLumped() { this->SetMassMatrix(Lumped); }
  void SetMassMatrixToConsistent() { this->SetMassMatrix(Consistent); }
  const char* GetMassMatrixAsString() const;
  ///@}

  ///@{
  /**
   * Set/Get how many harmonics are computed per shift-invert band. Default 0: the solver chooses.
   * A smaller band needs less memory and more factorisations. The result does not depend on it
   * beyond the tolerance.
   */
  vtkSetClampMacro(BandSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(BandSize, int);
  ///@}

  ///@{
  /**
   * Set/Get the largest admitted relative residual,
   * ||S h - lambda D h|| / ((lambda + 1 / area) ||D h||). Default 1e-8, from 1e-14 to 1e-2. On
   * meshes with extremely thin triangles, what rounding leaves is admitted on top.
   */
  vtkSetClampMacro(Tolerance, double, 1e-14, 1e-2);
  vtkGetMacro(Tolerance, double);
  ///@}

  /**
   * Eigensolvers. Automatic takes the fastest that is safe for the mesh: BlockLanczos as a rule,
   * Spectra where harmonics are many for the number of vertices, Dense for small meshes.
   * BlockLanczos is this library's shift-invert block Lanczos method in bands, Spectra the library
   * of that name (implicitly restarted Lanczos, one vector at a time), Dense a direct method for up
   * to 10,000 vertices.
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
   * Set/Get the eigensolver. Default Automatic. All give the same spectrum within the tolerance;
   * the others are there to compare with.
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
   * After an update: whether the spectrum is known to be complete, no eigenvalue below the last one
   * missing and every multiple one there as often as it should be. That is counted by Sylvester's
   * law of inertia, not assumed. False before the first update and after a failed one (that it is
   * incomplete is an error).
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
