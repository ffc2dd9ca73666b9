// SPDX-License-Identifier: BSD-3-Clause
#include "Support/FilterTesting.h"

#include <vtkAlgorithmOutput.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSpectralWatermarkDetect.h>
#include <vtkSpectralWatermarkEmbed.h>
#include <vtkTable.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

using namespace filtertesting;

namespace
{

std::string Read(vtkPolyData* mesh, int bits = 5)
{
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputData(mesh);
  detect->SetNumberOfBits(bits);
  detect->Update();
  return detect->GetExtractedMessage();
}

// Each of its squares is a quadrilateral that is not flat.
vtkSmartPointer<vtkPolyData> QuadrilateralBall(shapes::Index steps)
{
  const shapes::TriangleMesh squares = shapes::SquaresOnABall(steps);
  const auto ball = PolyData(squares);
  vtkNew<vtkCellArray> quadrilaterals; // of two triangles each, (a, b, c) and (a, c, d)
  for (shapes::Index t = 0; t < squares.NumberOfTriangles(); t += 2)
  {
    quadrilaterals->InsertNextCell({ squares.Triangles(t, 0), squares.Triangles(t, 1),
      squares.Triangles(t, 2), squares.Triangles(t + 1, 2) });
  }
  ball->SetPolys(quadrilaterals);
  return ball;
}

vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* mesh, vtkTransform* transform)
{
  vtkNew<vtkTransformPolyDataFilter> move;
  move->SetInputData(mesh);
  move->SetTransform(transform);
  move->Update();
  return move->GetOutput();
}

} // namespace

TEST(WatermarkFilters, PaperSlotsDefaultsAreThePapers)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  EXPECT_STREQ(embed->GetSchemeAsString(), "PaperSlots");
  EXPECT_STREQ(embed->GetMessage(), "10110");
  EXPECT_STREQ(embed->GetBitEmbeddingAsString(), "Aggressive");
  EXPECT_STREQ(embed->GetSlotDivisionAsString(), "Normal");
  EXPECT_EQ(embed->GetFirstComponent(), 21);
  EXPECT_EQ(embed->GetSlotSize(), 10);
  EXPECT_EQ(embed->GetCarrierPosition(), 5);
  EXPECT_EQ(embed->GetTurbulenceFactor(), 1.0);
  EXPECT_EQ(embed->GetRequiredBits(), 0);
  EXPECT_EQ(embed->GetMaximumNumberOfIterations(), 20);
  EXPECT_STREQ(embed->GetExtractedMessage(), "");
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  EXPECT_EQ(detect->GetNumberOfBits(), 5);
  EXPECT_STREQ(detect->GetExpectedMessage(), "");
  EXPECT_EQ(detect->GetFalsePositiveRate(), 1e-6);
}

TEST(WatermarkFilters, MarkIsReadBackBlind)
{
  const auto mesh = PolyData(shapes::Bumpy(4), true);
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(mesh);
  for (const char* message : { "10110", "01001", "111", "00000000" })
  {
    embed->SetMessage(message);
    embed->Update();
    EXPECT_EQ(embed->GetConverged(), 1) << message;
    EXPECT_STREQ(embed->GetExtractedMessage(), message);
    EXPECT_EQ(embed->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
    EXPECT_EQ(Read(embed->GetOutput(), static_cast<int>(std::string(message).size())), message);
  }
}

TEST(WatermarkFilters, OutputIsTheInputMovedALittle)
{
  const auto mesh = PolyData(shapes::Bumpy(4));
  const vtkIdType lonely = mesh->GetPoints()->InsertNextPoint(3.0, 2.0, 1.0);
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(mesh);
  embed->Update();
  vtkPolyData* marked = embed->GetOutput();
  ASSERT_EQ(marked->GetNumberOfPoints(), mesh->GetNumberOfPoints());
  EXPECT_EQ(marked->GetNumberOfPolys(), mesh->GetNumberOfPolys());
  double bounds[6];
  PolyData(shapes::Bumpy(4))->GetBounds(bounds);
  const double diagonal =
    std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]);
  vtkDataArray* distortion = PointArray(marked, "GeometricDistortion");
  ASSERT_NE(distortion, nullptr);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    double q[3];
    mesh->GetPoint(i, p);
    marked->GetPoint(i, q);
    const double distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    EXPECT_NEAR(distortion->GetComponent(i, 0), distance / diagonal, 1e-14);
    EXPECT_LT(distance, 0.05 * diagonal);
  }
  EXPECT_EQ(distortion->GetComponent(lonely, 0), 0.0);
}

