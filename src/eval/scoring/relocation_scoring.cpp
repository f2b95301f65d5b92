// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/relocation_scoring.h"

#include <mrpt/core/bits_math.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace sigloc
{
using mrpt::RAD2DEG;
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kListedCandidates = 10;
// Columns that earlier versions did not write.
constexpr std::array<std::string_view, 2> kAddedLater = {"cut_short", "settled_by_pairs"};
}  // namespace

const char* toString(Claim claim)
{
  constexpr std::array kNames = {"none", "right", "inaccurate", "wrong"};
  const auto i = static_cast<std::size_t>(claim);
  return i < kNames.size() ? kNames[i] : "unknown";
}

Written written(const PoseError& error, int decimals)
{
  return {{},
          {fixedNumber(error.distance, decimals), fixedNumber(RAD2DEG(error.angle), decimals - 1)}};
}

bool parse(const Cells& cells, PoseError& error)
{
  if (!parse({cells[0]}, error.distance) || !parse({cells[1]}, error.angle)) return false;
  error.angle = mrpt::DEG2RAD(error.angle);
  return true;
}

AccuracyGates simulationGates()
{
  AccuracyGates gates;
  gates.wrong_distance = gates.right_distance;
  gates.wrong_angle = gates.right_angle;
  return gates;
}

Claim judgeClaim(const std::optional<PoseError>& error, const AccuracyGates& gates)
{
  if (!error) return Claim::wrong;
  if (isRight(*error, gates)) return Claim::right;
  return isWrong(*error, gates) ? Claim::wrong : Claim::inaccurate;
}

std::size_t countValidBeams(const std::vector<LaserScan>& scans)
{
  std::size_t count = 0;
  for (const LaserScan& scan : scans)
  {
    count += static_cast<std::size_t>(std::count(scan.valid.begin(), scan.valid.end(), 1));
  }
  return count;
}

RelocationRecord judgeRelocation(const EvaluationQuery& query, const RelocationResult& answer,
                                 bool claims_verdict,
                                 const std::optional<std::vector<TPose2D>>& proposals,
                                 const AccuracyGates& gates)
{
  RelocationRecord record;
  record.query = query.name;
  record.truth = query.truth;
  record.valid_beams = countValidBeams(query.scans);
  record.verdict = answer.verdict;
  record.probability = answer.probability;
  record.candidates = answer.candidates.size();
  record.poses_scored = answer.counters.poses_scored;
  record.cut_short = answer.counters.cut_short > 0;
  record.settled_by_pairs = answer.counters.settled_by_pairs > 0;
  record.view = answer.view;
  if (!answer.candidates.empty())
  {
    record.first = answer.candidates.front().pose.mean;
    record.first_score = answer.candidates.front().score;
    if (query.truth) record.error = errorBetween(*record.first, *query.truth);
  }
  const auto is_right = [&](const TPose2D& pose)
  { return isRight(errorBetween(pose, *query.truth), gates); };
  const std::size_t listed = std::min(kListedCandidates, answer.candidates.size());
  for (std::size_t i = 0; i < listed; ++i)
  {
    CandidateRecord& one = record.listed.emplace_back();
    one.rank = i + 1;
    one.candidate = answer.candidates[i];
    one.candidate.pairings.clear();
    if (!query.truth) continue;
    one.right = is_right(one.candidate.pose.mean);
    if (*one.right && record.rank_of_right == 0) record.rank_of_right = one.rank;
  }
  if (proposals)
  {
    record.proposals = proposals->size();
    if (query.truth)
    {
      record.proposed = std::any_of(proposals->begin(), proposals->end(), is_right);
    }
  }
  if (claims_verdict) record.claim = Claim::none;
  if (claims_verdict && answer.verdict == Verdict::localized && record.first)
  {
    record.claim =
        judgeClaim(query.truth ? std::optional<PoseError>(record.error) : std::nullopt, gates);
  }
  return record;
}

const Columns<RelocationRecord>& relocationColumns()
{
  using R = RelocationRecord;
  using C = Column<R>;
  static const Columns<R> kColumns = {
      C("query", &R::query),
      C("truth_x,truth_y,truth_phi", &R::truth, "[m, rad], in the map", 4),
      C("valid_beams", &R::valid_beams, "beams with an echo; fewer than 10 see nothing"),
      C("verdict", &R::verdict),
      C("probability", &R::probability, "of the verdict", 6),
      C("x,y,phi", &R::first, "the first candidate [m, rad], in the map", 4),
      C("score", &R::first_score, "of the first candidate", 5),
      C("error_m,error_deg", &R::error, "of the first candidate", 4),
      C("candidates", &R::candidates, "how many were returned"),
      C("rank_of_right", &R::rank_of_right, "from 1; 0: none of the first ten is right"),
      C("proposals", &R::proposals, "poses that the method's features proposed"),
      C("proposed", &R::proposed,
        "whether a right one is among them; empty: not asked, or no truth"),
      C("claim", &R::claim, "a confident answer, judged; empty for a method without a verdict"),
      C("poses_scored", &R::poses_scored, "poses compared with the scan"),
      C("cut_short", &R::cut_short, "the search ended at its budget"),
      C("settled_by_pairs", &R::settled_by_pairs, "pairs of key points ended the search"),
      C("time_ms", &R::time_ms, "CPU time, from raw scan to ranked candidates")};
  return kColumns;
}

const Columns<CandidateRecord>& candidateColumns()
{
  using R = CandidateRecord;
  using C = Column<R>;
  static const Columns<R> kColumns = {
      C("rank", &R::rank, "from 1"),
      C(
          "x,y,phi", [](const R& r) { return r.candidate.pose.mean; }, "[m, rad], in the map", 4),
      C(
          "score", [](const R& r) { return r.candidate.score; }, "", 5),
      C(
          "probability", [](const R& r) { return r.candidate.probability; }, "", 6),
      C(
          "explained", [](const R& r) { return r.candidate.explained; }, "share of returns", 5),
      C(
          "through_wall", [](const R& r) { return r.candidate.through_wall; }, "share of beams", 5),
      C(
          "in_free", [](const R& r) { return r.candidate.in_free; }, "share of returns", 5),
      C("walls", [](const R& r) { return r.candidate.constraints.walls; }),
      C("missing_walls", [](const R& r) { return r.candidate.constraints.missing_walls; }),
      C("wall_ends", [](const R& r) { return r.candidate.constraints.wall_ends; }),
      C("right", &R::right, "empty without truth")};
  return kColumns;
}

RelocationRecord storedRelocation(const detail::CsvTable& results, std::size_t row)
{
  RelocationRecord record;
  for (const Column<RelocationRecord>& column : relocationColumns())
  {
    const bool added_later =
        std::find(kAddedLater.begin(), kAddedLater.end(), column.name) != kAddedLater.end();
    if (added_later && !results.has(column.name)) continue;
    Cells cells;
    std::istringstream names(column.name);
    for (std::string name; std::getline(names, name, ',');)
      cells.push_back(results.text(row, name));
    if (!column.store(record, cells)) results.fail(row, column.name + ": bad value");
  }
  return record;
}
}  // namespace sigloc
