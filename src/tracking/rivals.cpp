// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/rivals.h"

#include <fmt/core.h>

#include <cmath>

#include "tracking/distinguishing_place.h"

namespace sigloc
{
using mrpt::math::TPose2D;

std::string describeRivals(const std::vector<TrackedHypothesis>& hypotheses, double elsewhere,
                           const DenseField* field)
{
  const bool alone = hypotheses.size() < 2;
  const std::string remain =
      alone ? "one hypothesis remains" : fmt::format("{} hypotheses remain", hypotheses.size());
  double others = 0;
  for (std::size_t k = 1; k < hypotheses.size(); ++k) others += hypotheses[k].weight;
  if (alone || elsewhere > others)
  {
    return remain +
           fmt::format(", and somewhere else weighs {:.2g}: what was seen does not prove {}",
                       elsewhere, alone ? "it" : "the first");
  }
  const TPose2D& first = hypotheses[0].pose.mean;
  const TPose2D& second = hypotheses[1].pose.mean;
  std::string line =
      remain + fmt::format("; the next, of weight {:.2g}, is {:.1f} m away", hypotheses[1].weight,
                           std::hypot(second.x - first.x, second.y - first.y));
  if (field == nullptr) return line;
  const auto place = distinguishingPlace(*field, first, second);
  if (!place) return line + " and the map shows no difference within 8 m";
  return line + fmt::format(" and the map differs {:.1f} m from the robot at {:.0f} deg",
                            std::hypot(place->x, place->y),
                            std::atan2(place->y, place->x) * 180.0 / M_PI);
}
}  // namespace sigloc
