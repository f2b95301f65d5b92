// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <limits>
#include <variant>

#include "bridge/rawlog_files.h"
#include "sigloc/io/map_files.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
/// The warning of a simplemap of two key frames, the second one at `pose`.
std::string warningWith(const mrpt::poses::CPose3D& pose)
{
  const TemporaryFolder folder;
  mrpt::maps::CSimpleMap map;
  for (const mrpt::poses::CPose3D& place : {mrpt::poses::CPose3D(), pose})
  {
    const auto pdf = mrpt::poses::CPose3DPDFGaussian::Create();
    pdf->mean = place;
    map.insert(pdf, makeFrame(makeScan(1)));
  }
  EXPECT_TRUE(map.saveToFile((folder / "m.simplemap").string()));
  return warningOfMapSource(folder / "m.simplemap");
}
}  // namespace

TEST(MapWarnings, TellOfKeyFramesThatAreNotUsedAsTheyAre)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(warningWith({1, 2, 0.2, 0, 0, 0}), "");
  EXPECT_NE(warningWith({nan, 2, 0, 0, 0, 0}).find("1 key frame left out"), std::string::npos);
  EXPECT_NE(warningWith({1, 2, 3, 0, 0, 0}).find("heights"), std::string::npos);
}

TEST(MapWarnings, SayNothingOfOtherSources)
{
  const TemporaryFolder folder;
  writeText(folder / "trees.csv", "1 2\n");
  EXPECT_EQ(warningOfMapSource(folder / "trees.csv"), "");
}

TEST(LandmarkFile, MayBeginWithTheMarkOfUtf8)
{
  const TemporaryFolder folder;
  writeText(folder / "trees.csv", "\xEF\xBB\xBFx,y\n1,2\n");
  writeText(folder / "bare.csv",
            "\xEF\xBB\xBF"
            "3,4\n");
  for (const auto& [name, x] : {std::pair{"trees.csv", 1.0}, std::pair{"bare.csv", 3.0}})
  {
    const MapSource source = readMapSource(folder / name);
    const auto& map = std::get<FeatureMap>(source);
    ASSERT_EQ(map.features().size(), 1U);
    EXPECT_EQ(map.features()[0].position.x, x);
  }
}
