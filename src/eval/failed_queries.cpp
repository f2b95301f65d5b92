// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/failed_queries.h"

namespace sigloc
{
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
    failure.record = records[i];
    failure.answer = method.localize(queries[i].scans);
    failure.proposals = method.propose(queries[i].scans).value_or(failure.proposals);
    failures.push_back(std::move(failure));
  }
  return failures;
}
}  // namespace sigloc
