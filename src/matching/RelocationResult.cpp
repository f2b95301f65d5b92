// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/RelocationResult.h"

#include <fmt/core.h>
#include <mrpt/math/wrap2pi.h>

namespace sigloc
{
const char* toString(Verdict verdict)
{
  switch (verdict)
  {
    case Verdict::localized:
      return "localized";
    case Verdict::ambiguous:
      return "ambiguous";
    case Verdict::not_here:
      return "not here";
    case Verdict::too_little_seen:
      return "too little seen";
  }
  return "unknown";
}

std::string probabilityText(double probability, int digits)
{
  constexpr double kExact = 1e-9;  // 0.57 is stored as a little less
  const double unit = std::pow(10, digits);
  return fmt::format("{:.{}f}", std::floor(probability * unit + kExact) / unit, digits);
}

bool PoseRegion::contains(const mrpt::math::TPose2D& pose) const
{
  return pose.x >= x_min && pose.x <= x_max && pose.y >= y_min && pose.y <= y_max &&
         std::abs(mrpt::math::wrapToPi(pose.phi - heading)) <= heading_tolerance;
}
}  // namespace sigloc
