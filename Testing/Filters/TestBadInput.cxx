// SPDX-License-Identifier: BSD-3-Clause
// Each kind of bad input, through each filter: a message that says what to do, an error code, an
// empty output, and a filter that works again afterwards.
#include "Support/ExpectError.h"

#include <vtkCellArray.h>
#include <vtkManifoldHarmonics.h>
#include <vtkManifoldHarmonicsReconstruction.h>
#include <vtkManifoldHarmonicsSimilarity.h>
#include <vtkMath.h>
#include <vtkMeshAttack.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace filtertesting;

namespace
{

void ExpectErrorFromEvery(vtkPolyData* mesh, const std::string& piece)
{
  const auto sound = PolyData(shapes::Bumpy(4));
  for (const auto& filter : EveryFilter())
  {
    SetEveryInput(filter, mesh);
    ExpectError(filter, "", piece);
    // The error does not outlive its cause.
    SetEveryInput(filter, sound);
    filter->Update();
    EXPECT_EQ(filter->GetErrorCode(), vtkErrorCode::NoError) << filter->GetClassName();
    EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 0) << filter->GetClassName();
  }
}

void ExpectEmbedError(vtkSpectralWatermarkEmbed* embed, const std::string& parameter,
  const std::string& piece)
{
  ExpectError(embed, parameter, piece);
  EXPECT_EQ(embed->GetConverged(), 0);
  EXPECT_EQ(embed->GetNumberOfIterationsUsed(), 0);
  EXPECT_STREQ(embed->GetExtractedMessage(), "");
}

} // namespace

TEST(BadInput, Empty)
{
  ExpectErrorFromEvery(vtkNew<vtkPolyData>(), "no points");
}

TEST(BadInput, NoPolygons)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(PolyData(shapes::Icosphere(2))->GetPoints());
  ExpectErrorFromEvery(cloud, "no polygons");
}

TEST(BadInput, OnlyPolygonsWithoutThreeDistinctPoints)
{
  vtkNew<vtkPolyData> flat;
  flat->SetPoints(PolyData(shapes::Icosphere(2))->GetPoints());
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell({ 0, 1, 1 });
  cells->InsertNextCell({ 2, 2, 2 });
  flat->SetPolys(cells);
  ExpectErrorFromEvery(flat, "three distinct points");
  vtkNew<vtkCellArray> segments;
  segments->InsertNextCell({ 0, 1 });
  flat->SetPolys(segments);
  ExpectErrorFromEvery(flat, "three distinct points");
}

TEST(BadInput, CoordinatesThatAreNotFinite)
{
  for (const double bad : { vtkMath::Nan(), vtkMath::Inf() })
  {
    const auto mesh = PolyData(shapes::Icosphere(3));
    mesh->GetPoints()->SetPoint(17, 0.0, bad, 0.0);
    ExpectErrorFromEvery(mesh, "point 17 has a coordinate that is not finite");
  }
}

