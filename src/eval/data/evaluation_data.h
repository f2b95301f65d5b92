// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/io/RawlogReader.h"
#include "sigloc/map/map_building.h"

namespace sigloc
{
/// The map data of a run. Every method is made from this alone.
struct EvaluationMap
{
  std::shared_ptr<const FeatureMap> features;  ///< what `sigloc-map build` makes of the input
  /// The raster that dense baselines search: 0.1 m cells from the mapping scans, or the given grid.
  /// None for a map of landmarks.
  std::optional<OccupancyRaster> raster;
  std::vector<mrpt::math::TPose2D> mapped_poses;  ///< of the mapping scans; empty for a grid
  double build_seconds = 0;  ///< CPU time of building `features`
  std::filesystem::path file;  ///< that all of it was read from; empty when made of parts of one
};

/// One pose to be found: the scans taken there, and the truth, which no method is given.
struct EvaluationQuery
{
  std::string name;  ///< index in its file
  std::vector<LaserScan> scans;
  std::optional<mrpt::math::TPose2D> truth;  ///< map_from_robot; none in a foreign map
};

/// Where map and queries come from; see `sigloc-eval relocate`.
struct EvaluationSources
{
  std::filesystem::path map;
  std::filesystem::path queries;  ///< a simplemap, or empty
  std::filesystem::path rawlog;  ///< with `ground_truth`, or empty
  std::filesystem::path ground_truth;
  std::uint32_t interleave = 0;  ///< > 0: every k-th scan of the map is a query, the rest map
  mrpt::math::TPose2D map_from_queries;
  bool foreign = false;  ///< the queries are of another building: no truth
  ReadingOptions reading;
  std::uint32_t max_queries = 0;  ///< evenly spaced ones are kept, 0: all
};

struct EvaluationData
{
  EvaluationMap map;
  std::vector<EvaluationQuery> queries;
  std::size_t without_truth = 0;  ///< steps of a rawlog left out because they have no truth
  bool complete = true;  ///< false when a rawlog was truncated
};

/// Reads map and queries. Throws std::invalid_argument for a combination of sources that makes no
/// sense and std::runtime_error ("path: reason") for a file that cannot be used.
EvaluationData readEvaluationData(const EvaluationSources& sources);

/// Reads the map alone. Throws std::runtime_error ("path: reason").
EvaluationMap readEvaluationMap(const std::filesystem::path& path,
                                const ReadingOptions& reading = {});

/// Returns the map data of posed scans, as `readEvaluationData` makes it.
EvaluationMap evaluationMapFromScans(const std::vector<PosedScans>& scans);

/// Returns `count` evenly spaced elements' indices of a list of `size`; all when count is 0.
std::vector<std::size_t> evenlySpaced(std::size_t size, std::size_t count);
}  // namespace sigloc
