// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/feature_values.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "geometry/cell_key.h"

namespace sigloc
{
namespace
{
constexpr double kFarthest = 1e6;  // [m] of a position from the origin of its frame
constexpr double kLargestSize = 2 * kFarthestReturn;  // [m] between two returns of one laser
constexpr double kLargestVariance = 1e4;  // [m^2, rad^2], a greater one carries no information
constexpr double kRounding = 1e-3;  // relative, of sums of single floats

bool isWithin(double value, double low, double high)
{
  return value >= low && value <= high;  // false for NaN
}

bool isPlace(const mrpt::math::TPoint2D& point)
{
  return isWithin(point.x, -kFarthest, kFarthest) && isWithin(point.y, -kFarthest, kFarthest);
}

bool isVariance(double value)
{
  return isWithin(value, 0, kLargestVariance);
}

bool isCovariance(const mrpt::math::CMatrixDouble22& p)
{
  if (!isVariance(p(0, 0)) || !isVariance(p(1, 1))) return false;
  const double both = p(0, 0) * p(1, 1);
  const double most = both + 1e-9 * (1e-12 + both);
  return p(0, 1) * p(0, 1) <= most && p(1, 0) * p(1, 0) <= most;  // false for NaN
}
}  // namespace

std::optional<std::string> flawOf(const Feature& feature, std::size_t count)
{
  const auto parents = static_cast<std::int64_t>(count);
  if (typeIndex(feature.type) >= kFeatureTypes) return "has no known type";
  if (feature.side > WallSide::end) return "has no known side";
  if (!isPlace(feature.position))
  {
    return fmt::format("has the position ({:g}, {:g}) m", feature.position.x, feature.position.y);
  }
  if (!isWithin(feature.direction, -2 * M_PI, 2 * M_PI))
  {
    return fmt::format("has the direction {:g} rad", feature.direction);
  }
  if (!isWithin(feature.size, 0, kLargestSize))
  {
    return fmt::format("has the size {:g}, not one of 0 to {:g}", feature.size, kLargestSize);
  }
  if (!isCovariance(feature.position_covariance) || !isVariance(feature.direction_variance) ||
      !isVariance(feature.size_variance))
  {
    return fmt::format("has a covariance that is not positive semi-definite, or beyond {:g}",
                       kLargestVariance);
  }
  if (feature.parent < -1 || feature.parent >= parents)
  {
    return fmt::format("has the parent {}, and there are {} features", feature.parent, count);
  }
  return std::nullopt;
}

std::optional<std::string> Crowding::add(const Feature& feature)
{
  const auto cell = [](double at) { return static_cast<std::int64_t>(std::floor(at / kSide)); };
  std::uint32_t& count = counts_[cellKey(cell(feature.position.x), cell(feature.position.y))];
  if (++count <= kMost) return std::nullopt;
  return fmt::format("has more than {} others within {:g} m x {:g} m", kMost, kSide, kSide);
}

double outlineLength(const Feature& feature)
{
  if (isSegment(feature.type)) return feature.size;
  return isRound(feature.type) ? 2 * M_PI * feature.size : 0;
}

void checkScene(const ObservedScene& scene)
{
  const auto& origins = scene.sensor_origins;
  for (std::size_t k = 0; k < origins.size(); ++k)
  {
    if (isPlace(origins[k])) continue;
    throw std::invalid_argument(fmt::format("sensor origin {} is not a place on a robot", k));
  }
  for (std::size_t k = 0; k < scene.beams.size(); ++k)
  {
    const BeamEnd& beam = scene.beams[k];
    if (beam.origin >= origins.size())
    {
      throw std::invalid_argument(
          fmt::format("beam {} names the sensor origin {} of {}", k, beam.origin, origins.size()));
    }
    const double range = (beam.point - origins[beam.origin]).norm();
    if (range <= kFarthestReturn * (1 + kRounding)) continue;
    throw std::invalid_argument(fmt::format("beam {} has the range {:g} m", k, range));
  }
  for (std::size_t k = 0; k < scene.features.size(); ++k)
  {
    const auto flaw = flawOf(scene.features[k], scene.features.size());
    if (flaw) throw std::invalid_argument(fmt::format("feature {} {}", k, *flaw));
  }
}
}  // namespace sigloc
