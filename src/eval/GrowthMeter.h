// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sigloc/eval/scale.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/matching/FeatureHypothesis.h"

namespace sigloc::detail
{
/// Measures one method over the scenes of one row of a growth study.
class GrowthMeter
{
 public:
  /// `wanted`: see ScaleRow.
  GrowthMeter(std::string method, std::size_t wanted);

  /// Builds the method's index of a map and takes its time and memory; asked for more than one map,
  /// the row has their means. The map must outlive what is returned.
  std::unique_ptr<FeatureHypothesisGenerator> build(const FeatureMap& map,
                                                    const GeneratorOptions& options);

  /// Asks for one scene; `is_right` judges the first hypothesis.
  void ask(const FeatureHypothesisGenerator& generator, const std::vector<Feature>& observed,
           const std::function<bool(const FeatureHypothesis& first)>& is_right);

  /// The row of all that was asked.
  ScaleRow row() const;

 private:
  ScaleRow row_;
  MatchingCounters counters_;
  std::vector<double> times_;  // [ms]
  double observed_ = 0;  // sums over maps and scenes
  double map_features_ = 0;
  double build_seconds_ = 0;
  double bytes_per_feature_ = 0;
  double maps_ = 0;
};

/// Returns what a row says while others are still being measured.
std::string progressLine(const ScaleRow& row);
}  // namespace sigloc::detail
