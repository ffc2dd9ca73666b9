// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStripper.h>
#include <vtkTable.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace filtertesting;

namespace
{

vtkSmartPointer<vtkPolyData> HarmonicsOf(vtkPolyData* mesh, int count)
{
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(mesh);
  filter->SetNumberOfHarmonics(count);
  filter->Update();
  return filter->GetOutput();
}

double LargestDifference(vtkDataArray* a, vtkDataArray* b)
{
  double largest = 0.0;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      largest = std::max(largest, std::abs(a->GetComponent(i, c) - b->GetComponent(i, c)));
    }
  }
  return largest;
}

void ExpectSameEigenvalues(vtkPolyData* a, vtkPolyData* b, double relative = 1e-9)
{
  vtkDataArray* first = FieldArray(a, "Eigenvalues");
  vtkDataArray* second = FieldArray(b, "Eigenvalues");
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  ASSERT_EQ(first->GetNumberOfTuples(), second->GetNumberOfTuples());
  const double scale = first->GetComponent(first->GetNumberOfTuples() - 1, 0);
  EXPECT_LT(LargestDifference(first, second), relative * scale);
}

void CheckArray(vtkDataArray* array, vtkIdType tuples, int components)
{
  ASSERT_NE(array, nullptr);
  EXPECT_EQ(array->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(array->GetNumberOfTuples(), tuples);
  EXPECT_EQ(array->GetNumberOfComponents(), components);
}

} // namespace

TEST(ManifoldHarmonicsFilter, OutputsTheArraysOfItsDocumentation)
{
  const auto mesh = PolyData(shapes::Bumpy(3), true);
  const auto output = HarmonicsOf(mesh, 30);
  const vtkIdType n = mesh->GetNumberOfPoints();
  CheckArray(PointArray(output, "ManifoldHarmonics"), n, 30);
  CheckArray(PointArray(output, "VertexMass"), n, 1);
  CheckArray(FieldArray(output, "Eigenvalues"), 30, 1);
  CheckArray(FieldArray(output, "Spectrum"), 30, 3);
  CheckArray(FieldArray(output, "SpectrumMagnitude"), 30, 1);
  CheckArray(FieldArray(output, "Residuals"), 30, 1);

  // Orthonormal, as computed from the arrays alone.
  vtkDataArray* basis = PointArray(output, "ManifoldHarmonics");
  vtkDataArray* mass = PointArray(output, "VertexMass");
  for (int a = 0; a < 30; ++a)
  {
    for (int b = 0; b <= a; ++b)
    {
      double product = 0.0;
      for (vtkIdType i = 0; i < n; ++i)
      {
        product += basis->GetComponent(i, a) * mass->GetComponent(i, 0) * basis->GetComponent(i, b);
      }
      EXPECT_NEAR(product, a == b ? 1.0 : 0.0, 1e-10);
    }
  }
  // Equation 6 and 9, by hand for one component.
  double descriptor[3] = { 0.0, 0.0, 0.0 };
  for (vtkIdType i = 0; i < n; ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    for (int axis = 0; axis < 3; ++axis)
    {
      descriptor[axis] += p[axis] * mass->GetComponent(i, 0) * basis->GetComponent(i, 11);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(FieldArray(output, "Spectrum")->GetComponent(11, axis), descriptor[axis], 1e-10);
  }
  EXPECT_NEAR(FieldArray(output, "SpectrumMagnitude")->GetComponent(11, 0),
    std::hypot(descriptor[0], descriptor[1], descriptor[2]), 1e-10);
}

TEST(ManifoldHarmonicsFilter, SpectrumIsATableToo)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Bumpy(3)));
  harmonics->SetNumberOfHarmonics(30);
  harmonics->Update();
  const auto field = [&](const char* name, int row, int column)
  { return FieldArray(harmonics->GetOutput(), name)->GetComponent(row, column); };
  auto* table = vtkTable::SafeDownCast(harmonics->GetOutputDataObject(1));
  ASSERT_EQ(table->GetNumberOfRows(), 30);
  for (int k = 0; k < 30; ++k)
  {
    const auto cell = [&](const char* name) { return table->GetValueByName(k, name).ToDouble(); };
    EXPECT_EQ(cell("Component"), k + 1.0);
    EXPECT_EQ(cell("Eigenvalue"), field("Eigenvalues", k, 0));
    EXPECT_EQ(cell("X"), field("Spectrum", k, 0));
    EXPECT_EQ(cell("Y"), field("Spectrum", k, 1));
    EXPECT_EQ(cell("Z"), field("Spectrum", k, 2));
    EXPECT_EQ(cell("Magnitude"), field("SpectrumMagnitude", k, 0));
  }
}

