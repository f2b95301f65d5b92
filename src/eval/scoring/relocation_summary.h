// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "config/columns.h"
#include "eval/scoring/relocation_scoring.h"
#include "eval/scoring/statistics.h"

namespace sigloc
{
/// What a query adds to a summary, or a run that is judged as one. Shares leave out the queries
/// that have no value.
struct Outcome
{
  bool saw_nothing = false;
  bool claims_verdict = false;  ///< the method says whether it is sure
  bool confident = false;
  bool confident_right = false;
  bool confidently_wrong = false;
  bool inaccurate = false;
  bool cut_short = false;  ///< the search ended at its budget
  std::optional<bool> right;  ///< the first candidate
  std::optional<bool> tight;  ///< and by a few degrees
  std::optional<bool> among_ten;  ///< one of the first ten is right
  std::optional<bool> proposed;
  PoseError error;  ///< of a right answer, else NaN
  double poses_scored = std::numeric_limits<double>::quiet_NaN();
  double proposals = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times_ms;  ///< of the answer; of a drive, of each step
};

/// A method over all its queries.
struct RelocationSummary
{
  std::string method;
  std::vector<Outcome> records;
  double reference_ms = std::numeric_limits<double>::quiet_NaN();  ///< see columns: "ratio"

  void add(const RelocationRecord& record);
};

/// The median time of a group's outcomes [ms].
template <class Group>
double medianTime(const Group& group)
{
  return quantiles(&Outcome::times_ms)(group).median;
}

/// What every sub-command's summary.json holds of a method, and the table of relocations.
Columns<RelocationSummary> summaryColumns();

/// The methods of rows, each once, in their order.
template <class Row>
std::vector<std::string> methodsOf(const std::vector<Row>& rows)
{
  std::vector<std::string> methods;
  for (const Row& row : rows)
  {
    const bool is_new = std::find(methods.begin(), methods.end(), row.method) == methods.end();
    if (is_new) methods.push_back(row.method);
  }
  return methods;
}

/// The object "methods" of summary.json: each method over all its rows, then the `rows`.
template <class Row>
nlohmann::ordered_json methodsJson(const std::vector<Row>& rows, const Columns<Row>& columns,
                                   const std::optional<double>& peak_rss_mb)
{
  nlohmann::ordered_json json;
  for (const std::string& method : methodsOf(rows))
  {
    RelocationSummary all{method, {}};
    nlohmann::ordered_json entries;
    for (const Row& row : rows)
    {
      if (row.method != method) continue;
      all.records.insert(all.records.end(), row.records.begin(), row.records.end());
      entries.push_back(toJson(columns, row));
    }
    json[method] = toJson(summaryColumns(), all);
    if (peak_rss_mb) json[method]["peak_rss_mb"] = *peak_rss_mb;
    json[method]["rows"] = entries;
  }
  return json;
}

/// What the columns and the methods mean, as sections of Markdown.
std::string relocationDefinitions();
}  // namespace sigloc
