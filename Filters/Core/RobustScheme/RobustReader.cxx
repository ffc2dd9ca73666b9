// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/RobustReader.h"

#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Mesh/UmbrellaSmoothing.h"
#include "Core/Payload/BitAgreement.h"
#include "Core/RobustScheme/FrameAlignment.h"
#include "Core/RobustScheme/SolidFrame.h"
#include "Core/RobustScheme/SolidResponse.h"
#include "Core/RobustScheme/SolidSpectrum.h"
#include "Core/Support/Parallel.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Eigen::VectorXd;

// The number of smoothing iterations from one level of undone smoothing to the next.
constexpr int SmoothingStride = 5;

// The number of levels of undone smoothing that are tried: 0, 5, ..., 60 iterations.
constexpr int NumberOfSmoothings = 13;

// The factor of the benchmark's smoothing, which is undone.
constexpr double SmoothingFactor = 0.1;

// The factor by which undoing smoothing may enlarge the surface. The area of a smooth surface grows
// little, whereas noise soon covers everything.
constexpr double MostArea = 2.0;

// The clearness of a frame (see SolidFrame) below which all signs of its axes are tried.
constexpr double ClearSkewness = 0.05;

// The fit at which nothing else needs to be tried. A mesh without the mark fits the code by about
// one half, and never as well as this.
constexpr double ClearFit = 0.8;

// The share of the progress for trying levels of smoothing; the alignment takes the rest.
constexpr double SmoothingPart = 0.7;

// Reads the mesh under every hypothesis to be tried, and keeps the reading that fits best.
class Reader
{
public:
  Reader(const TriangleMesh& mesh, const CarrierSet& carriers, int threads)
    : Mesh(Oriented(mesh))
    , Carrier(carriers)
    , Threads(threads)
    , Turns(FrameOf(this->Mesh).Clearness < ClearSkewness ? NumberOfTurns : 1)
  {
  }

  RobustReading Run(const Progress& progress)
  {
    this->TryEverySmoothing(progress.Part(0.0, SmoothingPart));
    if (this->Best.Fit < ClearFit)
    {
      this->AlignFrames(progress.Part(SmoothingPart, 1.0));
    }
    progress.Report(1.0);
    return this->Best;
  }

private:
  // The mesh in a frame, and the carrier values there.
  struct CarrierView
  {
    SolidView Solid;
    VectorXd Values;
  };

  CarrierView ViewIn(const TriangleMesh& mesh, const SolidFrame& frame) const
  {
    SolidView solid(mesh, frame);
    VectorXd values = SolidSpectrum(solid.Mesh, this->Carrier.Waves, this->Threads);
    return { std::move(solid), std::move(values) };
  }

  RobustReading ReadingOf(const ReadingHypothesis& hypothesis, const Alignment& aligned) const
  {
    RobustReading reading;
    reading.Hypothesis = hypothesis;
    reading.Values = aligned.Values;
    reading.Soft = SoftBits(aligned.Values, this->Carrier, StepOfNumber(hypothesis.Step));
    reading.Data = Decode(reading.Soft, reading.Fit);
    reading.Fit -= aligned.Cost;
    return reading;
  }

  // The best reading over all steps. `alignedFor` gives the alignment for the number of a step.
  template <typename Function>
  RobustReading BestStep(ReadingHypothesis hypothesis, const Function& alignedFor) const
  {
    std::vector<RobustReading> readings(NumberOfSteps);
    ForEachTask(this->Threads, NumberOfSteps,
      [&](Index number)
      {
        ReadingHypothesis tried = hypothesis;
        tried.Step = static_cast<int>(number);
        readings[number] = this->ReadingOf(tried, alignedFor(tried.Step));
      });
    return *std::max_element(readings.begin(), readings.end(),
      [](const RobustReading& a, const RobustReading& b) { return a.Fit < b.Fit; });
  }

  void Keep(RobustReading reading)
  {
    if (reading.Fit > this->Best.Fit)
    {
      this->Best = std::move(reading);
    }
  }

