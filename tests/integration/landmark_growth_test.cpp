// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bridge/rawlog_files.h"
#include "eval/protocols/scale.h"
#include "support/landmark_log.h"

namespace sigloc
{
namespace
{
using test::TemporaryFolder;

TEST(LandmarkGrowth, VariesTheMapAroundThePlaceAndThinsTheScene)
{
  const TemporaryFolder folder;
  test::writeTwoRounds(folder.path());
  ScaleOptions options;
  options.dlr = folder.path();
  options.methods = {"signature-anchors", "jcbb"};
  options.poses = 5;
  options.local_map_steps = 10;
  const std::size_t whole = runScale(options).rows[1].map_features;
  EXPECT_GT(whole, 60U);
  EXPECT_LE(whole, test::kDiscs) << "no more than there are";
  options.map_features = {30, 60, whole};
  options.observed = {6};
  const ScaleReport report = runScale(options);
  ASSERT_EQ(report.rows.size(), 8U);
  for (std::size_t k = 0; k < 2; ++k)
  {
    const ScaleRow* rows = &report.rows[4 * k];
    EXPECT_EQ(rows[0].map_features, 30U);
    EXPECT_EQ(rows[1].map_features, 60U);
    EXPECT_EQ(rows[2].map_features, whole);
    EXPECT_EQ(rows[3].map_features, whole);
    EXPECT_DOUBLE_EQ(rows[3].observed, 6);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_EQ(share(&Outcome::right)(rows[i]).count, 5U)
          << rows[i].method << " in " << rows[i].map_features;
      EXPECT_GT(rows[i].observed, 8);
    }
    EXPECT_LT(rows[0].operations(), rows[2].operations());
  }
}

TEST(LandmarkGrowth, RefusesSizesThatTheLogDoesNotHave)
{
  const TemporaryFolder folder;
  test::writeTwoRounds(folder.path());
  ScaleOptions options;
  options.dlr = folder.path();
  options.methods = {"jcbb"};
  options.poses = 2;
  options.local_map_steps = 10;
  const std::size_t whole = runScale(options).rows.back().map_features;
  options.map_features = {whole + 1};
  EXPECT_THROW(runScale(options), std::invalid_argument);
  options.map_features = {whole};
  options.observed = {test::kDiscs};
  EXPECT_THROW(runScale(options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
