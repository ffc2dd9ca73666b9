// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include "Core/Mesh/TriangleMesh.h"
#include "Private/PolyDataMesh.h"
#include "Support/FullTests.h"

#include <Eigen/Geometry>

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkManifoldHarmonicsSimilarity.h>
#include <vtkMeshAttack.h>
#include <vtkMeshDistortion.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace filtertesting
{

using shapes::Index;
using shapes::TriangleMesh;

vtkSmartPointer<vtkPolyData> PolyData(const TriangleMesh& mesh, bool storesFloat)
{
  return spectralwatermark::ToUncheckedPolyData(mesh, storesFloat);
}

vtkSmartPointer<vtkPolyData> Soup(const TriangleMesh& mesh)
{
  TriangleMesh soup;
  soup.Points.resize(3 * mesh.NumberOfTriangles(), 3);
  soup.Triangles.resize(mesh.NumberOfTriangles(), 3);
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      soup.Points.row(3 * t + corner) = mesh.Points.row(mesh.Triangles(t, corner));
      soup.Triangles(t, corner) = 3 * t + corner;
    }
  }
  return PolyData(soup);
}

TriangleMesh Quantized(TriangleMesh mesh, int bits)
{
  const Eigen::RowVector3d low = mesh.Points.colwise().minCoeff();
  const double side = (mesh.Points.colwise().maxCoeff() - low).maxCoeff();
  const double step = side / std::ldexp(1.0, bits);
  const TriangleMesh::PointMatrix cells = (mesh.Points.rowwise() - low) / step;
  mesh.Points = (cells.array().round() * step).matrix().rowwise() + low;
  return mesh;
}

double DegenerateShare(const TriangleMesh& mesh)
{
  Index degenerate = 0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Eigen::RowVector3d p = mesh.Points.row(mesh.Triangles(t, 0));
    const Eigen::RowVector3d q = mesh.Points.row(mesh.Triangles(t, 1));
    const Eigen::RowVector3d r = mesh.Points.row(mesh.Triangles(t, 2));
    const double longest = std::max({ (p - q).norm(), (q - r).norm(), (r - p).norm() });
    degenerate += (q - p).cross(r - p).norm() <= 1e-12 * longest * longest ? 1 : 0;
  }
  return static_cast<double>(degenerate) / static_cast<double>(mesh.NumberOfTriangles());
}

vtkDataArray* PointArray(vtkPolyData* data, const char* name)
{
  return data->GetPointData()->GetArray(name);
}

vtkDataArray* FieldArray(vtkPolyData* data, const char* name)
{
  return data->GetFieldData()->GetArray(name);
}

bool SamePoints(vtkPolyData* a, vtkPolyData* b)
{
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints())
  {
    return false;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double q[3];
    a->GetPoint(i, p);
    b->GetPoint(i, q);
    if (p[0] != q[0] || p[1] != q[1] || p[2] != q[2])
    {
      return false;
    }
  }
  return true;
}

std::vector<vtkSmartPointer<vtkPolyDataAlgorithm>> EveryFilter()
{
  std::vector<vtkSmartPointer<vtkPolyDataAlgorithm>> filters;
  filters.emplace_back(vtkSmartPointer<vtkManifoldHarmonics>::New());
  auto reconstruction = vtkSmartPointer<vtkManifoldHarmonicsReconstruction>::New();
  reconstruction->SetNumberOfHarmonics(60);
  filters.emplace_back(reconstruction);
  auto similarity = vtkSmartPointer<vtkManifoldHarmonicsSimilarity>::New();
  similarity->SetNumberOfHarmonics(60);
  filters.emplace_back(similarity);
  for (const int scheme :
    { vtkSpectralWatermarkEmbed::PaperSlots, vtkSpectralWatermarkEmbed::Robust })
  {
    auto embed = vtkSmartPointer<vtkSpectralWatermarkEmbed>::New();
    embed->SetScheme(scheme);
    embed->SetMessage("10110");
    filters.emplace_back(embed);
    auto detect = vtkSmartPointer<vtkSpectralWatermarkDetect>::New();
    detect->SetScheme(scheme);
    detect->SetNumberOfBits(5);
    filters.emplace_back(detect);
  }
  for (int kind = vtkMeshAttack::Rotation; kind <= vtkMeshAttack::NonUniformScaling; ++kind)
  {
    auto attack = vtkSmartPointer<vtkMeshAttack>::New();
    attack->SetAttack(kind);
    filters.emplace_back(attack);
  }
  filters.emplace_back(vtkSmartPointer<vtkMeshDistortion>::New());
  return filters;
}

vtkSmartPointer<vtkMeshAttack> AttackOn(vtkPolyData* mesh, int kind)
{
  auto attack = vtkSmartPointer<vtkMeshAttack>::New();
  attack->SetInputData(mesh);
  attack->SetAttack(kind);
  return attack;
}

void SetEveryInput(vtkPolyDataAlgorithm* filter, vtkPolyData* mesh)
{
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    filter->SetInputData(port, mesh);
  }
}

Listener::Listener(vtkAlgorithm* filter)
  : Filter(filter)
{
  for (const unsigned long event :
    { vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent })
  {
    this->Tags.push_back(filter->AddObserver(event, this, &Listener::Forward));
  }
  this->ExecutiveTag =
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Listener::Ignore);
}

Listener::~Listener()
{
  for (const unsigned long tag : this->Tags)
  {
    this->Filter->RemoveObserver(tag);
  }
  this->Filter->GetExecutive()->RemoveObserver(this->ExecutiveTag);
}

void Listener::Forward(vtkObject*, unsigned long event, void* data)
{
  if (event == vtkCommand::ErrorEvent)
  {
    this->Errors += static_cast<const char*>(data);
  }
  else if (event == vtkCommand::WarningEvent)
  {
    this->Warnings += static_cast<const char*>(data);
  }
  else
  {
    this->Progress.push_back(this->Filter->GetProgress());
    if (this->Filter->GetProgress() >= this->AbortProgress)
    {
      this->Filter->SetAbortExecute(1);
    }
  }
}

void Listener::Ignore(vtkObject*, unsigned long, void*) {}

std::string MeshDirectory()
{
  const char* directory = std::getenv("SPECTRALWATERMARK_MESH_DIR");
  return directory != nullptr && *directory != '\0' ? directory : DEFAULT_MESH_DIR;
}

vtkSmartPointer<vtkPolyData> ReadScan(const std::string& name)
{
  const std::string file = MeshDirectory() + "/" + name + ".ply";
  if (!std::ifstream(file).good())
  {
    return nullptr;
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::string WhyToSkip(const std::string& name, vtkPolyData* scan)
{
  constexpr vtkIdType small = 3000;
  if (scan == nullptr)
  {
    return "no " + name + ".ply in " + MeshDirectory() +
      ": set SPECTRALWATERMARK_MESH_DIR to a folder with the scans";
  }
  const bool isLeftOut = scan->GetNumberOfPoints() > small && !RunsFullTests();
  return isLeftOut ? "long: set SPECTRALWATERMARK_FULL_TESTS (./test.sh --full does)" : "";
}

} // namespace filtertesting