// Also in polygons that VTK leaves out when it triangulates.
TEST(BadInput, CoordinatesOfPolygonsThatAreNotFinite)
{
  for (const double bad : { vtkMath::Nan(), -vtkMath::Inf() })
  {
    const auto mesh = PolyData(shapes::Icosphere(3));
    const vtkIdType alone = mesh->GetPoints()->InsertNextPoint(bad, bad, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->DeepCopy(mesh->GetPolys());
    cells->InsertNextCell({ 5, 5, alone, alone, 5 });
    mesh->SetPolys(cells);
    const std::string message =
      "point " + std::to_string(alone) + " has a coordinate that is not finite";
    ExpectErrorFromEvery(mesh, message);
  }
}

TEST(BadInput, UnusedPointsMayBeAnything)
{
  const auto mesh = PolyData(shapes::Bumpy(3));
  mesh->GetPoints()->InsertNextPoint(vtkMath::Nan(), 0.0, 0.0);
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(mesh);
  embed->Update();
  EXPECT_EQ(embed->GetErrorCode(), vtkErrorCode::NoError);
  EXPECT_EQ(embed->GetConverged(), 1);
}

// Polygons that VTK triangulates by their points' numbers, and cells that are no surface.
TEST(BadInput, CellsBeyondThePoints)
{
  const auto withCell = [](vtkCellArray* cells, std::initializer_list<vtkIdType> corners)
  {
    vtkNew<vtkCellArray> more;
    more->DeepCopy(cells);
    more->InsertNextCell(corners);
    return vtkSmartPointer<vtkCellArray>(more);
  };
  const auto sound = PolyData(shapes::Icosphere(1));
  for (const vtkIdType beyond : { vtkIdType{ 4200 }, vtkIdType{ -1 }, vtkIdType{ 1 } << 40 })
  {
    const std::string text =
      "a cell uses point " + std::to_string(beyond) + ", but there are 42 points";
    std::vector<vtkSmartPointer<vtkPolyData>> meshes;
    for (int k = 0; k < 5; ++k)
    {
      meshes.push_back(vtkSmartPointer<vtkPolyData>::New());
      meshes.back()->DeepCopy(sound);
    }
    meshes[0]->SetPolys(withCell(sound->GetPolys(), { 0, 1, beyond }));
    meshes[1]->SetPolys(withCell(sound->GetPolys(), { 0, 1, 2, beyond }));
    meshes[2]->SetStrips(withCell(sound->GetStrips(), { 0, 1, 2, beyond }));
    meshes[3]->SetLines(withCell(sound->GetLines(), { 0, beyond }));
    meshes[4]->SetVerts(withCell(sound->GetVerts(), { beyond }));
    for (vtkPolyData* mesh : meshes)
    {
      for (const auto& filter : EveryFilter())
      {
        SetEveryInput(filter, mesh);
        ExpectError(filter, "", text);
      }
    }
  }
}

TEST(BadInput, PolygonsAndStripsWithoutThreeCornersAreLeftOut)
{
  const auto mesh = PolyData(shapes::Icosphere(1));
  vtkNew<vtkManifoldHarmonics> plain;
  plain->SetNumberOfHarmonics(9);
  plain->SetInputData(mesh);
  plain->Update();
  const auto more = vtkSmartPointer<vtkPolyData>::New();
  more->DeepCopy(mesh);
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1 });
  strips->InsertNextCell(0, static_cast<const vtkIdType*>(nullptr));
  more->SetStrips(strips);
  more->GetPolys()->InsertNextCell({ 3, 4 });
  vtkNew<vtkManifoldHarmonics> with;
  with->SetNumberOfHarmonics(9);
  with->SetInputData(more);
  with->Update();
  ASSERT_EQ(with->GetErrorCode(), vtkErrorCode::NoError);
  for (int k = 0; k < 9; ++k)
  {
    EXPECT_EQ(FieldArray(with->GetOutput(), "Eigenvalues")->GetTuple1(k),
      FieldArray(plain->GetOutput(), "Eigenvalues")->GetTuple1(k));
  }
}

TEST(BadInput, SizesThatCannotBeComputedWith)
{
  const auto scaled = [](double factor)
  {
    shapes::TriangleMesh mesh = shapes::Bumpy(4);
    mesh.Points *= factor;
    return PolyData(mesh);
  };
  ExpectErrorFromEvery(scaled(1e60), "has a coordinate beyond 1e+50");
  ExpectErrorFromEvery(scaled(1e-60), "large; choose smaller units");
}

// What is said to survive turning and scaling does so at any scale of the units.
TEST(BadInput, ScalesFromAtomsToGalaxiesAreNone)
{
  for (const double factor : { 1e-30, 1e30 })
  {
    shapes::TriangleMesh mesh = shapes::Bumpy(4);
    mesh.Points *= factor;
    vtkNew<vtkSpectralWatermarkEmbed> embed;
    embed->SetSecretKey("a secret for the test");
    embed->SetInputData(PolyData(mesh));
    vtkNew<vtkSpectralWatermarkDetect> detect;
    detect->SetSecretKey("a secret for the test");
    detect->UseDerivedMessageOn();
    detect->SetInputConnection(embed->GetOutputPort());
    detect->Update();
    EXPECT_EQ(embed->GetConverged(), 1) << factor;
    EXPECT_EQ(detect->GetDetected(), 1) << factor;
  }
}

TEST(BadInput, ResultsThatFloatCannotHold)
{
  vtkNew<vtkMeshAttack> attack;
  attack->SetInputData(PolyData(shapes::Icosphere(3, 1e20)));
  attack->SetAttackToUniformScaling();
  attack->SetScaleFactor(1e40);
  attack->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  ExpectError(attack, "OutputPointsPrecision", "beyond what float holds; store double points");
  attack->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  attack->Update();
  EXPECT_EQ(attack->GetErrorCode(), vtkErrorCode::NoError);
  attack->SetScaleFactor(VTK_DOUBLE_MAX);
  ExpectError(attack, "", "beyond what double holds");
}

