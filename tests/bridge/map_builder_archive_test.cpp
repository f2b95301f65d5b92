// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/map_builder_archive.h"

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>

#include <string>

#include "support/wall_piece.h"

using namespace sigloc;

namespace
{
MergedWall wallAlongX(double from, double to)
{
  WallMerger merger({});
  merger.add(test::wallPiece(from, to, 0, true), 1);
  MergedWall wall = merger.walls().front();
  wall.sightings = 2;
  return wall;
}

/// Why a builder with these walls is not read again; empty where it is.
std::string refusalOf(const std::vector<MergedWall>& walls)
{
  MapBuilder builder(MapBuildingOptions{}, nullptr);
  builder.restore(FeatureMerger({}, walls, {}), builder.counts());
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  detail::writeMapBuilder(builder, archive);
  stream.Seek(0);
  try
  {
    detail::readMapBuilder(archive, nullptr);
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  return {};
}
}  // namespace

TEST(MapBuilderArchive, WallsWhoseSumsCannotBeTheirsAreRefused)
{
  const MergedWall good = wallAlongX(0, 4);
  EXPECT_EQ(refusalOf({good}), "");
  MergedWall weightless = good;
  weightless.weight = 0;
  EXPECT_NE(refusalOf({weightless}).find("impossible sums"), std::string::npos);
  MergedWall displaced = good;
  displaced.weighted_sum.x += 100 * displaced.weight;
  EXPECT_NE(refusalOf({displaced}).find("another place"), std::string::npos);
}

TEST(MapBuilderArchive, WallsThatMergeToOneBeyondAllBoundsAreRefused)
{
  const MergedWall first = wallAlongX(-19000, 0);
  const MergedWall second = wallAlongX(0, 19000);
  EXPECT_EQ(refusalOf({first}), "");
  EXPECT_EQ(refusalOf({second}), "");
  EXPECT_NE(refusalOf({first, second}), "");
}
