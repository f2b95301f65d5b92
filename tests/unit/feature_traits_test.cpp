// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "sigloc/features/Feature.h"

namespace sigloc
{
TEST(FeatureTraits, NameEachTypeOnce)
{
  std::set<std::string> names;
  for (const FeatureTraits& traits : kFeatureTraits)
  {
    EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_TRUE(names.insert(traits.plural).second) << traits.plural;
  }
  EXPECT_EQ(names.count(""), 0U);
}

TEST(FeatureTraits, SayWhatTheSizeIsWhereThereIsOne)
{
  for (const FeatureTraits& traits : kFeatureTraits)
  {
    EXPECT_EQ(hasSize(traits.type), !std::string(traits.size_name).empty()) << traits.name;
  }
}

TEST(FeatureTraits, GiveTheGeometryOfEachType)
{
  EXPECT_FALSE(hasDirection(FeatureType::point));
  EXPECT_TRUE(hasDirection(FeatureType::circle));
  EXPECT_FALSE(hasBearing(FeatureType::circle));
  EXPECT_TRUE(isRound(FeatureType::circle));
  EXPECT_TRUE(hasBearing(FeatureType::corner));
  EXPECT_TRUE(hasBearing(FeatureType::wall_end));
  EXPECT_FALSE(hasBearing(FeatureType::segment));
  for (const FeatureTraits& traits : kFeatureTraits)
  {
    EXPECT_EQ(isSegment(traits.type), traits.type == FeatureType::segment) << traits.name;
    EXPECT_NE(isSegment(traits.type), isPointLike(traits.type)) << traits.name;
  }
}
}  // namespace sigloc
