// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/query_plots.h"

#include <algorithm>

namespace sigloc::detail
{
std::vector<std::pair<std::string, Plot>> queryPlots(const std::vector<QueryCurve>& curves,
                                                     const std::string& timed)
{
  Plot errors{"Error of the first candidate",
              "distance from the truth [m]",
              "share of queries",
              true,
              false,
              {}};
  Plot times{timed, "CPU time [ms]", "share of queries", true, false, {}};
  for (const QueryCurve& curve : curves)
  {
    std::vector<double> distances;
    // A logarithmic axis has no zero: a millimetre stands for less.
    for (const double error : curve.errors_m) distances.push_back(std::max(0.001, error));
    errors.series.push_back(cumulativeShare(curve.title, distances, curve.times_ms.size()));
    times.series.push_back(cumulativeShare(curve.title, curve.times_ms, curve.times_ms.size()));
  }
  return {{"errors.png", errors}, {"times.png", times}};
}
}  // namespace sigloc::detail
