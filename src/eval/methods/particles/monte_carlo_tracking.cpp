// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <stdexcept>

#include "eval/methods/particles/lost_filter.h"
#include "eval/methods/particles/MonteCarloSettings.h"
#include "eval/methods/particles/scan_reliability.h"
#include "eval/methods/TrackingMethod.h"

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
      : settings_(settings),
        grid_(map->mapByClass<mrpt::maps::COccupancyGridMap2D>()),
        filter_(map, settings, seed)
  {
  }

  TrackingClaim step(const RawlogStep& step) override
  {
    // pf-localization leaves its first step out.
    if (steps_++ > 0)
    {
      const mrpt::obs::CActionCollection actions = actionsOf(step, settings_);
      filter_.update(&actions, *step.frame);
    }
    const auto [covariance, mean] = filter_.particles().getCovarianceAndMean();
    TrackingClaim claim = cloud_.claim(mean, covariance);
    if (settings_.least_reliability) judgeClaim(claim, {mean.asTPose(), covariance}, *step.frame);
    return claim;
  }

 private:
  /// A tight cloud is a claim only where MRPT finds the scan reliable at it.
  void judgeClaim(TrackingClaim& claim, const GaussianPose& pose,
                  const mrpt::obs::CSensoryFrame& frame) const
  {
    const auto scan = frame.getObservationByClass<mrpt::obs::CObservation2DRangeScan>();
    if (!claim.confident || !scan) return;
    claim.reliability = scanReliability(*grid_, *scan, pose);
    claim.confident = claim.reliability >= *settings_.least_reliability;
  }

  MonteCarloSettings settings_;
  mrpt::maps::COccupancyGridMap2D::Ptr grid_;
  detail::LostFilter filter_;
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
