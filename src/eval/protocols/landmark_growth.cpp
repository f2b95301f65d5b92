// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/landmark_growth.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "eval/data/evaluation_data.h"
#include "eval/process/cpu_time.h"
#include "eval/protocols/GrowthMeter.h"
#include "eval/protocols/landmark_queries.h"
#include "eval/worlds/Random.h"

namespace sigloc::detail
{
namespace
{
using mrpt::math::TPose2D;

/// One query, and the map's discs by their distance from it.
struct Place
{
  std::size_t step = 0;
  TPose2D truth;
  std::vector<Feature> observed;
  std::vector<Feature> nearest_first;
};

std::vector<Place> placesOf(const LandmarkData& data, const ScaleOptions& options)
{
  LandmarksOptions visits;
  visits.local_map_steps = {options.local_map_steps};
  const std::vector<Feature> map = mapFromSteps(data, data.steps.size() / 2);
  std::vector<Place> places;
  const std::vector<std::size_t> steps = laterVisits(data, visits);
  places.reserve(steps.size());
  for (const std::size_t which : evenlySpaced(steps.size(), options.poses))
  {
    const std::size_t step = steps[which];
    const TPose2D& truth = data.steps[step].truth;
    places.push_back(
        {step, truth, localMapAt(data, step, options.local_map_steps).features(), map});
    const auto distance = [&](const Feature& feature)
    { return std::hypot(feature.position.x - truth.x, feature.position.y - truth.y); };
    std::stable_sort(places.back().nearest_first.begin(), places.back().nearest_first.end(),
                     [&](const Feature& a, const Feature& b) { return distance(a) < distance(b); });
  }
  return places;
}

/// Returns `count` of the features, drawn at random; all for 0.
std::vector<Feature> thinned(std::vector<Feature> features, std::size_t count, Random& random)
{
  if (count == 0 || count >= features.size()) return features;
  for (std::size_t i = 0; i < count; ++i)
  {
    std::swap(features[i], features[i + random.index(features.size() - i)]);
  }
  features.resize(count);
  return features;
}

ScaleRow runRow(const std::string& method, const std::vector<Place>& places, std::size_t map_size,
                std::size_t wanted, const LandmarkData& data, const ScaleOptions& options)
{
  GrowthMeter meter(method, wanted, options.keep_failures);
  Random random(options.seed, 1000 + wanted);
  for (const Place& place : places)
  {
    std::vector<Feature> nearest = place.nearest_first;
    nearest.resize(std::min(map_size, nearest.size()));
    const GrowthScene scene{
        std::to_string(place.step),
        std::make_shared<const FeatureMap>(std::move(nearest), std::nullopt, data.map_error),
        place.truth, thinned(place.observed, wanted, random)};
    const auto generator = meter.build(*scene.map, options.generator);
    meter.ask(*generator, scene,
              [&](const FeatureHypothesis& first)
              { return isRight(errorBetween(first.pose.mean, place.truth), AccuracyGates{}); });
  }
  return meter.row();
}
/// The sizes given, or those of the study; throws std::invalid_argument for more than `whole`.
std::vector<std::size_t> mapSizes(std::vector<std::size_t> wanted, std::size_t whole)
{
  for (const std::size_t size : wanted)
  {
    if (size > 0 && size <= whole) continue;
    throw std::invalid_argument(
        fmt::format("--map-features {}: not from 1 to the {} discs of the log's map", size, whole));
  }
  if (!wanted.empty()) return wanted;
  for (const std::size_t size : {50U, 100U, 200U})
  {
    if (size < whole) wanted.push_back(size);
  }
  wanted.push_back(whole);
  return wanted;
}

void checkObserved(const std::vector<Place>& places, const ScaleOptions& options)
{
  std::size_t most = 0;
  for (const Place& place : places) most = std::max(most, place.observed.size());
  checkThinning(options.observed, most);
}
}  // namespace

ScaleReport runLandmarkGrowth(const ScaleOptions& options)
{
  const LandmarkData data = readDlr(options.dlr);
  const std::vector<Place> places = placesOf(data, options);
  if (places.empty())
  {
    throw std::runtime_error(options.dlr.string() + ": no place is visited twice");
  }
  ScaleReport report;
  report.where = fmt::format(" on DLR, local maps of {} steps", options.local_map_steps);
  report.provenance = {options.command, options.seed, data.files};
  const auto add = [&](const std::string& method, std::size_t map_size, std::size_t wanted)
  {
    report.rows.push_back(runRow(method, places, map_size, wanted, data, options));
    if (options.progress) options.progress(progressLine(report.rows.back()));
  };
  const std::size_t whole = places.front().nearest_first.size();
  const std::vector<std::size_t> sizes = mapSizes(options.map_features, whole);
  checkObserved(places, options);
  const double before = threadCpuSeconds();
  const FeatureMap map(places.front().nearest_first, std::nullopt, data.map_error);
  report.map.add(map, threadCpuSeconds() - before);
  for (const std::string& method : options.methods)
  {
    for (const std::size_t size : sizes) add(method, size, 0);
    for (const std::size_t wanted : options.observed) add(method, whole, wanted);
  }
  return report;
}
}  // namespace sigloc::detail
