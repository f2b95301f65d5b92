// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/area_growth.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sigloc
{
namespace
{
TEST(AreaGrowth, HasARowForEachCountOfBuildings)
{
  ScaleOptions options;
  options.methods = {"signature"};
  options.buildings = {1, 2};
  options.poses = 12;
  options.seed = 3;
  const ScaleReport report = runScale(options);
  ASSERT_EQ(report.rows.size(), 2U);
  EXPECT_EQ(report.map.maps, 2U);
  for (std::size_t k = 0; k < 2; ++k)
  {
    const ScaleRow& row = report.rows[k];
    EXPECT_DOUBLE_EQ(row.area, 720.0 * static_cast<double>(k + 1));
    EXPECT_EQ(row.records.size(), 12U);
    EXPECT_GE(share(&Outcome::right)(row).count, 10U);
    EXPECT_GT(row.map_seconds, 0);
    EXPECT_GT(row.bytes_per_m2, 500);
    EXPECT_LT(row.bytes_per_m2, 8000);
  }
  EXPECT_GT(report.rows[1].map_features, 1.5 * static_cast<double>(report.rows[0].map_features));
  const std::string table = scaleTable(report);
  EXPECT_NE(table.find("| 1440"), std::string::npos) << table;
}

TEST(AreaGrowth, RefusesWhatIsNoMethodOfRelocation)
{
  ScaleOptions options;
  options.buildings = {1};
  options.methods = {"signature-none"};
  EXPECT_THROW(runScale(options), std::invalid_argument);
}
}  // namespace
}  // namespace sigloc