TEST(BadInput, PropertiesThatAreNotFinite)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetTolerance(vtkMath::Nan());
  vtkNew<vtkManifoldHarmonicsSimilarity> similarity;
  similarity->SetClusterTolerance(vtkMath::Nan());
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetMessage("10110");
  embed->SetMaximumDistortion(vtkMath::Nan());
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetFalsePositiveRate(vtkMath::Nan());
  vtkNew<vtkMeshAttack> simplification;
  simplification->SetAttackToSimplification();
  simplification->SetSimplificationPercent(vtkMath::Nan());
  vtkNew<vtkMeshAttack> cropping;
  cropping->SetAttackToCropping();
  cropping->SetCroppingPercent(vtkMath::Nan());
  vtkNew<vtkMeshAttack> remeshing;
  remeshing->SetAttackToRemeshing();
  remeshing->SetRemeshingPercent(vtkMath::Nan());
  for (const auto& [filter, property] :
    std::vector<std::pair<vtkPolyDataAlgorithm*, const char*>>{ { harmonics, "Tolerance" },
      { similarity, "ClusterTolerance" }, { embed, "MaximumDistortion" },
      { detect, "FalsePositiveRate" }, { simplification, "SimplificationPercent" },
      { cropping, "CroppingPercent" }, { remeshing, "RemeshingPercent" } })
  {
    SetEveryInput(filter, mesh);
    ExpectError(filter, property, "the value is not finite");
  }
}

TEST(BadInput, NoAreaAtAll)
{
  // A needle: all points on one line.
  vtkNew<vtkPolyData> needle;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < 200; ++i)
  {
    points->InsertNextPoint(static_cast<double>(i), 0.0, 0.0);
    if (i >= 2)
    {
      cells->InsertNextCell({ i - 2, i - 1, i });
    }
  }
  needle->SetPoints(points);
  needle->SetPolys(cells);
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(needle);
  ExpectError(harmonics, "", "zero area");
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(needle);
  ExpectEmbedError(embed, "", "zero area");
}

TEST(BadInput, FewerVerticesThanHarmonics)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Icosphere(1)));
  ExpectError(harmonics, "NumberOfHarmonics",
    "100 harmonics were requested, but the mesh has only 42");
}

TEST(BadInput, MoreVerticesThanTheDenseSolverTakes)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Icosphere(5)));
  harmonics->SetSolverToDense();
  ExpectError(harmonics, "Solver",
    "the dense solver is limited to 10000 vertices, and this mesh has 10242");
}

// What no input check foresees: the numbers do not become as good as was asked for.
TEST(BadInput, HarmonicsThatCannotBeComputed)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Icosphere(3)));
  harmonics->SetTolerance(1e-14);
  ExpectError(harmonics, "", "harmonics have a residual over the tolerance (largest ",
    vtkErrorCode::UnknownError);
}

TEST(BadInput, SolversThatTheMeshIsTooSmallFor)
{
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputData(PolyData(shapes::Icosphere(0))); // 12 vertices
  harmonics->SetNumberOfHarmonics(10);
  harmonics->SetSolverToBlockLanczos();
  ExpectError(harmonics, "",
    "too few vertices with area for this solver; let the solver be chosen automatically",
    vtkErrorCode::UnknownError);
  harmonics->SetSolverToSpectra();
  ExpectError(harmonics, "",
    "only 1 of 10 harmonics could be computed completely; let the solver be chosen automatically, "
    "ask",
    vtkErrorCode::UnknownError);
  harmonics->SetSolverToAutomatic();
  harmonics->Update();
  EXPECT_EQ(harmonics->GetErrorCode(), vtkErrorCode::NoError);
}

TEST(BadInput, HarmonicsThatCannotBeCompleted)
{
  if (std::getenv("SPECTRALWATERMARK_FULL_TESTS") == nullptr)
  {
    GTEST_SKIP() << "the solver tries for long: run by ./test.sh --full";
  }
  vtkNew<vtkMeshAttack> divide;
  divide->SetInputData(PolyData(shapes::Icosphere(0), true));
  divide->SetAttackToSubdivision();
  divide->SetNumberOfSubdivisions(5);
  vtkNew<vtkMeshAttack> flatten; // to sheets in each other, that meet in needles
  flatten->SetInputConnection(divide->GetOutputPort());
  flatten->SetAttack(vtkMeshAttack::NonUniformScaling);
  flatten->SetAxisScaleFactors(1.0, 1.0, 1e-8);
  vtkNew<vtkManifoldHarmonics> harmonics;
  harmonics->SetInputConnection(flatten->GetOutputPort());
  harmonics->SetTolerance(1e-14);
  ExpectError(harmonics, "", "of 100 harmonics could be computed completely; ask for fewer",
    vtkErrorCode::UnknownError);
}

TEST(BadInput, TurbulenceThatIsNoNumber)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(3)));
  embed->SetTurbulenceFactor(vtkMath::Nan());
  ExpectEmbedError(embed, "TurbulenceFactor", "choose a finite number, 0 or more");
}