TEST(WatermarkFilters, SeamsDoNotTear)
{
  const auto soup = Soup(shapes::Bumpy(4));
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(soup);
  embed->Update();
  ASSERT_EQ(embed->GetConverged(), 1);
  // The same place before means the same place after.
  vtkNew<vtkSpectralWatermarkEmbed> whole;
  whole->SetSchemeToPaperSlots();
  whole->SetInputData(PolyData(shapes::Bumpy(4)));
  whole->Update();
  const shapes::TriangleMesh shape = shapes::Bumpy(4);
  for (shapes::Index t = 0; t < shape.NumberOfTriangles(); t += 11)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      double p[3];
      double q[3];
      embed->GetOutput()->GetPoint(3 * t + corner, p);
      whole->GetOutput()->GetPoint(shape.Triangles(t, corner), q);
      // The vertices are numbered otherwise in a soup: the same up to the solver's accuracy.
      EXPECT_NEAR(p[0], q[0], 1e-6);
      EXPECT_NEAR(p[1], q[1], 1e-6);
      EXPECT_NEAR(p[2], q[2], 1e-6);
    }
  }
}

// Which diagonal divides a quadrilateral depends on where its corners are, and so on the mark.
TEST(WatermarkFilters, QuadrilateralsAreReadBack)
{
  for (const shapes::Index steps : { 4, 6, 8, 16 })
  {
    const auto mesh = QuadrilateralBall(steps);
    for (const std::string message : { "1", "0110", "10110010" })
    {
      if (steps == 4 && message.size() == 8)
      {
        continue; // has too few harmonics
      }
      vtkNew<vtkSpectralWatermarkEmbed> embed;
      embed->SetSchemeToPaperSlots();
      embed->SetInputData(mesh);
      embed->SetMessage(message.c_str());
      embed->Update();
      EXPECT_EQ(embed->GetConverged(), 1) << steps << " " << message;
      EXPECT_EQ(Read(embed->GetOutput(), static_cast<int>(message.size())), message) << steps;
    }
  }
}

// The margin that embedding tells is the one that a detector finds, whose carriers are cosines. Few
// quadrilaterals lose much of it to other diagonals.
TEST(WatermarkFilters, TheMarginOfQuadrilateralsIsTheDetectors)
{
  for (const char* message : { "0", "0110" })
  {
    vtkNew<vtkSpectralWatermarkEmbed> embed;
    embed->SetInputData(QuadrilateralBall(5));
    embed->SetSecretKey("an owner");
    embed->SetMessage(message);
    embed->Update();
    EXPECT_EQ(embed->GetConverged(), 1) << message;
    vtkNew<vtkSpectralWatermarkDetect> detect;
    detect->SetInputConnection(embed->GetOutputPort());
    detect->SetSecretKey("an owner");
    detect->SetNumberOfBits(static_cast<int>(std::string(message).size()));
    detect->Update();
    EXPECT_STREQ(detect->GetExtractedMessage(), message);
    auto* carriers = vtkTable::SafeDownCast(detect->GetOutputDataObject(1));
    double least = 1.0;
    for (vtkIdType row = 0; row < carriers->GetNumberOfRows(); ++row)
    {
      least = std::min(least, std::abs(carriers->GetValueByName(row, "Margin").ToDouble()));
    }
    EXPECT_LT(embed->GetMargin(), 0.9) << message;
    EXPECT_NEAR(least, std::sin(0.5 * vtkMath::Pi() * embed->GetMargin()), 1e-6) << message;
  }
}

