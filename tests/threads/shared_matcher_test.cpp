// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// One matcher for many threads: none disturbs another, and all get the same bits.
// scripts/test_sanitized runs this under the thread sanitizer.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "fuzz/small_room.h"
#include "sigloc/features/observe_scans.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kThreads = 6;

std::vector<ObservedScene> scenesOfDrive()
{
  std::vector<ObservedScene> scenes;
  for (const double x : {-3.0, -2.7, -2.4, -2.1, -1.8})
  {
    scenes.push_back(observeScene({fuzz::scanInRoom({x, -1, 0.3})}));
  }
  return scenes;
}

void append(std::string& bytes, double value)
{
  char raw[sizeof(value)];
  std::memcpy(raw, &value, sizeof(value));
  bytes.append(raw, sizeof(value));
}

void append(std::string& bytes, const GaussianPose& pose)
{
  for (const double value : {pose.mean.x, pose.mean.y, pose.mean.phi}) append(bytes, value);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column) append(bytes, pose.covariance(row, column));
  }
}

std::string answers(const SignatureMatcher& matcher, const std::vector<ObservedScene>& scenes)
{
  std::string bytes;
  for (const ObservedScene& scene : scenes)
  {
    const RelocationResult result = matcher.localize(scene);
    append(bytes, result.probability);
    for (const Candidate& candidate : result.candidates)
    {
      append(bytes, candidate.pose);
      append(bytes, candidate.probability);
    }
  }
  return bytes;
}

std::string beliefs(const std::shared_ptr<const SignatureMatcher>& matcher,
                    const std::vector<ObservedScene>& scenes)
{
  std::string bytes;
  HypothesisTracker tracker(matcher);
  for (const ObservedScene& scene : scenes)
  {
    MotionIncrement motion;
    motion.mean = {0.3, 0, 0};
    for (int k = 0; k < 3; ++k) motion.covariance(k, k) = 1e-4;
    for (const auto& hypothesis : tracker.step(motion, scene).hypotheses)
    {
      append(bytes, hypothesis.pose);
      append(bytes, hypothesis.weight);
    }
  }
  return bytes;
}

/// What each of many threads makes of the same work, begun at about the same time.
template <class Work>
std::vector<std::string> inThreads(Work&& work)
{
  std::vector<std::string> results(kThreads);
  std::vector<std::thread> threads;
  threads.reserve(kThreads);
  for (std::string& result : results) threads.emplace_back([&] { result = work(); });
  for (std::thread& thread : threads) thread.join();
  return results;
}

class SharedMatcher : public ::testing::TestWithParam<GenerationMode>
{
 protected:
  std::shared_ptr<const SignatureMatcher> matcher() const
  {
    MatcherOptions options;
    options.mode = static_cast<std::uint32_t>(GetParam());
    return std::make_shared<const SignatureMatcher>(fuzz::smallRoom(), options);
  }
};

TEST_P(SharedMatcher, AnswersAllThreadsAlike)
{
  const auto shared = matcher();
  const auto scenes = scenesOfDrive();
  const std::string alone = answers(*shared, scenes);
  EXPECT_GT(alone.size(), scenes.size() * sizeof(double)) << "or no pose was found";
  for (const auto& result : inThreads([&] { return answers(*shared, scenes); }))
  {
    EXPECT_TRUE(result == alone);
  }
}

TEST_P(SharedMatcher, ServesATrackerInEachThread)
{
  const auto shared = matcher();
  const auto scenes = scenesOfDrive();
  const std::string alone = beliefs(shared, scenes);
  EXPECT_FALSE(alone.empty()) << "or no pose was found";
  for (const auto& result : inThreads([&] { return beliefs(shared, scenes); }))
  {
    EXPECT_TRUE(result == alone);
  }
}

INSTANTIATE_TEST_SUITE_P(InMode, SharedMatcher,
                         ::testing::Values(GenerationMode::automatic, GenerationMode::pairs,
                                           GenerationMode::minimal_sets),
                         [](const auto& mode)
                         { return std::to_string(static_cast<int>(mode.param)); });
}  // namespace
}  // namespace sigloc
