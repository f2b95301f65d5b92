// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/methods/RelocationMethod.h"
#include "eval/process/run_parallel.h"
#include "eval/protocols/map_scans.h"
#include "eval/scoring/failed_queries.h"
#include "eval/scoring/map_statistics.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_scoring.h"

namespace sigloc
{
/// One-shot relocation, method by method, over the same queries in the same map.
struct RelocateOptions
{
  EvaluationSources sources;
  MapScanOptions scans_in_map;  ///< with a count: these are asked, in place of recorded scans
  std::vector<std::string> methods = {"signature", "exhaustive"};
  RelocationMethodOptions method;
  AccuracyGates gates;
  std::uint32_t threads = 1;  ///< queries asked at a time; each query is timed on its own thread
  std::size_t keep_failures = 0;  ///< how many failed queries of each method the report keeps
  std::string command;  ///< for the report
  /// Called now and then with the method and the share of its queries that are done.
  ShowProgress progress;
};

struct RelocateMethodReport
{
  std::string name;
  std::vector<RelocationRecord> records;  ///< in the order of the queries
  double ns_per_lookup = std::numeric_limits<double>::quiet_NaN();
  double peak_rss_mb = 0;
  double prepare_seconds = 0;  ///< CPU time of building the method's own structures
  std::vector<FailedQuery> failures;  ///< the first ones
};

struct RelocateReport
{
  std::vector<RelocateMethodReport> methods;
  MapStatistics map;
  std::shared_ptr<const FeatureMap> features;  ///< the map itself
  std::size_t without_truth = 0;
  bool complete = true;
  bool foreign = false;
  Provenance provenance;
};

/// Asks one method every query, on up to `threads` threads, and then judges the answers; each query
/// is timed on its own. `progress` is told after each of both, `what` being the name of it all.
std::vector<RelocationRecord> askQueries(const RelocationMethod& method,
                                         const std::vector<EvaluationQuery>& queries,
                                         const AccuracyGates& gates, std::uint32_t threads,
                                         const std::string& what, const ShowProgress& progress);

/// Throws std::invalid_argument for an empty list or a name that is no method of relocation.
void checkRelocationMethods(const std::vector<std::string>& names);

/// Asks every method every query. Throws std::invalid_argument for options that make no sense and
/// std::runtime_error ("path: reason") for a file that cannot be used.
RelocateReport runRelocate(const RelocateOptions& options);

/// Writes summary.json, results.csv, candidates.csv, report.md and the plots into a folder, making
/// it if need be. Throws std::runtime_error ("path: reason").
void writeRelocateReport(const RelocateReport& report, const std::filesystem::path& folder);

/// Returns the table of the report as aligned text, a line a method.
std::string relocateTable(const RelocateReport& report);
}  // namespace sigloc
