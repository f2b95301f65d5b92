// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sigloc/eval/provenance.h"
#include "sigloc/eval/relocation_scoring.h"
#include "sigloc/eval/RelocationMethod.h"

namespace sigloc
{
/// One-shot relocation, method by method, over the same queries in the same map.
struct RelocateOptions
{
  EvaluationSources sources;
  std::vector<std::string> methods = {"signature", "exhaustive"};
  RelocationMethodOptions method;
  AccuracyGates gates;
  std::uint32_t threads = 1;  ///< queries asked at a time; each query is timed on its own thread
  std::string command;  ///< for the report
  /// Called now and then with the method and the share of its queries that are done.
  std::function<void(const std::string& method, double share)> progress;
};

struct RelocateMethodReport
{
  std::string name;
  std::vector<RelocationRecord> records;  ///< in the order of the queries
  RelocationSummary summary;
  double prepare_seconds = 0;  ///< CPU time of building the method's own structures
};

struct RelocateReport
{
  std::vector<RelocateMethodReport> methods;
  std::size_t map_features = 0;
  std::size_t map_bytes = 0;
  double map_build_seconds = 0;
  std::size_t without_truth = 0;
  bool complete = true;
  bool foreign = false;
  Provenance provenance;
};

/// Asks every method every query. Throws std::invalid_argument for options that make no sense and
/// std::runtime_error ("path: reason") for a file that cannot be used.
RelocateReport runRelocate(const RelocateOptions& options);

/// Writes summary.json, results.csv, report.md and the plots into a folder, making it if need be.
/// Throws std::runtime_error ("path: reason").
void writeRelocateReport(const RelocateReport& report, const std::filesystem::path& folder);

/// Returns the table of the report as aligned text, a line a method.
std::string relocateTable(const RelocateReport& report);
}  // namespace sigloc
