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
/// One query: its pose, and the features seen there, robot frame.
struct GrowthScene
{
  std::string name;
  std::shared_ptr<const FeatureMap> map;
  mrpt::math::TPose2D truth;
  std::vector<Feature> observed;
};

/// Throws std::invalid_argument for a count of 0, or above `most`, the features seen at one pose.
void checkThinning(const std::vector<std::size_t>& counts, std::size_t most);

/// Measures one method over the scenes of one row of a growth study.
class GrowthMeter
{
 public:
  /// `wanted`: see ScaleRow; `keep_failures`: how many failed scenes the row keeps.
  GrowthMeter(std::string method, std::size_t wanted, std::size_t keep_failures);

  /// Builds the method's index of a map and measures its time and memory. When called for several
  /// maps, the row has their means. The map must outlive the returned object.
  std::unique_ptr<FeatureHypothesisGenerator> build(const FeatureMap& map,
                                                    const GeneratorOptions& options);

  /// Matches one scene; `is_right` judges the first hypothesis.
  void ask(const FeatureHypothesisGenerator& generator, const GrowthScene& scene,
           const std::function<bool(const FeatureHypothesis& first)>& is_right);

  /// The row of all scenes so far.
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

/// Returns the progress text of a row, shown while others are still being measured.
std::string progressLine(const ScaleRow& row);
}  // namespace sigloc::detail