  void TryEverySmoothing(const Progress& progress);
  void AlignFrames(const Progress& progress);

  TriangleMesh Mesh;
  const CarrierSet& Carrier;
  int Threads;
  int Turns;
  RobustReading Best;
  std::optional<CarrierView> BestView;     // the view of the best reading
  std::vector<CarrierView> UnchangedViews; // the views of the unchanged mesh, one per half-turn
};

void Reader::TryEverySmoothing(const Progress& progress)
{
  const UmbrellaSmoothing smoothing(this->Mesh);
  const double area = VertexAreas(this->Mesh).sum();
  TriangleMesh sharper = this->Mesh;
  for (int level = 0; level < NumberOfSmoothings && this->Best.Fit < ClearFit; ++level)
  {
    for (int k = 0; level > 0 && k < SmoothingStride; ++k)
    {
      sharper.Points = smoothing.Apply(sharper.Points, -SmoothingFactor);
    }
    const std::optional<SolidFrame> frame = FrameIfAny(sharper);
    const bool hasGrown = level > 0 && !(VertexAreas(sharper).sum() < MostArea * area);
    if (!frame || hasGrown)
    {
      // Noise covers everything, and further levels would only amplify it.
      return;
    }
    for (int turn = 0; turn < this->Turns; ++turn)
    {
      CarrierView view = this->ViewIn(sharper, RotatedByPi(*frame, turn));
      RobustReading reading = this->BestStep({ level * SmoothingStride, turn, 0 },
        [&view](int /*step*/) {
          return Alignment{ view.Values, 0.0 };
        });
      if (level == 0)
      {
        this->UnchangedViews.push_back(view);
      }
      if (reading.Fit > this->Best.Fit)
      {
        this->Best = std::move(reading);
        this->BestView = std::move(view);
      }
      progress.Report(
        static_cast<double>(level * this->Turns + turn + 1) / (NumberOfSmoothings * this->Turns));
    }
  }
}

// Aligns the frame of the unchanged mesh for every step, and that of the best reading so far if it
// undid some smoothing.
void Reader::AlignFrames(const Progress& progress)
{
  const auto responseOf = [this](const CarrierView& view)
  { return FrameResponse(view.Solid.Mesh, view.Values, this->Carrier, this->Threads); };
  const ReadingHypothesis plain = this->Best.Hypothesis;
  if (plain.Smoothing > 0)
  {
    this->Keep(this->ReadingOf(plain,
      Align(this->BestView->Values, responseOf(*this->BestView), this->Carrier,
        StepOfNumber(plain.Step))));
  }
  for (int turn = 0; turn < this->Turns; ++turn)
  {
    progress.Report((turn + 1.0) / (this->Turns + 1.0));
    const CarrierView& view = this->UnchangedViews[turn];
    const Eigen::MatrixXd response = responseOf(view);
    this->Keep(this->BestStep({ 0, turn, 0 },
      [&](int step) { return Align(view.Values, response, this->Carrier, StepOfNumber(step)); }));
  }
}

} // namespace

RobustReading ReadCarriers(const TriangleMesh& mesh, const CarrierSet& carriers, int threads,
  const Progress& progress)
{
  return Reader(mesh, carriers, threads).Run(progress);
}

RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, Index messageBits,
  int threads, const Progress& progress)
{
  return ReadRobust(mesh, key, CarriersOf(key, messageBits), threads, progress);
}

RobustReading ReadRobust(const TriangleMesh& mesh, const SecretKey& key, const CarrierSet& carriers,
  int threads, const Progress& progress)
{
  RobustReading reading = ReadCarriers(mesh, carriers, threads, progress);
  reading.Message = reading.Data.substr(0, carriers.MessageBits);
  reading.IsValid = reading.Data == DataOf(reading.Message, key, carriers.CheckBits);
  return reading;
}

double PValueOf(const RobustReading& reading, const std::string& expectedData)
{
  return AgreementPValue(reading.Data, expectedData, UnmarkedModel());
}

} // namespace spectralwatermark