// Two balls that hang together by a triangle with an edge of 1e-9: in float they fall apart, and the
// first two harmonics are constant on each.
TEST(WatermarkFilters, WhatFallsApartWhenItIsStoredIsRefused)
{
  shapes::TriangleMesh mesh = shapes::Union({ shapes::Bumpy(2), shapes::Bumpy(2) }, 5.0);
  const shapes::Index a = mesh.Triangles(0, 0);
  const shapes::Index b = mesh.Triangles(0, 1);
  mesh.Points.row(b) = mesh.Points.row(a) + Eigen::RowVector3d(0.0, 0.0, 1e-9);
  mesh = shapes::WithTriangles(mesh, {}, { { a, b, mesh.NumberOfVertices() / 2 } });
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetFirstComponent(2);
  embed->SetInputData(PolyData(mesh));
  Listener listener(embed);
  embed->Update();
  EXPECT_EQ(listener.Errors, "");
  embed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  embed->Update();
  for (const char* part :
    { "once marked and rounded as its points are stored, the mesh cannot be read: ",
      "the mesh has 2 components", "store double points, or move the model to the origin" })
  {
    EXPECT_NE(listener.Errors.find(part), std::string::npos) << listener.Errors;
  }
  EXPECT_EQ(embed->GetOutput()->GetNumberOfPoints(), 0);
}

