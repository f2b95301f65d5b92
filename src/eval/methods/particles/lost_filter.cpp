// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/particles/lost_filter.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/random/RandomGenerators.h>

#include <stdexcept>

namespace sigloc::detail
{
LostFilter::LostFilter(const mrpt::maps::CMultiMetricMap::Ptr& map,
                       const MonteCarloSettings& settings, std::uint32_t seed)
{
  // Its own randomize() would keep a Gaussian drawn before.
  mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(seed);
  const mrpt::config::CConfigFileMemory config(toIni(settings));
  filter_.options.metricMap = map;
  filter_.options.KLD_params.loadFromConfigFile(config, "KLD_options");
  executor_.m_options.loadFromConfigFile(config, "PF_options");
  const PoseRegion region = startRegionOf(settings);
  const auto grid = map->mapByClass<mrpt::maps::COccupancyGridMap2D>();
  try
  {
    filter_.resetUniformFreeSpace(grid.get(), 0.7, static_cast<int>(settings.particles),
                                  region.x_min, region.x_max, region.y_min, region.y_max,
                                  region.heading - region.heading_tolerance,
                                  region.heading + region.heading_tolerance);
  }
  catch (const std::logic_error&)  // MRPT asserts that there is a free cell
  {
    throw std::invalid_argument("the map has no free place inside the region");
  }
}

void LostFilter::update(const mrpt::obs::CActionCollection* actions,
                        const mrpt::obs::CSensoryFrame& frame)
{
  executor_.executeOn(filter_, actions, &frame);
}
}  // namespace sigloc::detail
