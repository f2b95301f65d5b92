// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pthread.h>

#include <cmath>
#include <functional>

#include "sigloc/features/observe_scans.h"

namespace sigloc
{
namespace
{
/// Calls `work` in a thread with a stack of 256 kB.
void onSmallStack(const std::function<void()>& work)
{
  pthread_attr_t small;
  ASSERT_EQ(pthread_attr_init(&small), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&small, std::size_t{256} * 1024), 0);
  pthread_t thread = {};
  const auto run = [](void* call) -> void*
  {
    (*static_cast<const std::function<void()>*>(call))();
    return nullptr;
  };
  std::function<void()> call = work;
  ASSERT_EQ(pthread_create(&thread, &small, run, &call), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&small);
}

// A wall that grows a tooth at every second return splits once for each.
TEST(ObserveScans, AZigzagOfManyReturnsTakesNoStack)
{
  constexpr std::size_t kBeams = 8000;
  LaserScan scan;
  scan.first_angle = M_PI / 6;
  scan.angle_step = 2 * M_PI / 3 / kBeams;
  scan.max_range = 30;
  for (std::size_t k = 0; k < kBeams; ++k)
  {
    const double growth = 0.03 * static_cast<double>(k) / kBeams;
    const double away = k % 2 == 0 ? 3.0 : 3.06 + growth;  // [m]
    const double angle = scan.first_angle + static_cast<double>(k) * scan.angle_step;
    scan.ranges.push_back(static_cast<float>(away / std::sin(angle)));
    scan.valid.push_back(1);
  }
  std::size_t returns = 0;
  onSmallStack([&] { returns = observeScene({scan}).beams.size(); });
  EXPECT_EQ(returns, kBeams);
}
}  // namespace
}  // namespace sigloc
