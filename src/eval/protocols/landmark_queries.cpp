// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/landmark_queries.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace sigloc::detail
{
LocalMap localMapAt(const LandmarkData& data, std::size_t step, std::size_t count)
{
  LocalMap local;
  for (std::size_t k = step + 1 - std::min(count, step + 1); k <= step; ++k)
  {
    local.add(data.steps[k].motion, data.steps[k].observed);
  }
  return local;
}

std::vector<std::size_t> laterVisits(const LandmarkData& data, const LandmarksOptions& options)
{
  const std::size_t half = data.steps.size() / 2;
  const std::size_t longest =
      *std::max_element(options.local_map_steps.begin(), options.local_map_steps.end());
  std::set<int> mapped;
  for (std::size_t k = 0; k < half; ++k)
  {
    mapped.insert(data.steps[k].identities.begin(), data.steps[k].identities.end());
  }
  std::vector<std::size_t> queries;
  for (std::size_t step = half + longest; step < data.steps.size(); step += options.query_stride)
  {
    std::set<int> seen;
    for (std::size_t k = step + 1 - longest; k <= step; ++k)
    {
      seen.insert(data.steps[k].identities.begin(), data.steps[k].identities.end());
    }
    seen.erase(-1);
    const auto known = std::count_if(seen.begin(), seen.end(),
                                     [&](int identity) { return mapped.count(identity) > 0; });
    const mrpt::math::TPose2D& truth = data.steps[step].truth;
    const bool near =
        std::any_of(data.steps.begin(), data.steps.begin() + static_cast<std::ptrdiff_t>(half),
                    [&](const LandmarkStep& then) {
                      return std::hypot(then.truth.x - truth.x, then.truth.y - truth.y) <=
                             options.visited_distance;
                    });
    const bool visited = near && static_cast<double>(known) >
                                     options.visited_share * static_cast<double>(seen.size());
    if (!options.first_half_map || visited) queries.push_back(step);
  }
  return queries;
}
}  // namespace sigloc::detail
