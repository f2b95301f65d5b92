// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/stored_relocations.h"

#include <cmath>

namespace sigloc::detail
{
namespace
{
std::optional<mrpt::math::TPose2D> storedPose(const CsvTable& results, std::size_t row,
                                              const std::string& prefix)
{
  const mrpt::math::TPose2D pose{results.number(row, prefix + "x"),
                                 results.number(row, prefix + "y"),
                                 results.number(row, prefix + "phi")};
  if (std::isnan(pose.x) || std::isnan(pose.y) || std::isnan(pose.phi)) return std::nullopt;
  return pose;
}

/// The value whose name stands in a cell.
template <class Enum>
Enum storedName(const CsvTable& results, std::size_t row, const std::string& column, Enum last)
{
  const std::string& name = results.text(row, column);
  for (int i = 0; i <= static_cast<int>(last); ++i)
  {
    if (name == toString(static_cast<Enum>(i))) return static_cast<Enum>(i);
  }
  results.fail(row, column + ": '" + name + "' is unknown");
}
}  // namespace

RelocationRecord storedRelocation(const CsvTable& results, std::size_t row)
{
  RelocationRecord record;
  record.query = results.text(row, "query");
  record.truth = storedPose(results, row, "truth_");
  record.valid_beams = results.count(row, "valid_beams");
  record.verdict = storedName(results, row, "verdict", Verdict::too_little_seen);
  record.probability = results.number(row, "probability");
  record.first = storedPose(results, row, "");
  record.first_score = results.number(row, "score");
  record.error = {results.number(row, "error_m"), results.number(row, "error_deg")};
  record.candidates = results.count(row, "candidates");
  record.rank_of_right = results.count(row, "rank_of_right");
  record.proposals = results.count(row, "proposals");
  if (!results.text(row, "proposed").empty())
  {
    record.proposed = results.count(row, "proposed") != 0;
  }
  record.claims_verdict = !results.text(row, "claim").empty();
  if (record.claims_verdict) record.claim = storedName(results, row, "claim", Claim::wrong);
  record.poses_scored = results.count(row, "poses_scored");
  // Runs of earlier versions did not tell.
  record.cut_short = results.has("cut_short") && results.count(row, "cut_short") != 0;
  record.time_ms = results.number(row, "time_ms");
  return record;
}
}  // namespace sigloc::detail
