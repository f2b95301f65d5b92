// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/slam/SignatureAligner.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPose3DPDFSOG.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/slam/CICP.h>

#include <cmath>
#include <stdexcept>

#include "sigloc/plugin/SignatureMap.h"
#include "support/simulated_office.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;
using mrpt::poses::CPosePDFGaussian;
using mrpt::poses::CPosePDFSOG;
using mrpt::slam::CMetricMapsAlignmentAlgorithm;

namespace
{
const MappedWorld& alignedOffice()
{
  static const MappedWorld world(makeWorld(WorldKind::office, {}, 11), 11);
  return world;
}

mrpt::maps::CSimplePointsMap pointsOf(const LaserScan& scan)
{
  mrpt::maps::CSimplePointsMap points;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
  {
    if (scan.valid[i] == 0) continue;
    const double angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    const double range = static_cast<double>(scan.ranges[i]);
    const auto p = scan.robot_from_sensor.composePoint(
        mrpt::math::TPoint2D(range * std::cos(angle), range * std::sin(angle)));
    points.insertPoint(static_cast<float>(p.x), static_cast<float>(p.y));
  }
  return points;
}

/// A map of the scan around the robot, with the robot at the origin.
SignatureMap localMapOf(const LaserScan& scan)
{
  MapBuildingOptions options;
  options.min_sightings = 1;
  return SignatureMap(buildMapFromScans({{TPose2D(0, 0, 0), {scan}}}, options));
}

mrpt::maps::COccupancyGridMap2D gridOf(const DenseField& field)
{
  const RasterFrame& frame = field.frame;
  mrpt::maps::COccupancyGridMap2D grid(
      static_cast<float>(frame.origin.x),
      static_cast<float>(frame.origin.x + frame.resolution * frame.width),
      static_cast<float>(frame.origin.y),
      static_cast<float>(frame.origin.y + frame.resolution * frame.height),
      static_cast<float>(frame.resolution));
  for (std::uint32_t y = 0; y < frame.height; ++y)
  {
    for (std::uint32_t x = 0; x < frame.width; ++x)
    {
      const CellState state = field.cells[std::size_t{y} * frame.width + x].state();
      const float free = isWall(state) ? 0.0F : state == CellState::free ? 1.0F : 0.5F;
      grid.setCell(static_cast<int>(x), static_cast<int>(y), free);
    }
  }
  return grid;
}

bool isNear(const CPose2D& pose, const TPose2D& truth, double distance = 0.3)
{
  return std::hypot(pose.x() - truth.x, pose.y() - truth.y) < distance &&
         std::abs(mrpt::math::wrapToPi(pose.phi() - truth.phi)) < 0.1;
}

CPosePDFSOG align(CMetricMapsAlignmentAlgorithm& algorithm, const mrpt::maps::CMetricMap& m1,
                  const mrpt::maps::CMetricMap& m2, const CPose2D& guess = {})
{
  const auto pdf = algorithm.AlignPDF(&m1, &m2, CPosePDFGaussian(guess));
  const auto sum = std::dynamic_pointer_cast<CPosePDFSOG>(pdf);
  EXPECT_TRUE(sum);
  return sum ? *sum : CPosePDFSOG(0);
}

std::string refusal(const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2)
{
  SignatureAligner aligner;
  try
  {
    aligner.AlignPDF(m1, m2, CPosePDFGaussian());
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}
}  // namespace

TEST(SignatureAligner, FindsPosesFarFromTheGuessWhereIcpDoesNot)
{
  const SignatureMap map(*alignedOffice().map());
  SignatureAligner by_signatures;
  mrpt::slam::CICP by_icp;
  by_icp.options.maxIterations = 100;
  Random random(20261, 0);
  int found = 0;
  int found_by_icp = 0;
  constexpr int kPoses = 12;
  for (int i = 0; i < kPoses; ++i)
  {
    const TPose2D truth = alignedOffice().randomPose(random);
    const auto seen = pointsOf(alignedOffice().scan(truth, random));
    const auto right_after = [&](CMetricMapsAlignmentAlgorithm& algorithm)
    {
      const auto pdf = algorithm.AlignPDF(&map, &seen, CPosePDFGaussian());
      if (const auto sum = std::dynamic_pointer_cast<CPosePDFSOG>(pdf))
      {
        return sum->size() > 0 && isNear(CPose2D((*sum)[0].mean), truth);
      }
      return isNear(CPose2D(pdf->getMeanVal()), truth);
    };
    found += right_after(by_signatures);
    found_by_icp += right_after(by_icp);
  }
  EXPECT_GE(found, kPoses - 1);
  EXPECT_LE(found_by_icp, 2);
}

TEST(SignatureAligner, TellsEveryHypothesis)
{
  const SignatureMap map(*alignedOffice().map());
  Random random(20262, 0);
  const auto seen = pointsOf(alignedOffice().scan(alignedOffice().randomPose(random), random));
  SignatureAligner aligner;
  CMetricMapsAlignmentAlgorithm& algorithm = aligner;
  SignatureAligner::TReturnInfo info;
  const auto pdf = algorithm.AlignPDF(&map, &seen, CPosePDFGaussian(), info);
  const auto sum = std::dynamic_pointer_cast<CPosePDFSOG>(pdf);
  ASSERT_TRUE(sum);
  const auto& candidates = info.relocation.candidates;
  ASSERT_EQ(sum->size(), candidates.size());
  ASSERT_FALSE(candidates.empty());
  EXPECT_GT(info.executionTime, 0.0);
  double weights = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const auto& mode = (*sum)[i];
    EXPECT_EQ(mode.mean.x(), candidates[i].pose.mean.x);
    EXPECT_EQ(mode.cov, candidates[i].pose.covariance);
    weights += std::exp(mode.log_w);
    EXPECT_NEAR(std::exp(mode.log_w) * candidates[0].probability,
                std::exp((*sum)[0].log_w) * candidates[i].probability, 1e-12);
  }
  EXPECT_NEAR(weights, 1.0, 1e-9);

