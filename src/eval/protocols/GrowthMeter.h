// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "eval/protocols/scale.h"
#include "matching/features/FeatureHypothesis.h"
#include "sigloc/map/FeatureMap.h"

namespace sigloc::detail
{
/// One place asked for, and what is seen there, robot frame.
struct GrowthScene
{
  std::string name;
  std::shared_ptr<const FeatureMap> map;
  mrpt::math::TPose2D truth;
  std::vector<Feature> observed;
};

/// Throws std::invalid_argument for a count of 0, or above the `most` features seen at a place.
void checkThinning(const std::vector<std::size_t>& counts, std::size_t most);

/// Measures one method over the scenes of one row of a growth study.
class GrowthMeter
{
 public:
  /// `wanted`: see ScaleRow; `keep_failures`: how many failed scenes the row keeps.
  GrowthMeter(std::string method, std::size_t wanted, std::size_t keep_failures);

  /// Builds the method's index of a map and takes its time and memory; asked for more than one map,
  /// the row has their means. The map must outlive what is returned.
  std::unique_ptr<FeatureHypothesisGenerator> build(const FeatureMap& map,
                                                    const GeneratorOptions& options);

  /// Asks for one scene; `is_right` judges the first hypothesis.
  void ask(const FeatureHypothesisGenerator& generator, const GrowthScene& scene,
           const std::function<bool(const FeatureHypothesis& first)>& is_right);

  /// The row of all that was asked.
  ScaleRow row() const;

 private:
  ScaleRow row_;
  std::size_t keep_failures_;
  MatchingCounters counters_;
  double observed_ = 0;  // sums over maps and scenes
  double map_features_ = 0;
  double build_seconds_ = 0;
  double bytes_per_feature_ = 0;
  double maps_ = 0;
};

/// Returns what a row says while others are still being measured.
std::string progressLine(const ScaleRow& row);
}  // namespace sigloc::detail
