// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of the filters share.
#ifndef SpectralWatermark_Testing_FilterTesting_h
#define SpectralWatermark_Testing_FilterTesting_h

#include "Core/Support/Progress.h"

#include "Support/Shapes.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkMeshAttack;
class vtkObject;
class vtkPolyData;
class vtkPolyDataAlgorithm;

namespace filtertesting
{

/// The mesh as a vtkPolyData, with double points unless `storesFloat`.
vtkSmartPointer<vtkPolyData> PolyData(const shapes::TriangleMesh& mesh, bool storesFloat = false);

/// Every triangle with three points of its own: a soup, as STL files hold it.
vtkSmartPointer<vtkPolyData> Soup(const shapes::TriangleMesh& mesh);

/// Coordinates rounded to 2^bits steps of the longest side of the bounding box.
shapes::TriangleMesh Quantized(shapes::TriangleMesh mesh, int bits);

/// Share of the triangles that have two corners at the same place or no area.
double DegenerateShare(const shapes::TriangleMesh& mesh);

/// A named point or field array; nullptr when absent.
vtkDataArray* PointArray(vtkPolyData* data, const char* name);
vtkDataArray* FieldArray(vtkPolyData* data, const char* name);

/// Whether both hold the same points to the last bit.
bool SamePoints(vtkPolyData* a, vtkPolyData* b);

/// One of each filter, the watermarks in both schemes and an attack of every kind, ready to run on
/// shapes::Bumpy(4).
std::vector<vtkSmartPointer<vtkPolyDataAlgorithm>> EveryFilter();

/// An attack of this kind (vtkMeshAttack::AttackType) on the mesh, its properties at their defaults.
vtkSmartPointer<vtkMeshAttack> AttackOn(vtkPolyData* mesh, int kind);

/// The mesh on every input port of the filter.
void SetEveryInput(vtkPolyDataAlgorithm* filter, vtkPolyData* mesh);

/// Listens to one filter: its errors, warnings and progress, none of which reach the terminal.
class Listener
{
public:
  explicit Listener(vtkAlgorithm* filter);
  ~Listener();
  Listener(const Listener&) = delete;
  void operator=(const Listener&) = delete;

  /// Asks the filter to stop as soon as it reports this progress.
  void AbortAt(double progress) { this->AbortProgress = progress; }

  std::string Errors;   ///< everything said through vtkErrorMacro
  std::string Warnings; ///< and through vtkWarningMacro
  std::vector<double> Progress;

private:
  void Forward(vtkObject* caller, unsigned long event, void* data);
  void Ignore(vtkObject* caller, unsigned long event, void* data);

  vtkAlgorithm* Filter;
  double AbortProgress = 2.0;
  std::vector<unsigned long> Tags;
  unsigned long ExecutiveTag = 0;
};

/// The folder of real scans: the environment variable SPECTRALWATERMARK_MESH_DIR, or what the
/// build was configured with.
std::string MeshDirectory();

/// A scan of that folder; nullptr when the folder has no such file.
vtkSmartPointer<vtkPolyData> ReadScan(const std::string& name);

/// Why a test on this scan, as ReadScan() gave it, is to be skipped; "" when it is not. All but the
/// smallest scan are left to ./test.sh --full.
std::string WhyToSkip(const std::string& name, vtkPolyData* scan);

} // namespace filtertesting

#endif
