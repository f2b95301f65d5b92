// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GrowthMeter.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "sigloc/eval/cpu_time.h"
#include "sigloc/eval/feature_methods.h"
#include "sigloc/eval/report_files.h"

namespace sigloc::detail
{
namespace
{
/// Memory that this process has allocated and not freed [bytes].
double heapBytes()
{
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}
}  // namespace

GrowthMeter::GrowthMeter(std::string method, std::size_t wanted)
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

void GrowthMeter::ask(const FeatureHypothesisGenerator& generator,
                      const std::vector<Feature>& observed,
                      const std::function<bool(const FeatureHypothesis& first)>& is_right)
{
  const double before = threadCpuSeconds();
  const std::vector<FeatureHypothesis> found = generator.generate(observed, counters_);
  times_.push_back(1e3 * (threadCpuSeconds() - before));
  observed_ += static_cast<double>(observed.size());
  ++row_.success.cases;
  row_.success.count += !found.empty() && is_right(found.front());
}

std::string progressLine(const ScaleRow& row)
{
  return row.method + ": " + std::to_string(row.map_features) + " features, " +
         fixedNumber(row.observed, 1) + " observed, " + fixedNumber(row.time_ms.median, 3) + " ms";
}

ScaleRow GrowthMeter::row() const
{
  ScaleRow row = row_;
  const double scenes = std::max<double>(1, static_cast<double>(times_.size()));
  const double maps = std::max(1.0, maps_);
  row.map_features = static_cast<std::size_t>(std::lround(map_features_ / maps));
  row.build_seconds = build_seconds_ / maps;
  row.bytes_per_feature = bytes_per_feature_ / maps;
  row.observed = observed_ / scenes;
  row.signature_pairs = static_cast<double>(counters_.signature_pairs) / scenes;
  row.hypotheses = static_cast<double>(counters_.hypotheses) / scenes;
  row.checks = static_cast<double>(counters_.checks) / scenes;
  row.cut_short = counters_.cut_short;
  row.time_ms = quantilesOf(times_);
  return row;
}
}  // namespace sigloc::detail
