// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/kept_scans.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace sigloc;
using detail::KeptScans;
using detail::keptScans;

namespace
{
/// A run in which nothing is localized.
std::vector<StepRecord> unsureSteps(std::size_t count)
{
  std::vector<StepRecord> steps(count);
  for (StepRecord& step : steps) step.belief.verdict = Verdict::ambiguous;
  return steps;
}

auto keptOf(const KeptScans& scans)
{
  return std::count(scans.kept.begin(), scans.kept.end(), true);
}
}  // namespace

TEST(KeptScans, AreAllOfAShortRun)
{
  EXPECT_TRUE(keptScans({}).kept.empty());
  const KeptScans scans = keptScans(unsureSteps(KeptScans::kMost));
  EXPECT_EQ(scans.every, 1U);
  EXPECT_EQ(keptOf(scans), KeptScans::kMost);
}

TEST(KeptScans, OfALongRunHaveItsKeySteps)
{
  std::vector<StepRecord> steps = unsureSteps(13631);
  for (std::size_t k = 5000; k < 7001; ++k) steps[k].belief.verdict = Verdict::localized;
  steps[4001].truth = mrpt::math::TPose2D();
  steps[4001].any_right = true;
  const KeptScans scans = keptScans(steps);
  ASSERT_GT(scans.every, 1U);
  for (const std::size_t key : {4001, 5000, 7001, 13630})
  {
    EXPECT_NE(key % scans.every, 0U) << "the test is of no use";
    EXPECT_TRUE(scans.kept[key]) << key;
  }
  for (std::size_t k = 0; k < steps.size(); k += scans.every) EXPECT_TRUE(scans.kept[k]) << k;
  EXPECT_FALSE(scans.kept[1]);
  EXPECT_LE(keptOf(scans), KeptScans::kMost);
  EXPECT_GT(keptOf(scans), KeptScans::kMost / 2);
}

TEST(KeptScans, AreBoundedWhereTheVerdictChangesAtEveryStep)
{
  std::vector<StepRecord> steps = unsureSteps(20011);
  for (std::size_t k = 1; k < steps.size(); k += 2) steps[k].belief.verdict = Verdict::not_here;
  steps[10007].belief.verdict = Verdict::localized;
  const KeptScans scans = keptScans(steps);
  EXPECT_LE(keptOf(scans), KeptScans::kMost);
  EXPECT_TRUE(scans.kept[10007]) << "the first that is localized";
}
