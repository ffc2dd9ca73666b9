// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/Errors.h"
#include "Core/Support/Progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace spectralwatermark;

namespace
{

// A progress whose reports end in the list.
Progress Recording(std::vector<double>& seen)
{
  return Progress(
    [&seen](double fraction)
    {
      seen.push_back(fraction);
      return true;
    });
}

} // namespace

TEST(Progress, ReportsFractionsFrom0To1)
{
  std::vector<double> seen;
  const Progress progress = Recording(seen);
  for (const double fraction : { -1.0, 0.0, 0.25, 1.0, 7.0 })
  {
    progress.Report(fraction);
  }
  EXPECT_EQ(seen, (std::vector<double>{ 0.0, 0.0, 0.25, 1.0, 1.0 }));
}

TEST(Progress, PartsOfPartsLieInTheirRange)
{
  std::vector<double> seen;
  const Progress half = Recording(seen).Part(0.5, 1.0);
  const Progress quarter = half.Part(0.0, 0.5);
  for (const Progress& progress : { half, quarter })
  {
    progress.Report(0.0);
    progress.Report(0.5);
    progress.Report(1.0);
  }
  EXPECT_EQ(seen, (std::vector<double>{ 0.5, 0.75, 1.0, 0.5, 0.625, 0.75 }));
}

TEST(Progress, PartsInARowRise)
{
  std::vector<double> seen;
  const Progress progress = Recording(seen);
  for (int part = 0; part < 10; ++part)
  {
    progress.Part(0.1 * part, 0.1 * (part + 1)).Report(0.0);
    progress.Part(0.1 * part, 0.1 * (part + 1)).Report(1.0);
  }
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.front(), 0.0);
  EXPECT_NEAR(seen.back(), 1.0, 1e-15);
}

TEST(Progress, AListenerStopsTheWork)
{
  const Progress progress([](double fraction) { return fraction < 0.6; });
  EXPECT_NO_THROW(progress.Report(0.5));
  EXPECT_THROW(progress.Report(0.7), Aborted);
  EXPECT_NO_THROW(progress.Part(0.0, 0.5).Report(1.0));
  EXPECT_THROW(progress.Part(0.5, 1.0).Report(0.4), Aborted);
}

TEST(Progress, NoListenerIsNeeded)
{
  EXPECT_NO_THROW(Progress().Report(0.5));
  EXPECT_NO_THROW(Progress().Part(0.2, 0.4).Report(1.0));
}