TEST(ManifoldHarmonicsFilter, KeepsWhatTheInputCarriesAndLeavesItAlone)
{
  const auto mesh = PolyData(shapes::Bumpy(2));
  const vtkIdType lonely = mesh->GetPoints()->InsertNextPoint(9.0, 9.0, 9.0);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ lonely });
  mesh->SetVerts(vertices);
  vtkNew<vtkFloatArray> colour;
  colour->SetName("Colour");
  colour->SetNumberOfTuples(mesh->GetNumberOfPoints());
  colour->Fill(0.5);
  mesh->GetPointData()->AddArray(colour);
  vtkNew<vtkDoubleArray> note;
  note->SetName("Note");
  note->InsertNextValue(3.0);
  mesh->GetFieldData()->AddArray(note);

  const auto output = HarmonicsOf(mesh, 10);
  EXPECT_EQ(output->GetNumberOfVerts(), 1);
  EXPECT_EQ(output->GetNumberOfPolys(), mesh->GetNumberOfPolys());
  EXPECT_NE(PointArray(output, "Colour"), nullptr);
  EXPECT_NE(FieldArray(output, "Note"), nullptr);
  EXPECT_TRUE(SamePoints(output, mesh));
  // A point that no polygon uses has no harmonic and no mass.
  EXPECT_EQ(PointArray(output, "ManifoldHarmonics")->GetComponent(lonely, 0), 0.0);
  EXPECT_EQ(PointArray(output, "VertexMass")->GetComponent(lonely, 0), 0.0);
  EXPECT_EQ(PointArray(mesh, "ManifoldHarmonics"), nullptr);
  EXPECT_EQ(FieldArray(mesh, "Eigenvalues"), nullptr);
}

TEST(ManifoldHarmonicsFilter, StripsAndPolygonsAreTriangulated)
{
  const auto triangles = PolyData(shapes::Bumpy(3));
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(triangles);
  stripper->Update();
  ASSERT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0);
  ExpectSameEigenvalues(HarmonicsOf(stripper->GetOutput(), 20), HarmonicsOf(triangles, 20));

  // A plane of quads is the same surface as one of triangles.
  const auto plane = PolyData(shapes::Rectangle(12, 12, 1.0, 1.0));
  vtkNew<vtkPolyData> quads;
  quads->SetPoints(plane->GetPoints());
  vtkNew<vtkCellArray> cells;
  for (vtkIdType j = 0; j < 12; ++j)
  {
    for (vtkIdType i = 0; i < 12; ++i)
    {
      const vtkIdType corner = 13 * j + i;
      cells->InsertNextCell({ corner, corner + 1, corner + 14, corner + 13 });
    }
  }
  quads->SetPolys(cells);
  ExpectSameEigenvalues(HarmonicsOf(quads, 15), HarmonicsOf(plane, 15));
}

// A soup of triangles (as STL files hold it) is the surface that it looks like.
TEST(ManifoldHarmonicsFilter, CoincidentPointsAreOneVertex)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  const auto soup = Soup(shapes::Bumpy(3));
  const auto output = HarmonicsOf(soup, 30);
  ExpectSameEigenvalues(output, HarmonicsOf(mesh, 30));
  CheckArray(PointArray(output, "ManifoldHarmonics"), soup->GetNumberOfPoints(), 30);
}

