// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "sigloc/map/FeatureMap.h"

namespace sigloc::test
{
/// One feature of each type that the golden files hold, no two numbers alike.
inline std::vector<Feature> sampleFeatures()
{
  std::vector<Feature> features;
  for (std::uint8_t type = 0; type <= static_cast<std::uint8_t>(FeatureType::wall_end); ++type)
  {
    Feature feature;
    feature.type = static_cast<FeatureType>(type);
    feature.side = type % 2 == 0 ? WallSide::start : WallSide::end;
    feature.start_seen = type % 2 == 1;
    feature.end_seen = type % 3 == 1;
    feature.position = {1.0 + 0.1 * type, 2.0 / 3.0 + type};
    feature.direction = -1.5 + 0.37 * type;
    feature.size = 0.4 + 0.21 * type;
    feature.position_covariance(0, 0) = 0.01 + 0.001 * type;
    feature.position_covariance(1, 1) = 0.02;
    feature.position_covariance(0, 1) = feature.position_covariance(1, 0) = 0.003;
    feature.direction_variance = 1e-4 * (type + 1);
    feature.size_variance = 1e-3 / (type + 1);
    feature.label = type - 1;
    feature.sightings = 3U + type;
    feature.parent = type == 3 ? 1 : -1;
    features.push_back(feature);
  }
  return features;
}

/// A walled room of the given size [cells] with a few features and its dense field.
inline FeatureMap sampleMap(std::uint32_t width, std::uint32_t height)
{
  OccupancyRaster raster;
  raster.frame = {{-1.0 / 3.0, 0.7}, 0.05, width, height};
  for (std::uint32_t y = 0; y < height; ++y)
  {
    for (std::uint32_t x = 0; x < width; ++x)
    {
      const bool border = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
      const CellState inside = x * y % 97 == 13 ? CellState::unknown : CellState::free;
      raster.cells.push_back(border ? CellState::wall : inside);
    }
  }
  return FeatureMap(sampleFeatures(), buildDenseField(raster), {0.03, 0.004, 0.2},
                    {"some/where.gridmap", "0123", "4567"});
}

inline void expectSameFeature(const Feature& a, const Feature& b)
{
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.start_seen, b.start_seen);
  EXPECT_EQ(a.end_seen, b.end_seen);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.position_covariance, b.position_covariance);
  EXPECT_EQ(a.direction_variance, b.direction_variance);
  EXPECT_EQ(a.size_variance, b.size_variance);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.sightings, b.sightings);
  EXPECT_EQ(a.parent, b.parent);
}

inline void expectSameField(const DenseField& a, const DenseField& b)
{
  EXPECT_EQ(a.frame.origin, b.frame.origin);
  EXPECT_EQ(a.frame.resolution, b.frame.resolution);
  EXPECT_EQ(a.frame.width, b.frame.width);
  EXPECT_EQ(a.frame.height, b.frame.height);
  EXPECT_EQ(a.free_area, b.free_area);
  EXPECT_EQ(a.wall_cells, b.wall_cells);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.cells.size(); ++i)
  {
    const DenseCell& p = a.cells[i];
    const DenseCell& q = b.cells[i];
    const bool same = p.code() == q.code() && p.dx == q.dx && p.dy == q.dy;
    if (!same) ++different;
  }
  EXPECT_EQ(different, 0U);
}

inline void expectSameMap(const FeatureMap& a, const FeatureMap& b)
{
  ASSERT_EQ(a.features().size(), b.features().size());
  for (std::size_t i = 0; i < a.features().size(); ++i)
  {
    expectSameFeature(a.features()[i], b.features()[i]);
    EXPECT_EQ(a.lineOf(i), b.lineOf(i));
  }
  EXPECT_EQ(a.lines().size(), b.lines().size());
  EXPECT_EQ(a.error().relative_constant, b.error().relative_constant);
  EXPECT_EQ(a.error().relative_slope, b.error().relative_slope);
  EXPECT_EQ(a.error().common_sigma, b.error().common_sigma);
  EXPECT_EQ(a.error().common_turn_sigma, b.error().common_turn_sigma);
  EXPECT_EQ(a.provenance().source_path, b.provenance().source_path);
  EXPECT_EQ(a.provenance().source_checksum, b.provenance().source_checksum);
  EXPECT_EQ(a.provenance().options_digest, b.provenance().options_digest);
  ASSERT_EQ(a.field().has_value(), b.field().has_value());
  if (a.field()) expectSameField(*a.field(), *b.field());
}
}  // namespace sigloc::test
