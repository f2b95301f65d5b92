// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "eval/reports/plot.h"

namespace sigloc::detail
{
/// What queries of one kind came to.
struct QueryCurve
{
  std::string title;
  std::vector<double> errors_m;  ///< of the first answers, where there was one
  std::vector<double> times_ms;  ///< one a query
};

/// Returns `errors.png` and `times.png`: the share of the queries that erred, and that took, at
/// most so much. `timed` says what the times are of.
std::vector<std::pair<std::string, Plot>> queryPlots(const std::vector<QueryCurve>& curves,
                                                     const std::string& timed);
}  // namespace sigloc::detail