TEST(ManifoldHarmonicsFilter, OpenBoundariesAndNonManifoldEdgesWork)
{
  // Three sheets that share one edge.
  vtkNew<vtkPolyData> book;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const int size = 20;
  for (int j = 0; j <= size; ++j)
  {
    points->InsertNextPoint(0.0, static_cast<double>(j) / size, 0.0);
  }
  for (int sheet = 0; sheet < 3; ++sheet)
  {
    const double angle = 2.0943951 * sheet;
    const auto id = [&](int i, int j) -> vtkIdType
    { return i == 0 ? j : (size + 1) * (1 + sheet * size + i - 1) + j; };
    for (int i = 1; i <= size; ++i)
    {
      for (int j = 0; j <= size; ++j)
      {
        const double r = static_cast<double>(i) / size;
        points->InsertNextPoint(r * std::cos(angle), static_cast<double>(j) / size,
          r * std::sin(angle));
      }
    }
    for (int i = 0; i < size; ++i)
    {
      for (int j = 0; j < size; ++j)
      {
        cells->InsertNextCell({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
        cells->InsertNextCell({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
      }
    }
  }
  book->SetPoints(points);
  book->SetPolys(cells);
  const auto output = HarmonicsOf(book, 12);
  vtkDataArray* values = FieldArray(output, "Eigenvalues");
  ASSERT_NE(values, nullptr);
  EXPECT_EQ(values->GetComponent(0, 0), 0.0);
  // A star of three unit intervals times [0, 1]: first (pi / 2)^2 twice (odd across the spine),
  // then pi^2 (along the spine) and pi^2 (even).
  const double quarter = 0.25 * 9.8696044;
  EXPECT_NEAR(values->GetComponent(1, 0), quarter, 0.01 * quarter);
  EXPECT_NEAR(values->GetComponent(2, 0), quarter, 0.01 * quarter);
  EXPECT_NEAR(values->GetComponent(3, 0), 4.0 * quarter, 0.04 * quarter);
  EXPECT_NEAR(values->GetComponent(4, 0), 4.0 * quarter, 0.04 * quarter);
}

TEST(ManifoldHarmonicsFilter, ComponentsHaveAZeroEigenvalueEach)
{
  const auto output = HarmonicsOf(
    PolyData(shapes::Union({ shapes::Bumpy(2), shapes::Icosphere(2), shapes::Icosphere(1) }, 5.0)),
    12);
  vtkDataArray* values = FieldArray(output, "Eigenvalues");
  ASSERT_NE(values, nullptr);
  EXPECT_EQ(values->GetComponent(2, 0), 0.0);
  EXPECT_GT(values->GetComponent(3, 0), 0.1);
}

TEST(ManifoldHarmonicsFilter, ConsistentAndLumpedMassBracketTheSpectrum)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(mesh);
  filter->SetNumberOfHarmonics(20);
  filter->SetMassMatrixToConsistent();
  filter->Update();
  EXPECT_STREQ(filter->GetMassMatrixAsString(), "Consistent");
  const double consistent = FieldArray(filter->GetOutput(), "Eigenvalues")->GetComponent(19, 0);
  const double lumped = FieldArray(HarmonicsOf(mesh, 20), "Eigenvalues")->GetComponent(19, 0);
  // Conforming elements with the exact mass overestimate every eigenvalue; lumping lowers them.
  EXPECT_GT(consistent, lumped);
  EXPECT_NEAR(consistent, lumped, 0.05 * lumped);
}

// Rounding to a coarse grid leaves most triangles without area.
TEST(ManifoldHarmonicsFilter, CoarseQuantisationLeavesAUsableSurface)
{
  const shapes::TriangleMesh fine = shapes::Bumpy(5);
  const double lastFine =
    FieldArray(HarmonicsOf(PolyData(fine), 20), "Eigenvalues")->GetComponent(19, 0);
  for (const int bits : { 7, 6, 5 })
  {
    const shapes::TriangleMesh rounded = Quantized(fine, bits);
    const auto output = HarmonicsOf(PolyData(rounded), 20);
    vtkDataArray* values = FieldArray(output, "Eigenvalues");
    ASSERT_NE(values, nullptr) << bits << " bits";
    EXPECT_EQ(values->GetComponent(0, 0), 0.0);
    EXPECT_GT(values->GetComponent(1, 0), 0.0);
    if (bits == 7)
    {
      EXPECT_NEAR(values->GetComponent(19, 0), lastFine, 0.1 * lastFine);
    }
    if (bits == 5)
    {
      EXPECT_GT(DegenerateShare(rounded), 0.6);
    }
  }
}

// Two eigenvalues that nearly meet may come with other vectors; the spectrum is the same.
TEST(ManifoldHarmonicsFilter, EverySolverGivesTheSameCompleteSpectrum)
{
  const auto mesh = PolyData(shapes::Bumpy(3), true);
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(mesh);
  filter->SetNumberOfHarmonics(40);
  EXPECT_FALSE(filter->GetSpectrumIsComplete()); // nothing is known yet
  filter->SetSolverToDense();
  filter->Update();
  EXPECT_TRUE(filter->GetSpectrumIsComplete());
  vtkNew<vtkPolyData> reference;
  reference->ShallowCopy(filter->GetOutput());
  for (const int solver : { vtkManifoldHarmonics::Automatic, vtkManifoldHarmonics::BlockLanczos,
         vtkManifoldHarmonics::Spectra })
  {
    filter->SetSolver(solver);
    filter->Update();
    EXPECT_TRUE(filter->GetSpectrumIsComplete()) << filter->GetSolverAsString();
    ExpectSameEigenvalues(filter->GetOutput(), reference);
  }
}

TEST(ManifoldHarmonicsFilter, AFailureClaimsNoCompleteSpectrum)
{
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(PolyData(shapes::Icosphere(2), true));
  filter->SetNumberOfHarmonics(20);
  filter->Update();
  EXPECT_TRUE(filter->GetSpectrumIsComplete());
  const Listener listener(filter);
  filter->SetNumberOfHarmonics(100000);
  filter->Update();
  EXPECT_FALSE(filter->GetSpectrumIsComplete());
}

TEST(ManifoldHarmonicsFilter, TheDenseSolverRefusesLargeMeshes)
{
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(PolyData(shapes::Icosphere(6), true)); // 40,962 vertices
  filter->SetSolverToDense();
  const Listener listener(filter);
  filter->Update();
  EXPECT_NE(listener.Errors.find("limited to 10000 vertices"), std::string::npos)
    << listener.Errors;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(ManifoldHarmonicsFilter, ArrayNameCanBeChosen)
{
  vtkNew<vtkManifoldHarmonics> filter;
  filter->SetInputData(PolyData(shapes::Bumpy(2)));
  filter->SetNumberOfHarmonics(5);
  filter->SetArrayName("Basis");
  filter->Update();
  EXPECT_NE(PointArray(filter->GetOutput(), "Basis"), nullptr);
  EXPECT_EQ(PointArray(filter->GetOutput(), "ManifoldHarmonics"), nullptr);
  filter->SetArrayName(nullptr);
  EXPECT_STREQ(filter->GetArrayName(), "ManifoldHarmonics");
}

TEST(ManifoldHarmonicsFilter, PropertiesClampAndPrint)
{
  vtkNew<vtkManifoldHarmonics> filter;
  EXPECT_EQ(filter->GetNumberOfHarmonics(), 100);
  EXPECT_EQ(filter->GetMassMatrix(), vtkManifoldHarmonics::Lumped);
  EXPECT_EQ(filter->GetBandSize(), 0);
  EXPECT_EQ(filter->GetTolerance(), 1e-8);
  filter->SetNumberOfHarmonics(-3);
  EXPECT_EQ(filter->GetNumberOfHarmonics(), 1);
  filter->SetTolerance(0.0);
  EXPECT_EQ(filter->GetTolerance(), 1e-14);
  std::ostringstream text;
  filter->Print(text);
  for (const char* name :
    { "NumberOfHarmonics", "MassMatrix", "BandSize", "Tolerance", "ArrayName" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

TEST(ReconstructionFilter, AllHarmonicsOfASmallMeshGiveItBack)
{
  const auto mesh = PolyData(shapes::Bumpy(2));
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(HarmonicsOf(mesh, 162));
  reconstruction->Update();
  EXPECT_EQ(reconstruction->GetNumberOfEigensolves(), 0);
  EXPECT_LT(LargestDifference(reconstruction->GetOutput()->GetPoints()->GetData(),
              mesh->GetPoints()->GetData()),
    1e-12);
  // The basis is not one for the new points, and does not claim to be.
  EXPECT_EQ(PointArray(reconstruction->GetOutput(), "ManifoldHarmonics"), nullptr);
  EXPECT_EQ(FieldArray(reconstruction->GetOutput(), "Eigenvalues"), nullptr);
}

TEST(ReconstructionFilter, GainDoublesOneDescriptor)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  const auto withBasis = HarmonicsOf(mesh, 60);
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(withBasis);
  reconstruction->KeepResidualOn();
  reconstruction->Update();
  EXPECT_LT(LargestDifference(reconstruction->GetOutput()->GetPoints()->GetData(),
              mesh->GetPoints()->GetData()),
    1e-12);

  reconstruction->SetGain(50, 2.0);
  EXPECT_EQ(reconstruction->GetGain(50), 2.0);
  EXPECT_EQ(reconstruction->GetGain(49), 1.0);
  reconstruction->Update();
  // The points move by x~_50 H^50.
  vtkDataArray* basis = PointArray(withBasis, "ManifoldHarmonics");
  vtkDataArray* spectrum = FieldArray(withBasis, "Spectrum");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); i += 7)
  {
    double before[3];
    double after[3];
    mesh->GetPoint(i, before);
    reconstruction->GetOutput()->GetPoint(i, after);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(after[axis] - before[axis],
        spectrum->GetComponent(49, axis) * basis->GetComponent(i, 49), 1e-12);
    }
  }
}

TEST(ReconstructionFilter, ComputesABasisWhenAskedTo)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(mesh);
  reconstruction->SetNumberOfHarmonics(40);
  reconstruction->Update();
  EXPECT_EQ(reconstruction->GetNumberOfEigensolves(), 1);
  vtkNew<vtkManifoldHarmonicsReconstruction> fromBasis;
  fromBasis->SetInputData(HarmonicsOf(mesh, 40));
  fromBasis->Update();
  EXPECT_LT(LargestDifference(reconstruction->GetOutput()->GetPoints()->GetData(),
              fromBasis->GetOutput()->GetPoints()->GetData()),
    1e-10);
}

TEST(ReconstructionFilter, OutputPrecisionIsAsAsked)
{
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(PolyData(shapes::Bumpy(2), true));
  reconstruction->SetNumberOfHarmonics(10);
  reconstruction->Update();
  EXPECT_EQ(reconstruction->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
  reconstruction->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  reconstruction->Update();
  EXPECT_EQ(reconstruction->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
}
