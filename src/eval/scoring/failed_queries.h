// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eval/methods/RelocationMethod.h"
#include "eval/scoring/relocation_scoring.h"

namespace sigloc
{
/// A query that a method got wrong, with all that is needed to see why.
struct FailedQuery
{
  std::string method;
  std::shared_ptr<const FeatureMap> map;
  EvaluationQuery query;
  std::vector<Feature> landmarks;  ///< what was seen beside the query's scans, robot frame
  std::string fate;  ///< what became of the right pose, in words
  RelocationRecord record;
  RelocationResult answer;
  std::vector<mrpt::math::TPose2D> proposals;  ///< empty for methods that search
};

/// True when a query that saw something has a first candidate that is not right, or was claimed
/// wrongly; without truth (a foreign map), when it was claimed at all.
bool isFailure(const RelocationRecord& record);

/// Returns the first failures among judged queries, at most `limit`; the method is asked again for
/// what the records leave out. `records` in the order of `queries`.
std::vector<FailedQuery> collectFailures(const std::string& name, const RelocationMethod& method,
                                         const EvaluationMap& map,
                                         const std::vector<EvaluationQuery>& queries,
                                         const std::vector<RelocationRecord>& records,
                                         std::size_t limit);

/// Returns what a search by features alone answered wrongly: what it observed, robot frame, and
/// what it found, best first.
FailedQuery featureFailure(const std::string& name, std::shared_ptr<const FeatureMap> map,
                           std::string query, const std::vector<Feature>& observed,
                           const mrpt::math::TPose2D& truth,
                           const std::vector<FeatureHypothesis>& found);
}  // namespace sigloc