// Rounded to float, all points are in one place.
TEST(WatermarkFilters, WhatIsTooFarAwayForFloatIsRefused)
{
  shapes::TriangleMesh mesh = shapes::Bumpy(2);
  mesh.Points.array() += 1e9;
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetInputData(PolyData(mesh));
  embed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  embed->SetSecretKey("an owner");
  embed->SetNumberOfBits(8);
  for (const int scheme :
    { vtkSpectralWatermarkEmbed::Robust, vtkSpectralWatermarkEmbed::PaperSlots })
  {
    embed->SetScheme(scheme);
    Listener listener(embed);
    embed->Update();
    EXPECT_NE(listener.Errors.find("once marked and rounded as its points are stored"),
      std::string::npos)
      << listener.Errors;
    EXPECT_EQ(embed->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(WatermarkFilters, TablesTellTheStory)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  embed->Update();
  auto* history = vtkTable::SafeDownCast(embed->GetOutputDataObject(1));
  ASSERT_NE(history, nullptr);
  const int iterations = embed->GetNumberOfIterationsUsed();
  ASSERT_EQ(history->GetNumberOfRows(), 5 * (iterations + 1));
  for (const char* name : { "Iteration", "Slot", "Component", "Magnitude", "Average", "Deviation",
         "BitWanted", "BitRead" })
  {
    ASSERT_NE(history->GetColumnByName(name), nullptr) << name;
  }
  for (int slot = 0; slot < 5; ++slot)
  {
    const vtkIdType row = 5 * iterations + slot;
    EXPECT_EQ(history->GetValueByName(row, "Iteration").ToInt(), iterations);
    EXPECT_EQ(history->GetValueByName(row, "Component").ToInt(), 25 + 10 * slot);
    EXPECT_EQ(history->GetValueByName(row, "BitWanted").ToInt(), "10110"[slot] - '0');
    EXPECT_EQ(history->GetValueByName(row, "BitRead").ToInt(), "10110"[slot] - '0');
  }

  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  detect->SetInputConnection(embed->GetOutputPort());
  detect->Update();
  auto* bits = vtkTable::SafeDownCast(detect->GetOutputDataObject(1));
  ASSERT_NE(bits, nullptr);
  ASSERT_EQ(bits->GetNumberOfRows(), 5);
  for (int slot = 0; slot < 5; ++slot)
  {
    const double magnitude = bits->GetValueByName(slot, "Magnitude").ToDouble();
    const double average = bits->GetValueByName(slot, "Average").ToDouble();
    const double margin = bits->GetValueByName(slot, "Margin").ToDouble();
    const double confidence = bits->GetValueByName(slot, "Confidence").ToDouble();
    EXPECT_EQ(magnitude > average ? 1 : 0, bits->GetValueByName(slot, "Bit").ToInt());
    EXPECT_EQ(margin > 0.0, magnitude > average);
    EXPECT_GE(confidence, 0.0);
    EXPECT_LT(confidence, 1.0);
    // What the embedder saw last is what the detector sees.
    EXPECT_NEAR(magnitude, history->GetValueByName(5 * iterations + slot, "Magnitude").ToDouble(),
      1e-9 * magnitude);
  }
}

TEST(WatermarkFilters, VerdictOnAnExpectedMessage)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  embed->Update();
  vtkNew<vtkSpectralWatermarkDetect> detect;
  detect->SetSchemeToPaperSlots();
  Listener listener(detect);
  detect->SetInputConnection(embed->GetOutputPort());
  detect->SetFalsePositiveRate(0.05);
  detect->SetExpectedMessage("10110");
  detect->Update();
  EXPECT_EQ(detect->GetBitErrorRate(), 0.0);
  EXPECT_EQ(detect->GetCorrelation(), 1.0);
  // Three ones at 0.52 at most and two zeros at 0.6: unmarked meshes read no fair coins.
  EXPECT_NEAR(detect->GetPValue(), 0.52 * 0.52 * 0.52 * 0.6 * 0.6, 1e-15);
  EXPECT_EQ(detect->GetSmallestPValue(), detect->GetPValue()); // all bits agree
  EXPECT_EQ(detect->GetDetected(), 0);
  EXPECT_NE(listener.Warnings.find("cannot prove"), std::string::npos);
  listener.Warnings.clear();
  detect->SetFalsePositiveRate(0.06);
  detect->Update();
  EXPECT_EQ(detect->GetDetected(), 1);
  EXPECT_EQ(listener.Warnings, "");

  detect->SetExpectedMessage("10001");
  detect->Update();
  EXPECT_NEAR(detect->GetBitErrorRate(), 0.6, 1e-15);
  EXPECT_NEAR(detect->GetCorrelation(), -0.2, 1e-15);
  EXPECT_GT(detect->GetPValue(), 26.0 / 32.0); // what fair coins would give
  EXPECT_LT(detect->GetPValue(), 1.0);
  EXPECT_EQ(detect->GetDetected(), 0);
  EXPECT_EQ(detect->GetMessageIsValid(), 0);
  EXPECT_NEAR(detect->GetSmallestPValue(), 0.52 * 0.52 * 0.6 * 0.6 * 0.6, 1e-15);

  // Five bits cannot reach one in a million, and that is said.
  detect->SetFalsePositiveRate(1e-6);
  detect->SetExpectedMessage("10110");
  detect->Update();
  EXPECT_EQ(detect->GetDetected(), 0);
  EXPECT_NE(listener.Warnings.find("cannot prove"), std::string::npos);

  // The expected message decides how many bits are read.
  detect->SetFalsePositiveRate(1.0);
  detect->SetExpectedMessage("101");
  detect->Update();
  EXPECT_STREQ(detect->GetExtractedMessage(), "101");
}

// Section 3.3.1: never a bit, whatever the rotation, translation and scale.
TEST(WatermarkFilters, SimilaritiesNeverChangeABit)
{
  for (const bool storesFloat : { false, true })
  {
    vtkNew<vtkSpectralWatermarkEmbed> embed;
    embed->SetSchemeToPaperSlots();
    embed->SetInputData(PolyData(shapes::Bumpy(4), storesFloat));
    embed->Update();
    ASSERT_EQ(embed->GetConverged(), 1);
    vtkNew<vtkTransform> transform;
    for (const double scale : { 0.001, 0.37, 1000.0 })
    {
      for (const double angle : { 17.0, 90.0, 203.0 })
      {
        transform->Identity();
        transform->RotateWXYZ(angle, 0.2, -0.7, 0.4);
        transform->Scale(scale, scale, scale);
        transform->Translate(angle, -2.0, 0.1 * angle);
        EXPECT_EQ(Read(Moved(embed->GetOutput(), transform)), "10110")
          << scale << " " << angle << (storesFloat ? " float" : " double");
      }
    }
  }
}

TEST(WatermarkFilters, FarFromTheOriginNothingIsLost)
{
  vtkNew<vtkTransform> away;
  away->Translate(4.0e6, -2.5e6, 1.0e6);
  const auto near = PolyData(shapes::Bumpy(4));
  const auto far = Moved(near, away);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetInputData(near);
  moved->SetTransform(away);
  moved->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  moved->Update();
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputConnection(moved->GetOutputPort());
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 1);
  EXPECT_EQ(Read(embed->GetOutput()), "10110");
  vtkNew<vtkSpectralWatermarkEmbed> embedNear;
  embedNear->SetSchemeToPaperSlots();
  embedNear->SetInputData(near);
  embedNear->Update();
  EXPECT_EQ(embed->GetNumberOfIterationsUsed(), embedNear->GetNumberOfIterationsUsed());
}

