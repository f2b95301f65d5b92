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

#include "occupancy_grid.h"
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
      : grid_(detail::occupancyGridOf(raster)), settings_(settings)
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
  if (options.particles)
  {
    settings.particles = *options.particles;
    settings.kld_maximum = std::max(settings.kld_maximum, *options.particles);
  }
  return std::make_unique<MonteCarloFactory>(raster, settings);
}
}  // namespace sigloc