  const auto in_space = algorithm.Align3DPDF(&map, &seen, mrpt::poses::CPose3DPDFGaussian());
  const auto sum_in_space = std::dynamic_pointer_cast<mrpt::poses::CPose3DPDFSOG>(in_space);
  ASSERT_TRUE(sum_in_space);
  ASSERT_EQ(sum_in_space->size(), candidates.size());
  const auto& first = sum_in_space->begin()->val;
  EXPECT_NEAR(first.mean.x(), candidates[0].pose.mean.x, 1e-9);
  EXPECT_NEAR(first.mean.yaw(), candidates[0].pose.mean.phi, 1e-9);
  EXPECT_EQ(first.mean.z(), 0.0);
  EXPECT_NEAR(first.cov(0, 0), candidates[0].pose.covariance(0, 0), 1e-12);
  EXPECT_NEAR(first.cov(3, 3), candidates[0].pose.covariance(2, 2), 1e-12);
}

TEST(SignatureAligner, TakesTheMapsThatItNames)
{
  Random random(20263, 0);
  const TPose2D truth = alignedOffice().randomPose(random);
  const LaserScan scan = alignedOffice().scan(truth, random);
  const auto points = pointsOf(scan);
  const SignatureMap map(*alignedOffice().map());
  const auto grid = gridOf(*alignedOffice().map()->field());
  mrpt::maps::CMultiMetricMap several;
  several.maps.push_back(mrpt::maps::COccupancyGridMap2D::Create());
  several.maps.push_back(std::make_shared<SignatureMap>(map));
  mrpt::maps::CMultiMetricMap local_view;
  local_view.maps.push_back(std::make_shared<mrpt::maps::CSimplePointsMap>(points));
  const SignatureMap local_map = localMapOf(scan);

  SignatureAligner aligner;
  using Maps = std::pair<const mrpt::maps::CMetricMap*, const mrpt::maps::CMetricMap*>;
  for (const auto& [m1, m2] : {Maps(&map, &points), Maps(&grid, &points), Maps(&several, &points),
                               Maps(&map, &local_view), Maps(&map, &local_map)})
  {
    const CPosePDFSOG sum = align(aligner, *m1, *m2);
    ASSERT_GT(sum.size(), 0U);
    EXPECT_TRUE(isNear(CPose2D(sum[0].mean), truth))
        << m1->GetRuntimeClass()->className << ", " << m2->GetRuntimeClass()->className;
  }
  EXPECT_NE(refusal(&points, &points).find("m1 is "), std::string::npos);
  EXPECT_NE(refusal(&map, &grid).find("m2 is "), std::string::npos);
  EXPECT_NE(refusal(nullptr, &points).find("m1 is null"), std::string::npos);
  EXPECT_NE(refusal(&map, nullptr).find("m2 is null"), std::string::npos);
}

TEST(SignatureAligner, KeepsToTheSearchLimits)
{
  Random random(20264, 0);
  const TPose2D truth = alignedOffice().randomPose(random);
  const auto seen = pointsOf(alignedOffice().scan(truth, random));
  const SignatureMap map(*alignedOffice().map());
  SignatureAligner aligner;
  aligner.search_limits = {2.0, 0.5};
  const CPosePDFSOG near = align(aligner, map, seen, CPose2D(truth) + CPose2D(0.5, 0.5, 0.2));
  ASSERT_GT(near.size(), 0U);
  EXPECT_TRUE(isNear(CPose2D(near[0].mean), truth));
  const CPosePDFSOG elsewhere = align(aligner, map, seen, CPose2D(truth.x + 9, truth.y, truth.phi));
  for (const auto& mode : elsewhere) EXPECT_FALSE(isNear(CPose2D(mode.mean), truth));
}

TEST(SignatureAligner, FollowsAMapThatGrows)
{
  Random random(20265, 0);
  const TPose2D truth = alignedOffice().randomPose(random);
  const auto seen = pointsOf(alignedOffice().scan(truth, random));
  SignatureAligner aligner;
  EXPECT_EQ(align(aligner, SignatureMap(), seen).size(), 0U);
  EXPECT_GT(align(aligner, SignatureMap(*alignedOffice().map()), seen).size(), 0U);
  EXPECT_EQ(
      align(aligner, SignatureMap(*alignedOffice().map()), mrpt::maps::CSimplePointsMap()).size(),
      0U);
}