TEST(WatermarkFilters, SurvivesAFloatFile)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  embed->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  embed->Update();
  ASSERT_EQ(embed->GetConverged(), 1);
  const std::string file = testing::TempDir() + "spectralwatermark-float.ply";
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputConnection(embed->GetOutputPort());
  writer->SetFileName(file.c_str());
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_TRUE(SamePoints(reader->GetOutput(), embed->GetOutput()));
  EXPECT_EQ(Read(reader->GetOutput()), "10110");
  std::remove(file.c_str());
}

TEST(WatermarkFilters, NonConvergenceWarnsAndReturnsTheBestMesh)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  Listener listener(embed);
  embed->SetInputData(PolyData(shapes::Bumpy(3)));
  embed->SetMessage("11111111");
  embed->SetTurbulenceFactor(0.0);
  embed->SetMaximumNumberOfIterations(1);
  embed->Update();
  ASSERT_EQ(embed->GetConverged(), 0);
  EXPECT_EQ(embed->GetErrorCode(), 0u);
  EXPECT_EQ(listener.Errors, "");
  EXPECT_NE(listener.Warnings.find("did not converge"), std::string::npos);
  EXPECT_EQ(Read(embed->GetOutput(), 8), embed->GetExtractedMessage());
}

TEST(WatermarkFilters, ThresholdIsHonoured)
{
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(shapes::Bumpy(4)));
  embed->SetRequiredBits(1);
  embed->Update();
  EXPECT_EQ(embed->GetConverged(), 1);
  EXPECT_EQ(embed->GetNumberOfIterationsUsed(), 1);
}

TEST(WatermarkFilters, QuantisedMeshesCarryAMark)
{
  const shapes::TriangleMesh rounded = Quantized(shapes::Bumpy(5), 5);
  ASSERT_GT(DegenerateShare(rounded), 0.6);
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->SetInputData(PolyData(rounded));
  embed->Update();
  EXPECT_EQ(embed->GetErrorCode(), 0u);
  EXPECT_EQ(Read(embed->GetOutput()), embed->GetExtractedMessage());
}

TEST(WatermarkFilters, PrintTheirProperties)
{
  std::ostringstream text;
  vtkNew<vtkSpectralWatermarkEmbed> embed;
  embed->SetSchemeToPaperSlots();
  embed->Print(text);
  for (const char* name : { "Scheme: PaperSlots", "SlotDivision: Normal", "FirstComponent: 21",
         "SlotSize: 10", "CarrierPosition: 5", "Message: 10110", "TurbulenceFactor: 1",
         "BitEmbedding: Aggressive", "MaximumNumberOfIterations: 20" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}
