// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sigloc/eval/TrackingMethod.h"

namespace sigloc
{
namespace
{
using mrpt::maps::COccupancyGridMap2D;
using mrpt::obs::CActionRobotMovement2D;

struct MonteCarloSettings
{
  std::size_t particles = 40000;  ///< at the start
  bool adaptive = true;
  std::uint32_t kld_minimum = 150;
  std::uint32_t kld_maximum = 40000;
  double motion_sigma = 0.10;  ///< [m], least, a step
  double motion_angle_deg = 2.0;  ///< least, a step
  std::optional<PoseRegion> region;
};

// pf-localization's shipped likelihood, at the shipped decimation.
COccupancyGridMap2D::Ptr gridOf(const OccupancyRaster& raster)
{
  auto grid = COccupancyGridMap2D::Create();
  const RasterFrame& frame = raster.frame;
  const auto at = [](double origin, double cells, double resolution)
  { return static_cast<float>(origin + cells * resolution); };
  grid->setSize(at(frame.origin.x, 0, 1), at(frame.origin.x, frame.width, frame.resolution),
                at(frame.origin.y, 0, 1), at(frame.origin.y, frame.height, frame.resolution),
                static_cast<float>(frame.resolution));
  const auto width = static_cast<int>(frame.width);
  for (int y = 0; y < static_cast<int>(frame.height); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const CellState state =
          raster.cells[static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x)];
      const float free = state == CellState::free ? 0.95F : state == CellState::wall ? 0.05F : 0.5F;
      grid->setCell(x, y, free);
    }
  }
  auto& options = grid->likelihoodOptions;
  options.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
  options.LF_decimation = 20;
  options.LF_stdHit = 0.20F;
  options.LF_maxCorrsDistance = 0.30F;
  options.LF_zHit = 0.95F;
  options.LF_zRandom = 0.05F;
  options.LF_maxRange = 80.0F;
  options.LF_alternateAverageMethod = false;
  return grid;
}

class MonteCarloTracking : public TrackingMethod
{
 public:
  MonteCarloTracking(const COccupancyGridMap2D::Ptr& grid, const MonteCarloSettings& settings,
                     std::uint32_t seed)
      : settings_(settings)
  {
    // Its own randomize() would keep a Gaussian drawn before.
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(seed);
    filter_.options.metricMap = grid;
    filter_.options.KLD_params.KLD_binSize_PHI = 10 * M_PI / 180;
    filter_.options.KLD_params.KLD_binSize_XY = 0.10;
    filter_.options.KLD_params.KLD_delta = 0.01;
    filter_.options.KLD_params.KLD_epsilon = 0.01;
    filter_.options.KLD_params.KLD_minSampleSize = settings.kld_minimum;
    filter_.options.KLD_params.KLD_maxSampleSize = settings.kld_maximum;
    executor_.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    executor_.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
    executor_.m_options.adaptiveSampleSize = settings.adaptive;
    executor_.m_options.BETA = 0.5;
    constexpr double kFar = 1e9;  // [m]
    const PoseRegion everywhere{-kFar, kFar, -kFar, kFar, 0, M_PI};
    const PoseRegion region = settings.region.value_or(everywhere);
    const double turn = std::min(region.heading_tolerance, M_PI);
    filter_.resetUniformFreeSpace(grid.get(), 0.7, static_cast<int>(settings.particles),
                                  region.x_min, region.x_max, region.y_min, region.y_max,
                                  region.heading - turn, region.heading + turn);
  }

  TrackClaim step(const RawlogStep& step) override
  {
    CActionRobotMovement2D movement;
    CActionRobotMovement2D::TMotionModelOptions model;
    model.modelSelection = CActionRobotMovement2D::mmGaussian;
    model.gaussianModel.minStdXY = static_cast<float>(settings_.motion_sigma);
    model.gaussianModel.minStdPHI = static_cast<float>(settings_.motion_angle_deg * M_PI / 180);
    const auto increment = step.motion ? step.motion->mean : mrpt::math::TPose2D();
    movement.computeFromOdometry(mrpt::poses::CPose2D(increment), model);
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    executor_.executeOn(filter_, &actions, step.frame.get());

    const auto [covariance, mean] = filter_.getCovarianceAndMean();
    const bool tight = std::sqrt(covariance(0, 0) + covariance(1, 1)) < kTightDistance &&
                       std::sqrt(covariance(2, 2)) < kTightAngle;
    tight_steps_ = tight ? tight_steps_ + 1 : 0;
    return {tight_steps_ >= kTightSteps, true, mean.asTPose()};
  }

 private:
  // When MRPT's filter is taken to be sure; the same for every setting.
  static constexpr double kTightDistance = 0.5;  // [m]
  static constexpr double kTightAngle = 10 * M_PI / 180;  // [rad]
  static constexpr int kTightSteps = 5;

  MonteCarloSettings settings_;
  mrpt::slam::CMonteCarloLocalization2D filter_;
  mrpt::bayes::CParticleFilter executor_;
  int tight_steps_ = 0;
};

class MonteCarloFactory : public TrackingMethodFactory
{
 public:
  MonteCarloFactory(const OccupancyRaster& raster, const MonteCarloSettings& settings)
      : grid_(gridOf(raster)), settings_(settings)
  {
  }

  std::unique_ptr<TrackingMethod> start(std::uint32_t seed) const override
  {
    return std::make_unique<MonteCarloTracking>(grid_, settings_, seed);
  }

  bool needsOwnProcess() const override { return true; }

 private:
  COccupancyGridMap2D::Ptr grid_;
  MonteCarloSettings settings_;
};

// About 200 particles a square metre give 80-90 % success; half a million is what a robot's
// processor can bear at all.
std::size_t particlesFor(const OccupancyRaster& raster)
{
  const auto free =
      static_cast<double>(std::count(raster.cells.begin(), raster.cells.end(), CellState::free));
  const double area = free * raster.frame.resolution * raster.frame.resolution;
  return static_cast<std::size_t>(std::clamp(200 * area, 40000.0, 500000.0));
}
}  // namespace

std::unique_ptr<TrackingMethodFactory> detail::makeMonteCarlo(
    const std::string& name, const EvaluationMap& map, const RelocationMethodOptions& options)
{
  if (!map.features->field()) throw std::invalid_argument(name + " needs a map with a grid");
  const OccupancyRaster raster = rasterOf(*map.features->field());
  MonteCarloSettings settings;
  settings.region = options.region;
  if (name == "mcl-fixed")
  {
    settings.adaptive = false;
  }
  else if (name == "mcl-tuned")
  {
    settings.particles = particlesFor(raster);
    settings.kld_maximum = static_cast<std::uint32_t>(settings.particles);
    settings.kld_minimum = 1000;
    settings.motion_sigma = 0.05;
  }
  else if (name != "mcl")
  {
    throw std::invalid_argument("unknown method '" + name + "'");
  }
  return std::make_unique<MonteCarloFactory>(raster, settings);
}
}  // namespace sigloc
