// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <stdexcept>

#include "sigloc/eval/MonteCarloSettings.h"
#include "sigloc/eval/TrackingMethod.h"

namespace sigloc
{
namespace
{
/// MRPT's filter driven as pf-localization drives it.
class MonteCarloTracking : public SteppedTracking
{
 public:
  MonteCarloTracking(const mrpt::maps::CMultiMetricMap::Ptr& map,
                     const MonteCarloSettings& settings, std::uint32_t seed)
      : settings_(settings)
  {
    // Its own randomize() would keep a Gaussian drawn before.
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(seed);
    const mrpt::config::CConfigFileMemory config(toIni(settings));
    filter_.options.metricMap = map;
    filter_.options.KLD_params.loadFromConfigFile(config, "KLD_options");
    executor_.m_options.loadFromConfigFile(config, "PF_options");
    const PoseRegion region = startRegionOf(settings);
    const auto grid = map->mapByClass<mrpt::maps::COccupancyGridMap2D>();
    filter_.resetUniformFreeSpace(grid.get(), 0.7, static_cast<int>(settings.particles),
                                  region.x_min, region.x_max, region.y_min, region.y_max,
                                  region.heading - region.heading_tolerance,
                                  region.heading + region.heading_tolerance);
  }

  TrackClaim step(const RawlogStep& step) override
  {
    // pf-localization leaves its first step out.
    if (steps_++ > 0)
    {
      const mrpt::obs::CActionCollection actions = actionsOf(step, settings_);
      executor_.executeOn(filter_, &actions, step.frame.get());
    }
    const auto [covariance, mean] = filter_.getCovarianceAndMean();
    return cloud_.claim(mean, covariance);
  }

 private:
  MonteCarloSettings settings_;
  mrpt::slam::CMonteCarloLocalization2D filter_;
  mrpt::bayes::CParticleFilter executor_;
  TightCloud cloud_;
  std::size_t steps_ = 0;
};

class MonteCarloFactory : public TrackingMethodFactory
{
 public:
  MonteCarloFactory(const EvaluationMap& map, const MonteCarloSettings& settings)
      : map_(localizationMapOf(map, toIni(settings))), settings_(settings)
  {
  }

  std::unique_ptr<TrackingMethod> start(std::uint32_t seed) const override
  {
    return std::make_unique<MonteCarloTracking>(map_, settings_, seed);
  }

  bool needsOwnProcess() const override { return true; }

 private:
  mrpt::maps::CMultiMetricMap::Ptr map_;
  MonteCarloSettings settings_;
};
}  // namespace

std::unique_ptr<TrackingMethodFactory> detail::makeMonteCarlo(
    const std::string& name, const EvaluationMap& map, const RelocationMethodOptions& options)
{
  if (!map.features->field()) throw std::invalid_argument(name + " needs a map with a grid");
  return std::make_unique<MonteCarloFactory>(map,
                                             monteCarloSettings(name, freeAreaOf(map), options));
}
}  // namespace sigloc
