// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/relocation_scoring.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kListedCandidates = 10;
constexpr double kZ95 = 1.959963984540054;  // two-sided 95 % of the normal distribution

// Centre and half width of Wilson's score interval.
std::pair<double, double> wilson(std::size_t count, std::size_t cases)
{
  const auto n = static_cast<double>(cases);
  const double p = static_cast<double>(count) / n;
  const double z2 = kZ95 * kZ95;
  const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
  const double half = kZ95 / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
  return {centre, half};
}
}  // namespace

const char* toString(Claim claim)
{
  switch (claim)
  {
    case Claim::none:
      return "none";
    case Claim::right:
      return "right";
    case Claim::inaccurate:
      return "inaccurate";
    case Claim::wrong:
      return "wrong";
  }
  return "unknown";
}

PoseError poseError(const TPose2D& pose, const TPose2D& truth)
{
  return {std::hypot(pose.x - truth.x, pose.y - truth.y),
          std::abs(mrpt::math::angDistance(pose.phi, truth.phi)) * 180 / M_PI};
}

AccuracyGates simulationGates()
{
  AccuracyGates gates;
  gates.wrong_distance = gates.right_distance;
  gates.wrong_angle_deg = gates.right_angle_deg;
  return gates;
}

bool isRight(const PoseError& error, const AccuracyGates& gates)
{
  return error.distance <= gates.right_distance && error.angle_deg <= gates.right_angle_deg;
}

Claim judgeClaim(const std::optional<PoseError>& error, const AccuracyGates& gates)
{
  if (!error) return Claim::wrong;
  if (isRight(*error, gates)) return Claim::right;
  const bool near =
      error->distance <= gates.wrong_distance && error->angle_deg <= gates.wrong_angle_deg;
  return near ? Claim::inaccurate : Claim::wrong;
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
  record.claims_verdict = claims_verdict;
  record.verdict = answer.verdict;
  record.probability = answer.probability;
  record.candidates = answer.candidates.size();
  record.poses_scored = answer.counters.poses_scored;
  record.cut_short = answer.counters.cut_short > 0;
  if (!answer.candidates.empty())
  {
    record.first = answer.candidates.front().pose.mean;
    record.first_score = answer.candidates.front().score;
    if (query.truth) record.error = poseError(*record.first, *query.truth);
  }
  const auto is_right = [&](const TPose2D& pose)
  { return isRight(poseError(pose, *query.truth), gates); };
  if (query.truth)
  {
    const std::size_t listed = std::min(kListedCandidates, answer.candidates.size());
    for (std::size_t i = 0; i < listed && record.rank_of_right == 0; ++i)
    {
      if (is_right(answer.candidates[i].pose.mean)) record.rank_of_right = i + 1;
    }
  }
  if (proposals)
  {
    record.proposals = proposals->size();
    if (query.truth)
    {
      record.proposed = std::any_of(proposals->begin(), proposals->end(), is_right);
    }
  }
  if (claims_verdict && answer.verdict == Verdict::localized && record.first)
  {
    record.claim =
        judgeClaim(query.truth ? std::optional<PoseError>(record.error) : std::nullopt, gates);
  }
  return record;
}

double Proportion::value() const
{
  if (cases == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(count) / static_cast<double>(cases);
}

double Proportion::low() const
{
  if (cases == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto [centre, half] = wilson(count, cases);
  return count == 0 ? 0 : centre - half;
}

double Proportion::high() const
{
  if (cases == 0) return std::numeric_limits<double>::quiet_NaN();
  const auto [centre, half] = wilson(count, cases);
  return count == cases ? 1 : centre + half;
}

Quantiles quantilesOf(std::vector<double> values)
{
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto nearest_rank = [&](double share)
  { return values[static_cast<std::size_t>(std::max(1.0, std::ceil(share * n))) - 1]; };
  return {nearest_rank(0.5), nearest_rank(0.95),
          std::accumulate(values.begin(), values.end(), 0.0) / n};
}

RelocationSummary summarize(const std::vector<RelocationRecord>& records,
                            const AccuracyGates& gates)
{
  RelocationSummary summary;
  std::vector<double> times;
  std::vector<double> scored;
  std::vector<double> proposals;
  std::vector<double> distances;
  std::vector<double> angles;
  for (const RelocationRecord& record : records)
  {
    ++summary.queries;
    summary.claims_verdict = summary.claims_verdict || record.claims_verdict;
    times.push_back(record.time_ms);
    scored.push_back(static_cast<double>(record.poses_scored));
    if (record.claim != Claim::none) ++summary.confident;
    if (record.claim == Claim::right) ++summary.confident_right;
    if (record.claim == Claim::inaccurate) ++summary.inaccurate;
    if (record.claim == Claim::wrong) ++summary.confidently_wrong;
    if (record.cut_short) ++summary.cut_short;
    if (record.sawNothing()) ++summary.saw_nothing;
    if (record.sawNothing() || !record.truth) continue;
    const bool right = record.rank_of_right == 1;
    ++summary.recall_at_1.cases;
    ++summary.recall_at_1_tight.cases;
    ++summary.recall_at_10.cases;
    if (right)
    {
      ++summary.recall_at_1.count;
      distances.push_back(record.error.distance);
      angles.push_back(record.error.angle_deg);
    }
    if (right && record.error.angle_deg <= gates.tight_angle_deg) ++summary.recall_at_1_tight.count;
    if (record.rank_of_right > 0) ++summary.recall_at_10.count;
    if (record.proposed)
    {
      ++summary.proposed.cases;
      if (*record.proposed) ++summary.proposed.count;
      proposals.push_back(static_cast<double>(record.proposals));
    }
  }
  summary.median_error_m = quantilesOf(distances).median;
  summary.median_error_deg = quantilesOf(angles).median;
  summary.time_ms = quantilesOf(times);
  summary.poses_scored = quantilesOf(scored);
  summary.proposals = quantilesOf(proposals);
  return summary;
}
}  // namespace sigloc
