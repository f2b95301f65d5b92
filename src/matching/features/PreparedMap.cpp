// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/PreparedMap.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace sigloc
{
namespace
{
constexpr double kTwoPi = 2 * M_PI;
constexpr double kTypicalPiece = 1.0;  // [m] length of an observed piece of wall, eq. (5.9)

/// Returns the concentration kappa of (5.9): how much more often two directions of the map agree
/// than evenly spread ones. It is 1 for those, and about 9 for the four of a rectangular building.
double directionConcentration(const std::vector<Feature>& features, FeatureType type)
{
  constexpr std::size_t kBins = 36;
  std::array<double, kBins> weight{};
  double total = 0;
  for (const Feature& feature : features)
  {
    if (feature.type != type) continue;
    const double turn = mrpt::math::wrapTo2Pi(feature.direction) / kTwoPi;
    const double amount = isSegment(type) ? feature.size + kTypicalPiece : 1.0;
    weight[static_cast<std::size_t>(turn * kBins) % kBins] += amount;
    total += amount;
  }
  if (!(total > 0)) return 1;
  double squares = 0;
  for (const double w : weight) squares += (w / total) * (w / total);
  return std::max(1.0, kBins * squares);
}
}  // namespace

PreparedMap::PreparedMap(const FeatureMap& map) : map_(&map), grid_(map.features())
{
  const std::vector<Feature>& features = map.features();
  area_ = std::max(1.0, map.area());
  views_.reserve(features.size());
  std::array<double, kFeatureTypes> count{};
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    DirectedFeature view = directed(features[k]);
    if (map.lineOf(k) >= 0)
    {
      for (const std::uint32_t member :
           map.lines()[static_cast<std::size_t>(map.lineOf(k))].members)
      {
        const Feature& piece = features[member];
        const double at = dot(piece.position - features[k].position, view.tangent());
        view.start = std::min(view.start, at - 0.5 * piece.size);
        view.end = std::max(view.end, at + 0.5 * piece.size);
      }
    }
    views_.push_back(view);
    const std::size_t type = typeIndex(features[k].type);
    const auto& p = features[k].position_covariance;
    const double largest =
        0.5 * (p(0, 0) + p(1, 1)) + std::hypot(0.5 * (p(0, 0) - p(1, 1)), p(0, 1));
    position_variance_[type] = std::max(position_variance_[type], largest);
    typical_position_variance_[type] += largest;
    typical_direction_variance_[type] += features[k].direction_variance;
    count[type] += 1;
    clutter_[type] += isSegment(features[k].type) ? features[k].size + kTypicalPiece : 1.0;
  }
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    const auto type = static_cast<FeatureType>(t);
    typical_position_variance_[t] /= std::max(1.0, count[t]);
    typical_direction_variance_[t] /= std::max(1.0, count[t]);
    const bool directional = isSegment(type) || hasBearing(type);
    clutter_[t] = std::max(clutter_[t], 1.0) / area_;
    if (directional) clutter_[t] *= directionConcentration(features, type) / kTwoPi;
  }
}

double PreparedMap::coveredShare(std::size_t k, double low, double high, double tolerance) const
{
  const double length = std::max(high - low, 1e-6);
  const auto overlap = [&](double from, double to)
  { return std::max(0.0, std::min(high, to + tolerance) - std::max(low, from - tolerance)); };
  const std::vector<Feature>& features = map_->features();
  const std::int32_t line = map_->lineOf(k);
  if (line < 0) return overlap(views_[k].start, views_[k].end) / length;
  double covered = 0;
  for (const std::uint32_t member : map_->lines()[static_cast<std::size_t>(line)].members)
  {
    const Feature& piece = features[member];
    const double at = dot(piece.position - features[k].position, views_[k].tangent());
    covered += overlap(at - 0.5 * piece.size, at + 0.5 * piece.size);
  }
  return std::min(1.0, covered / length);
}
}  // namespace sigloc
