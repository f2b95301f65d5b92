// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/process/run_parallel.h"
#include "eval/scoring/failed_queries.h"
#include "eval/scoring/map_statistics.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_scoring.h"
#include "eval/worlds/world_generators.h"

namespace sigloc
{
/// One-shot relocation in simulated worlds while one condition is varied. All methods get the same
/// queries.
struct SweepOptions
{
  std::string over = "noise";  ///< name of a SweptQuantity
  std::vector<double> values;  ///< empty: the quantity's own
  std::vector<WorldKind> worlds;  ///< empty: the quantity's own
  std::uint32_t worlds_per_kind = 3;  ///< each from its own seed, at most 1000
  std::uint32_t queries_per_world = 30;  ///< at the same poses for every value, where free
  std::vector<std::string> methods = {"signature", "exhaustive", "lattice"};
  bool use_dense_field = true;  ///< for the signature methods
  std::uint32_t seed = 1;
  std::uint32_t threads = 1;  ///< queries run at a time; each query is timed on its own thread
  std::size_t keep_failures = 0;  ///< of each method at each value
  std::string command;  ///< for the report
  /// Called now and then with a text about the current work and the share of the run that is done.
  ShowProgress progress;
};

/// A query's answer, judged, and its world.
struct SweepRecord
{
  std::string world;  ///< kind and seed, "office-1001"
  RelocationRecord answer;
};

/// One method at one value.
struct SweepRow
{
  double value = 0;
  std::string method;
  std::vector<SweepRecord> records;
  std::vector<FailedQuery> failures;
};

struct SweepReport
{
  std::string over;
  std::string label;  ///< of the swept axis
  std::vector<SweepRow> rows;  ///< by value, then by method, as they were asked for
  MapStatistics map;  ///< none where runs were merged
  double peak_rss_mb = 0;
  Provenance provenance;
};

/// Throws std::invalid_argument for options that make no sense.
SweepReport runSweep(const SweepOptions& options);

/// A swept value as tables show it, with as many digits as distinguish it from any other: "0.05".
std::string sweptValueText(double value);

/// The table of the report, a line a value and method.
std::string sweepTable(const SweepReport& report);

/// Writes summary.json, results.csv, report.md and the plots into a folder.
/// Throws std::runtime_error ("path: reason").
void writeSweepReport(const SweepReport& report, const std::filesystem::path& folder);
}  // namespace sigloc
