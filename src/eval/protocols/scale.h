// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "eval/scoring/failed_queries.h"
#include "eval/scoring/map_statistics.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_summary.h"
#include "eval/worlds/FeatureWorld.h"
#include "matching/features/GeneratorOptions.h"

namespace sigloc
{
/// Protocol "growth": cost of the feature modes against the size of the map and of the scene, in
/// simulated worlds of bare features or on the DLR log.
struct ScaleOptions
{
  /// Empty: 1000, 4000 and 16000; on the log 50, 100 and 200 as far as there are more, and all.
  std::vector<std::size_t> map_features;
  std::vector<std::size_t> observed;  ///< thinned to these counts, in the first map
  std::vector<std::string> methods{"signature-patterns", "signature-anchors"};
  FeatureWorldOptions world;
  GeneratorOptions generator;
  std::size_t poses = 200;
  std::size_t slow_poses = 20;  ///< for methods that are linear in the map
  std::size_t slow_limit = 16000;  ///< largest map that those are run in
  std::uint64_t seed = 1;
  double right_distance = 0.3;  ///< [m]
  double right_angle = 0.06;  ///< [rad]
  /// Folder of the DLR log, or empty for simulated worlds. On the log, `world` says nothing, poses
  /// are later visits of mapped places, right as `landmarks` has it, and maps as large as wanted
  /// are the discs nearest to each.
  std::filesystem::path dlr;
  std::size_t local_map_steps = 20;  ///< on the log
  /// Counts of buildings: growth of relocation from one scan in maps of laser scans. `methods` are
  /// those of relocation, `poses` the queries, and `world` and the map sizes say nothing.
  std::vector<std::uint32_t> buildings;
  std::size_t keep_failures = 0;  ///< how many failed poses of each row the report keeps
  std::string command;
  std::function<void(const std::string&)> progress;  ///< called with one line a row
};

/// One method in one map, over all poses.
struct ScaleRow
{
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string method;
  std::size_t map_features = 0;
  double area = kNone;  ///< [m^2] of all buildings; NaN: the map has none
  std::size_t wanted = 0;  ///< observed features asked for; 0: all that are visible
  double observed = 0;  ///< mean number of observed features
  std::vector<Outcome> records;  ///< of each pose
  std::vector<FailedQuery> failures;  ///< the first ones
  double signature_pairs = 0;  ///< means over the poses
  double hypotheses = 0;
  double checks = 0;
  double visits = 0;
  double build_seconds = 0;
  double reference_ms = 0;  ///< median time that time_ratio refers to
  double bytes_per_feature = 0;  ///< of the map and its index, as allocated
  double bytes_per_m2 = kNone;  ///< the same over the area
  double map_seconds = kNone;  ///< CPU time of building the map from scans

  double operations() const { return signature_pairs + hypotheses + checks + visits; }
};

/// Slope of log y over log x with its 95 % interval: Student's t with two degrees of freedom fewer
/// than points. Two points or fewer leave it unbounded.
struct FittedExponent
{
  double slope = 0;
  double low = 0;
  double high = 0;
};
FittedExponent fitExponent(const std::vector<std::pair<double, double>>& points);

struct ScaleReport
{
  std::string where;  ///< added to titles
  std::vector<ScaleRow> rows;
  MapStatistics map;  ///< the simulated worlds, or the log's whole map
  Provenance provenance;
};

/// Throws std::invalid_argument for an unknown method and for sizes of map or scene that do not
/// exist. Throws std::runtime_error ("path: reason") for a log that cannot be used.
ScaleReport runScale(const ScaleOptions& options);

/// The rows and the fitted exponents as Markdown tables.
std::string scaleTable(const ScaleReport& report);

/// Writes summary.json, results.csv, report.md and the plots.
void writeScaleReport(const ScaleReport& report, const std::filesystem::path& folder);
}  // namespace sigloc
