// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/reliability.h"

#include <gtest/gtest.h>

#include <iostream>

namespace sigloc
{
namespace
{
TEST(Reliability, AreaUnderTheCurveIsTheShareOfPairsInOrder)
{
  EXPECT_DOUBLE_EQ(areaUnderCurve({3, 4}, {1, 2}).area, 1.0);
  EXPECT_DOUBLE_EQ(areaUnderCurve({1, 4}, {2, 3}).area, 0.5);
  EXPECT_DOUBLE_EQ(areaUnderCurve({2, 5}, {2, 3}).area, 0.625) << "a tie counts half";
  EXPECT_DOUBLE_EQ(areaUnderCurve({3, 4}, {1, 2}).sigma, 0.0);
  EXPECT_GT(areaUnderCurve({1, 4}, {2, 3}).sigma, 0.1);
}

// The table of 30 worlds is in the report; here a few of them, for regressions.
TEST(Reliability, TellsRightFromWrongAsMrptsMeasureDoes)
{
  ReliabilityOptions options;
  options.worlds = 6;
  options.poses = 12;
  options.clutter = {0, 0.3};
  const ReliabilityReport report = runReliability(options);
  for (const double clutter : options.clutter)
  {
    std::vector<double> right;
    std::vector<double> wrong;
    std::vector<double> right_mrpt;
    std::vector<double> wrong_mrpt;
    for (const ReliabilityCase& judged : report.cases)
    {
      if (judged.clutter != clutter) continue;
      (judged.right ? right : wrong).push_back(judged.signature);
      (judged.right ? right_mrpt : wrong_mrpt).push_back(judged.mrpt);
    }
    ASSERT_GT(right.size(), 50U);
    const double ours = areaUnderCurve(right, wrong).area;
    const double mrpts = areaUnderCurve(right_mrpt, wrong_mrpt).area;
    std::cout << "clutter " << clutter << ": AUC " << ours << ", MRPT's " << mrpts << "\n";
    EXPECT_GT(ours, mrpts - 0.02);
    EXPECT_GT(ours, 0.85);
  }
}

TEST(Reliability, IsTheSameOnOneAndTwoThreads)
{
  ReliabilityOptions options;
  options.worlds = 2;
  options.poses = 3;
  const ReliabilityReport one = runReliability(options);
  options.threads = 2;
  const ReliabilityReport two = runReliability(options);
  ASSERT_EQ(one.cases.size(), two.cases.size());
  for (std::size_t i = 0; i < one.cases.size(); ++i)
  {
    EXPECT_EQ(one.cases[i].signature, two.cases[i].signature);
    EXPECT_EQ(one.cases[i].mrpt, two.cases[i].mrpt);
  }
  options.worlds = 0;
  EXPECT_THROW(runReliability(options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
