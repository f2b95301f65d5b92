// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <cstdint>

#include "eval/methods/particles/MonteCarloSettings.h"

namespace sigloc::detail
{
/// MRPT's filter as pf-localization starts it: particles drawn over the free cells of the map.
class LostFilter
{
 public:
  /// Seeds MRPT's random generator of the thread. Nothing else may draw from it meanwhile.
  LostFilter(const mrpt::maps::CMultiMetricMap::Ptr& map, const MonteCarloSettings& settings,
             std::uint32_t seed);

  /// One step of the filter. Without `actions` the particles are only weighted, not moved.
  void update(const mrpt::obs::CActionCollection* actions, const mrpt::obs::CSensoryFrame& frame);

  const mrpt::slam::CMonteCarloLocalization2D& particles() const { return filter_; }

 private:
  mrpt::slam::CMonteCarloLocalization2D filter_;
  mrpt::bayes::CParticleFilter executor_;
};
}  // namespace sigloc::detail
