// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "eval/process/run_parallel.h"
#include "eval/scoring/provenance.h"
#include "eval/scoring/relocation_scoring.h"

namespace sigloc
{
/// "Am I lost?": how well a figure of one scan at one pose separates right poses from wrong ones.
/// Each simulated scan is judged at two poses. One is the true pose with a tracker's errors. The
/// other is plausible but wrong: a look-alike that relocation proposes for the same scan.
struct ReliabilityOptions
{
  std::uint32_t worlds = 30;  ///< offices, corridors and halls in turn
  std::uint32_t poses = 20;  ///< a world
  std::vector<double> clutter = {0, 0.15, 0.3};  ///< share of beams that end on nearer clutter
  std::uint32_t seed = 1;
  std::uint32_t threads = 1;  ///< worlds at a time
  std::string command;
  ShowProgress progress;
};

/// One scan judged at one pose.
struct ReliabilityCase
{
  std::size_t world = 0;
  double clutter = 0;
  bool right = false;
  PoseError error;
  double signature = 0;  ///< Belief::reliability, eq. (8.11)
  double mrpt = 0;  ///< laserScanSimulatorWithUncertainty and evaluateScanLikelihood
};

struct ReliabilityReport
{
  std::vector<ReliabilityCase> cases;
  std::size_t skipped = 0;  ///< scans with no look-alike
  Provenance provenance;
};

/// Throws std::invalid_argument for options that make no sense.
ReliabilityReport runReliability(const ReliabilityOptions& options);

/// Area under the ROC curve: the probability that a right case has the higher figure, ties counted
/// half; with its standard error after Hanley and McNeil (1982).
struct AreaUnderCurve
{
  double area = 0;
  double sigma = 0;
};
AreaUnderCurve areaUnderCurve(const std::vector<double>& right, std::vector<double> wrong);

/// Writes summary.json, results.csv, report.md and roc-<clutter>.png into a folder.
void writeReliabilityReport(const ReliabilityReport& report, const std::filesystem::path& folder);

std::string reliabilityTable(const ReliabilityReport& report);
}  // namespace sigloc
