// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/sampling.h"

#include <gtest/gtest.h>

#include <limits>

namespace sigloc
{
namespace
{
// Built by the sanitizers, a conversion that does not fit fails these.
TEST(Sampling, DrawsFitTheirTypeForEveryShare)
{
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(drawsNeeded(0.01, 1), 1U);
  EXPECT_EQ(drawsNeeded(0.01, 0), kMost);
  EXPECT_EQ(drawsNeeded(0.01, 1e-12), kMost);
  EXPECT_EQ(drawsNeeded(0.01, std::numeric_limits<double>::denorm_min()), kMost);
  std::uint32_t last = kMost;
  for (double success = 1e-15; success < 1; success *= 2)
  {
    const std::uint32_t draws = drawsNeeded(0.01, success);
    EXPECT_LE(draws, last) << success;
    last = draws;
  }
}

TEST(Sampling, CountsTheSetsAmongMany)
{
  EXPECT_EQ(combinations(5, 2), 10);
  EXPECT_EQ(combinations(2, 3), 0);
  // More than 32 bits hold: five of a thousand landmarks.
  EXPECT_NEAR(combinations(1000, 5), 8.250291250200e12, 1);
}
}  // namespace
}  // namespace sigloc
