// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "map/NearestFeature.h"
#include "sigloc/map/sensor_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace sigloc;
using mrpt::math::TPoint2D;

namespace
{
/// A single wall cell at (1.05, 1.05) in a free square of 2 m.
DenseField oneWallCell()
{
  OccupancyRaster raster;
  raster.frame = {{0, 0}, 0.1, 20, 20};
  raster.cells.assign(400, CellState::free);
  raster.cells[10 * 20 + 10] = CellState::wall;
  return buildDenseField(raster);
}
}  // namespace

TEST(PointLikelihood, IsTheMixtureOfGaussianAndOutlier)
{
  PointLikelihoodOptions options;
  options.sigma = 0.2;
  options.outlier_share = 0.1;
  const DenseField field = oneWallCell();
  const auto of = [&](const TPoint2D& point) { return logLikelihood(field, {point}, {}, options); };
  EXPECT_NEAR(of({1.05, 1.05}), std::log(0.9 + 0.1), 1e-9);
  EXPECT_NEAR(of({1.25, 1.05}), std::log(0.9 * std::exp(-0.5) + 0.1), 0.02);
  EXPECT_NEAR(of({100, 1}), std::log(0.1), 1e-9) << "off the map";
  EXPECT_NEAR(of({std::numeric_limits<double>::quiet_NaN(), 1}), std::log(0.1), 1e-9);
  options.exponent = 0.5;
  EXPECT_NEAR(of({100, 1}), 0.5 * std::log(0.1), 1e-9);
}

TEST(PointLikelihood, AddsUpOverPointsAndMovesWithThePose)
{
  const DenseField field = oneWallCell();
  const TPoint2D ahead(0.5, 0);
  const double one = logLikelihood(field, {ahead}, {1.05, 0.55, M_PI / 2});
  EXPECT_NEAR(one, 0.0, 1e-3);
  EXPECT_NEAR(logLikelihood(field, {ahead, {50, 0}}, {1.05, 0.55, M_PI / 2}),
              one + std::log(PointLikelihoodOptions{}.outlier_share), 1e-9);
  EXPECT_EQ(logLikelihood(field, {}, {1, 1, 0}), 0.0);
}

TEST(PointLikelihood, MeasuresDistanceToFeatures)
{
  Feature tree;
  tree.type = FeatureType::circle;
  tree.position = {3, 0};
  tree.size = 0.5;
  const NearestFeature nearest({tree});
  EXPECT_NEAR(logLikelihood(nearest, {{2.5, 0}}, {}), 0.0, 1e-9);
  EXPECT_LT(logLikelihood(nearest, {{2.2, 0}}, {}), -0.5);
}

TEST(PointLikelihood, ThinsEvenly)
{
  std::vector<TPoint2D> points;
  points.reserve(100);
  for (int i = 0; i < 100; ++i) points.emplace_back(i, 0);
  const auto chosen = thinned(points, 10);
  ASSERT_EQ(chosen.size(), 10U);
  for (std::size_t i = 1; i < chosen.size(); ++i)
  {
    EXPECT_EQ(chosen[i].x - chosen[i - 1].x, 10.0);
  }
  EXPECT_EQ(thinned(points, 1000).size(), points.size());
}
