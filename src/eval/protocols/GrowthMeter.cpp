// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/GrowthMeter.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/methods/feature_methods.h"
#include "eval/process/cpu_time.h"
#include "sigloc/config/plural.h"

namespace sigloc::detail
{
void checkThinning(const std::vector<std::size_t>& counts, std::size_t most)
{
  for (const std::size_t count : counts)
  {
    if (count == 0 || count > most)
    {
      throw std::invalid_argument(fmt::format(
          "--observed {}: not from 1 to the {} features that are seen at a place", count, most));
    }
  }
}

GrowthMeter::GrowthMeter(std::string method, std::size_t wanted, std::size_t keep_failures)
    : keep_failures_(keep_failures)
{
  row_.method = std::move(method);
  row_.wanted = wanted;
}

std::unique_ptr<FeatureHypothesisGenerator> GrowthMeter::build(const FeatureMap& map,
                                                               const GeneratorOptions& options)
{
  const auto features = static_cast<double>(map.features().size());
  const double memory_before = heapBytes();
  const double start = threadCpuSeconds();
  auto generator = makeFeatureMethod(row_.method, map, options);
  build_seconds_ += threadCpuSeconds() - start;
  bytes_per_feature_ += (heapBytes() - memory_before) / features + sizeof(Feature);
  map_features_ += features;
  maps_ += 1;
  return generator;
}

void GrowthMeter::ask(const FeatureHypothesisGenerator& generator, const GrowthScene& scene,
                      const std::function<bool(const FeatureHypothesis& first)>& is_right)
{
  const double before = threadCpuSeconds();
  const std::uint64_t cut_before = counters_.cut_short;
  const std::vector<FeatureHypothesis> found = generator.generate(scene.observed, counters_);
  Outcome& outcome = row_.records.emplace_back();
  outcome.times_ms = {1e3 * (threadCpuSeconds() - before)};
  outcome.cut_short = counters_.cut_short > cut_before;
  outcome.right = !found.empty() && is_right(found.front());
  observed_ += static_cast<double>(scene.observed.size());
  if (*outcome.right) outcome.error = errorBetween(found.front().pose.mean, scene.truth);
  if (!*outcome.right && row_.failures.size() < keep_failures_)
  {
    row_.failures.push_back(
        featureFailure(row_.method, scene.map, scene.name, scene.observed, scene.truth, found));
  }
}

std::string progressLine(const ScaleRow& row)
{
  std::string line = fmt::format("{}: {}", row.method, counted(row.map_features, "feature"));
  if (row.area > 0) line += fmt::format(", {:.0f} m^2", row.area);
  if (row.observed > 0) line += fmt::format(", {:.1f} observed", row.observed);
  return line + fmt::format(", {:.3f} ms", medianTime(row));
}

ScaleRow GrowthMeter::row() const
{
  ScaleRow row = row_;
  const double scenes = std::max<double>(1, static_cast<double>(row_.records.size()));
  const double maps = std::max(1.0, maps_);
  row.map_features = static_cast<std::size_t>(std::lround(map_features_ / maps));
  row.build_seconds = build_seconds_ / maps;
  row.bytes_per_feature = bytes_per_feature_ / maps;
  row.observed = observed_ / scenes;
  row.signature_pairs = static_cast<double>(counters_.signature_pairs) / scenes;
  row.hypotheses = static_cast<double>(counters_.hypotheses) / scenes;
  row.checks = static_cast<double>(counters_.checks) / scenes;
  row.visits = static_cast<double>(counters_.visits) / scenes;
  return row;
}
}  // namespace sigloc::detail
