// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/columns.h"
#include "eval/data/csv_table.h"
#include "eval/data/evaluation_data.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
/// In simulation the truth is exact: a confident answer that is not right is wrong.
AccuracyGates simulationGates();

/// What a confident answer turned out to be.
enum class Claim : std::uint8_t
{
  none,  ///< not confident
  right,
  inaccurate,
  wrong,
};
const char* toString(Claim claim);

/// Two cells of CSV: metres, and degrees with a digit less.
Written written(const PoseError& error, int decimals);
bool parse(const Cells& cells, PoseError& error);
/// What a confident claim of a pose is worth; without truth (a foreign map) it is wrong.
Claim judgeClaim(const std::optional<PoseError>& error, const AccuracyGates& gates);

/// Fewer valid beams than this and a query has seen nothing.
constexpr std::size_t kBeamsToSee = 10;
std::size_t countValidBeams(const std::vector<LaserScan>& scans);

/// A candidate of an answer, judged: a row of candidates.csv.
struct CandidateRecord
{
  std::size_t rank = 0;  ///< from 1
  Candidate candidate;
  std::optional<bool> right;  ///< none without truth
};

/// One query's answer, judged: a row of results.csv.
struct RelocationRecord
{
  std::string query;
  std::optional<mrpt::math::TPose2D> truth;
  std::size_t valid_beams = 0;
  Verdict verdict = Verdict::too_little_seen;
  double probability = 0;
  std::optional<mrpt::math::TPose2D> first;  ///< the first candidate
  double first_score = 0;
  PoseError error;  ///< of the first candidate
  std::size_t candidates = 0;
  std::size_t rank_of_right = 0;  ///< from 1; 0: none of the first ten is right
  std::optional<bool> proposed;  ///< a right pose was proposed; none: not asked or no truth
  std::size_t proposals = 0;
  std::optional<Claim> claim;  ///< none: the method does not say whether it is sure
  std::uint64_t poses_scored = 0;
  bool cut_short = false;  ///< the search ended at its budget, unfinished
  bool settled_by_pairs = false;  ///< pairs of key points ended the search
  double time_ms = 0;
  double view = 0;  ///< [rad] angular coverage of the scan
  std::vector<CandidateRecord> listed;  ///< the first ten

  bool sawNothing() const { return valid_beams < kBeamsToSee; }
};

/// Judges an answer. `proposals` as `RelocationMethod::propose` returns them.
RelocationRecord judgeRelocation(const EvaluationQuery& query, const RelocationResult& answer,
                                 bool claims_verdict,
                                 const std::optional<std::vector<mrpt::math::TPose2D>>& proposals,
                                 const AccuracyGates& gates);

/// What results.csv holds of a query, after the method's name.
const Columns<RelocationRecord>& relocationColumns();

/// What candidates.csv holds of a candidate, after the names of the method and the query.
const Columns<CandidateRecord>& candidateColumns();

/// Reads a row back that was written with these columns, to the digits that it has.
/// Throws std::runtime_error ("path: line N: reason").
RelocationRecord storedRelocation(const detail::CsvTable& results, std::size_t row);
}  // namespace sigloc
