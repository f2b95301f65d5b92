// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "eval/scoring/failed_queries.h"
#include "eval/scoring/map_statistics.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_summary.h"
#include "matching/features/GeneratorOptions.h"

namespace sigloc
{
/// Protocol "landmarks": relocation from landmarks alone, with local maps gathered over odometry.
struct LandmarksOptions
{
  std::string dataset = "dlr";  ///< or "victoria-park"
  std::filesystem::path path;
  /// DLR: how many steps a local map holds, one table row each. Victoria Park: ignored, a local map
  /// grows until the answer is firm or `max_travel` is reached.
  std::vector<std::size_t> local_map_steps{1, 10, 20};
  bool first_half_map = true;  ///< DLR: map of the first half of the path, else the given map
  double max_travel = 20;  ///< [m]
  /// DLR: a query is a later visit when the robot is so near to a pose of the first half [m]. More
  /// than half of the discs in its longest local map must be mapped, too: the camera sees ahead
  /// only, and may point elsewhere from the same position.
  double visited_distance = 1.0;
  double visited_share = 0.5;
  std::size_t query_stride = 10;  ///< every so many steps is a query
  std::size_t max_queries = 0;  ///< evenly spaced ones are asked, 0: all
  std::size_t keep_failures = 0;  ///< how many of each method and length the report keeps
  std::vector<std::string> methods{"signature"};
  GeneratorOptions generator;
  std::uint64_t seed = 1;
  std::string command;
  std::function<void(const std::string&)> progress;  ///< called with one line a row
};

/// A query, judged: confident where the answer is significant, and far ahead of the second.
struct LandmarkRecord : Outcome
{
  std::string method;
  std::size_t local_map_steps = 0;  ///< asked for; 0: as many as needed
  std::size_t step = 0;
  std::size_t features = 0;
  double travelled = 0;  ///< [m], of the local map
  bool answered = false;
  PoseError first_error;  ///< of the answer, right or not
  bool truth_sure = true;  ///< see LandmarkStep
  /// Pairs tried, hypotheses generated, checks, and cells and list entries read.
  std::uint64_t operations = 0;
};

struct LandmarksReport
{
  std::string dataset;
  MapStatistics map;
  std::vector<LandmarkRecord> records;
  std::vector<FailedQuery> failures;  ///< the first ones: firm and wrong, or not right
  Provenance provenance;
};

/// Throws std::invalid_argument for an unknown data set or method, std::runtime_error
/// ("path: reason") for its files.
LandmarksReport runLandmarks(const LandmarksOptions& options);

std::string landmarksTable(const LandmarksReport& report);

/// Writes summary.json, results.csv, report.md and the plots errors.png and times.png.
void writeLandmarksReport(const LandmarksReport& report, const std::filesystem::path& folder);
}  // namespace sigloc