TEST(BadInput, MessageOfOtherCharacters)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(PolyData(shapes::Bumpy(3)));
  embed->SetMessage("10x10");
  ExpectEmbedError(embed, "Message", "other than 0 and 1 at position 3");
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetInputData(PolyData(shapes::Bumpy(3)));
  detect->SetExpectedMessage("10 10");
  ExpectError(detect, "ExpectedMessage", "other than 0 and 1 at position 3");
  EXPECT_STREQ(detect->GetExtractedMessage(), "");
  EXPECT_EQ(detect->GetPValue(), 1.0);
}

TEST(BadInput, EmptyMessage)
{
  for (const int scheme :
    { vtkSpectralWatermarkEmbed::PaperSlots, vtkSpectralWatermarkEmbed::Robust })
  {
    vtkNew<vtkSpectralWatermarkEmbed> embed;
    embed->SetScheme(scheme);
    embed->SetInputData(PolyData(shapes::Bumpy(3)));
    for (const char* message : { "", static_cast<const char*>(nullptr) })
    {
      embed->SetMessage(message);
      EXPECT_STREQ(embed->GetMessage(), "");
      ExpectEmbedError(embed, "Message", "the message is empty");
      embed->SetMessage("1");
    }
  }
}

TEST(BadInput, MessageLongerThanTheSpectrum)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(2))); // 162 vertices
  embed->SetMessage("101010101010101");
  ExpectEmbedError(embed, "Message", "15 bits need 170 harmonics, and the mesh has only 162");
}

TEST(BadInput, SlotsBeyondTheHarmonics)
{
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputData(PolyData(shapes::Bumpy(2)));
  detect->SetFirstComponent(150);
  ExpectError(detect, "Message", "5 bits need 199 harmonics, and the mesh has only 162");
}

TEST(BadInput, CarrierOutsideItsSlot)
{
  for (const int position : { 1, 10, 0, -4 })
  {
    vtkNew<vtkSpectralWatermarkEmbed> embed;
    embed->SetSchemeToPaperSlots();
    embed->SetInputData(PolyData(shapes::Bumpy(3)));
    embed->SetCarrierPosition(position);
    ExpectEmbedError(embed, "CarrierPosition",
      "is not inside a slot of 10 components; choose 2 to 9");
  }
}

TEST(BadInput, UnknownScheme)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(PolyData(shapes::Bumpy(3)));
  embed->SetScheme(7);
  EXPECT_STREQ(embed->GetSchemeAsString(), "Unknown");
  ExpectEmbedError(embed, "Scheme", "7 is unknown");
}

TEST(BadInput, SlotsAmongTheConstantsOfManyComponents)
{
  const std::vector<shapes::TriangleMesh> parts(25, shapes::Icosphere(1));
  const auto mesh = PolyData(shapes::Union(parts, 3.0));
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputData(mesh);
  ExpectError(detect, "FirstComponent", "the mesh has 25 components");
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(mesh);
  ExpectEmbedError(embed, "FirstComponent", "choose 26 or more");
}

TEST(BadInput, ReconstructionWithoutABasis)
{
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(PolyData(shapes::Bumpy(3)));
  ExpectError(reconstruction, "NumberOfHarmonics",
    "carries no basis \"ManifoldHarmonics\" that fits");
}

TEST(BadInput, GainBeyondTheHarmonics)
{
  vtkNew<vtkManifoldHarmonicsReconstruction> reconstruction;
  reconstruction->SetInputData(PolyData(shapes::Bumpy(3)));
  reconstruction->SetNumberOfHarmonics(20);
  reconstruction->SetGain(21, 2.0);
  ExpectError(reconstruction, "Gain", "choose components from 1 to 20");
  reconstruction->RemoveAllGains();
  reconstruction->SetGain(0, 2.0);
  ExpectError(reconstruction, "Gain", "choose components from 1 to 20");
  reconstruction->RemoveAllGains();
  reconstruction->SetGain(3, vtkMath::Nan());
  ExpectError(reconstruction, "Gain", "the gain nan of component 3");
}

TEST(BadInput, APieceOfADistributedMesh)
{
  for (const auto& filter : EveryFilter())
  {
    Listener listener(filter);
    SetEveryInput(filter, PolyData(shapes::Bumpy(4)));
    filter->UpdatePiece(0, 2, 0);
    EXPECT_NE(listener.Errors.find("one of several pieces"), std::string::npos)
      << filter->GetClassName() << " said: " << listener.Errors;
    ExpectEmptyOutputs(filter);
  }
}
