// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/failed_queries.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "matching/features/FeatureHypothesis.h"
#include "sigloc/config/plural.h"

namespace sigloc
{
namespace
{
std::string fateOfTheRightPose(const RelocationRecord& record)
{
  if (!record.truth) return "another place";
  std::string fate = record.rank_of_right > 0
                         ? "right pose: rank " + std::to_string(record.rank_of_right)
                         : std::string("right pose: refused");
  if (record.proposed) fate += *record.proposed ? ", proposed" : ", not proposed";
  return fate;
}
}  // namespace

bool isFailure(const RelocationRecord& record)
{
  if (record.claim == Claim::wrong) return true;
  return !record.sawNothing() && record.truth && record.rank_of_right != 1;
}

std::vector<FailedQuery> collectFailures(const std::string& name, const RelocationMethod& method,
                                         const EvaluationMap& map,
                                         const std::vector<EvaluationQuery>& queries,
                                         const std::vector<RelocationRecord>& records,
                                         std::size_t limit)
{
  std::vector<FailedQuery> failures;
  for (std::size_t i = 0; i < records.size() && failures.size() < limit; ++i)
  {
    if (!isFailure(records[i])) continue;
    FailedQuery failure;
    failure.method = name;
    failure.map = map.features;
    failure.query = queries[i];
    failure.fate = fateOfTheRightPose(records[i]);
    failure.record = records[i];
    failure.answer = method.localize(queries[i].scans);
    failure.proposals = method.propose(queries[i].scans).value_or(failure.proposals);
    failures.push_back(std::move(failure));
  }
  return failures;
}

FailedQuery featureFailure(const std::string& name, std::shared_ptr<const FeatureMap> map,
                           std::string query, const std::vector<Feature>& observed,
                           const mrpt::math::TPose2D& truth,
                           const std::vector<FeatureHypothesis>& found)
{
  constexpr std::size_t kListed = 10;
  FailedQuery failure;
  failure.method = name;
  failure.map = std::move(map);
  failure.query.name = std::move(query);
  failure.query.truth = failure.record.truth = truth;
  failure.landmarks = observed;
  failure.fate = counted(observed.size(), "feature") + " seen, " +
                 counted(found.size(), "hypothesis", "hypotheses");
  failure.record.verdict = found.empty() ? Verdict::not_here : Verdict::ambiguous;
  failure.record.probability = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < std::min(kListed, found.size()); ++k)
  {
    Candidate candidate;
    candidate.pose = found[k].pose;
    candidate.score = found[k].log_odds;
    failure.answer.candidates.push_back(candidate);
  }
  if (!found.empty()) failure.record.error = errorBetween(found.front().pose.mean, truth);
  return failure;
}
}  // namespace sigloc
