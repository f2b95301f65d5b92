// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "bridge/room_map.h"
#include "eval/wakeup/wakeup.h"

namespace sigloc
{
namespace
{
constexpr int kFrames = 40;
constexpr std::size_t kDriven = 16;  // of them, the 40 % that are not mapped

/// A drive through a room and back, 0.2 m a second: its key frames, its log and its truth.
class TrackFrames : public testing::TestWithParam<bool>
{
 protected:
  void SetUp() override
  {
    auto frames = std::make_shared<mrpt::maps::CSimpleMap>();
    std::vector<mrpt::serialization::CSerializable::Ptr> log;
    std::string truth;
    for (int k = 0; k < kFrames; ++k)
    {
      const double x = 0.2 * std::min(k, kFrames - 1 - k) - 2;
      const double time = 100.5 + k;
      const auto scan = test::roomScan({x, 0, 0}, time);
      auto frame = mrpt::obs::CSensoryFrame::Create();
      frame->insert(scan);
      auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
      pose->mean = mrpt::poses::CPose3D(x, 0, 0);
      frames->insert(pose, frame);
      log.push_back(scan);
      truth += std::to_string(time) + " " + std::to_string(x) + " 0 0\n";
    }
    test::writeObjects(folder_ / "frames.simplemap", {frames});
    test::writeObjects(folder_ / "log.rawlog", log);
    test::writeText(folder_ / "truth.txt", truth);
    options_.frames = folder_ / "frames.simplemap";
    options_.methods = {"signature"};
    options_.apart = true;
    options_.travel = 1.35;
    options_.reversed = GetParam();
  }

  /// Two drives of seven steps each fit into what is not mapped.
  void expectTwoDrives() const
  {
    const auto runs = runWakeups(options_).methods.front().runs;
    ASSERT_EQ(runs.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k)
    {
      EXPECT_EQ(runs[k].start, 7 * k);
      EXPECT_EQ(runs[k].steps.size(), 7U);
      EXPECT_LT(runs[k].steps.back().step, kDriven);
      EXPECT_TRUE(runs[k].steps.front().mapped);
      EXPECT_EQ(runs[k].wrong_steps, 0U);
      EXPECT_NEAR(runs[k].steps.back().seconds, 6, 1e-6);
      EXPECT_FALSE(std::isnan(runs[k].steps.back().error.distance));
    }
  }

  test::TemporaryFolder folder_;
  WakeupOptions options_;
};
INSTANTIATE_TEST_SUITE_P(Ways, TrackFrames, testing::Bool(),
                         [](const auto& way) { return way.param ? "Reversed" : "Forward"; });

TEST_P(TrackFrames, APartIsTheMapAndTheRestTheDrive)
{
  expectTwoDrives();
  options_.methods = {"mcl"};
  EXPECT_THROW(runWakeups(options_), std::invalid_argument) << "MRPT's filter needs a log";
}

TEST_P(TrackFrames, WhatALogHoldsOfTheMapsTimeIsNoDrive)
{
  options_.rawlog = folder_ / "log.rawlog";
  options_.ground_truth = folder_ / "truth.txt";
  expectTwoDrives();
}
}  // namespace
}  // namespace sigloc
