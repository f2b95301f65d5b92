// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/scale.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/methods/feature_methods.h"
#include "eval/process/cpu_time.h"
#include "eval/protocols/area_growth.h"
#include "eval/protocols/GrowthMeter.h"
#include "eval/protocols/landmark_growth.h"

namespace sigloc
{
namespace
{
bool isRightPose(const FeatureHypothesis& hypothesis, const mrpt::math::TPose2D& truth,
                 const ScaleOptions& options)
{
  const auto& mean = hypothesis.pose.mean;
  return std::hypot(mean.x - truth.x, mean.y - truth.y) <= options.right_distance &&
         std::abs(mrpt::math::wrapToPi(mean.phi - truth.phi)) <= options.right_angle;
}

ScaleRow runRow(const std::string& method, const FeatureWorld& world,
                const std::shared_ptr<const FeatureMap>& map, std::size_t wanted,
                const ScaleOptions& options)
{
  detail::GrowthMeter meter(method, wanted, options.keep_failures);
  const auto generator = meter.build(*map, options.generator);
  Random random(options.seed, 1000 + wanted);
  const std::size_t poses = isLinearMethod(method) ? options.slow_poses : options.poses;
  for (std::size_t k = 0; k < poses; ++k)
  {
    detail::GrowthScene scene{std::to_string(k), map, randomPose(world, options.world, random), {}};
    scene.observed = observeFeatures(world, scene.truth, options.world, random, wanted);
    meter.ask(*generator, scene,
              [&](const FeatureHypothesis& first)
              { return isRightPose(first, scene.truth, options); });
  }
  return meter.row();
}

/// Throws std::invalid_argument where scenes are to hold more features than are seen from any pose.
void checkObserved(const FeatureWorld& world, const ScaleOptions& options)
{
  constexpr int kPlaces = 50;
  Random random(options.seed, 999);
  std::size_t most = 0;
  for (int k = 0; k < kPlaces; ++k)
  {
    const mrpt::math::TPose2D pose = randomPose(world, options.world, random);
    most = std::max(most, observeFeatures(world, pose, options.world, random).size());
  }
  detail::checkThinning(options.observed, most);
}

std::vector<std::size_t> mapSizes(const ScaleOptions& options)
{
  if (options.map_features.empty()) return {1000, 4000, 16000};
  for (const std::size_t size : options.map_features)
  {
    if (size == 0) throw std::invalid_argument("--map-features: a map holds one at least");
  }
  return options.map_features;
}
}  // namespace

ScaleReport runScale(const ScaleOptions& options)
{
  if (!options.buildings.empty()) return detail::runAreaGrowth(options);
  checkFeatureMethods(options.methods);
  if (!options.dlr.empty()) return detail::runLandmarkGrowth(options);
  ScaleReport report;
  report.provenance.command = options.command;
  report.provenance.seed = options.seed;
  const auto add = [&](ScaleRow row)
  {
    if (options.progress) options.progress(detail::progressLine(row));
    report.rows.push_back(std::move(row));
  };
  const std::vector<std::size_t> sizes = mapSizes(options);
  for (std::size_t index = 0; index < sizes.size(); ++index)
  {
    Random random(options.seed, index);
    const FeatureWorld world = makeFeatureWorld(sizes[index], options.world, random);
    if (index == 0) checkObserved(world, options);
    const double before = threadCpuSeconds();
    const auto map = std::make_shared<const FeatureMap>(world.mapped);
    report.map.add(*map, threadCpuSeconds() - before);
    for (const std::string& method : options.methods)
    {
      if (isLinearMethod(method) && sizes[index] > options.slow_limit) continue;
      add(runRow(method, world, map, 0, options));
      if (index > 0) continue;
      for (const std::size_t wanted : options.observed)
      {
        add(runRow(method, world, map, wanted, options));
      }
    }
  }
  return report;
}
}  // namespace sigloc
