// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/BestFirst.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace sigloc
{
namespace
{
TEST(BestFirst, TakesAllByScoreThenAsTheyCame)
{
  std::mt19937_64 random(33);
  for (const std::uint32_t near : {0U, 3U, 500U, CoarseScore::kMost})
  {
    for (const std::size_t count : {1U, 2U, 700U})
    {
      std::uniform_int_distribution<std::uint32_t> score(0, count > 2 ? 40 : 6000);
      std::vector<CoarseScore> scores;
      for (std::uint32_t k = 0; k < count; ++k) scores.push_back({score(random), k});
      BestFirst order(scores, near);
      std::stable_sort(scores.begin(), scores.end(),
                       [](const CoarseScore& a, const CoarseScore& b)
                       { return a.score > b.score; });
      for (const CoarseScore& next : scores)
      {
        ASSERT_FALSE(order.empty());
        EXPECT_EQ(order.bestScore(), next.score);
        EXPECT_EQ(order.take(), next.index);
      }
      EXPECT_TRUE(order.empty());
    }
  }
  EXPECT_TRUE(BestFirst({}, 10).empty());
}
}  // namespace
}  // namespace sigloc
