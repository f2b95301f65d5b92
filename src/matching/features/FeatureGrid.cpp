// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/FeatureGrid.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

FeatureGrid::FeatureGrid(const std::vector<Feature>& features)
{
  chooseCell(features);
  std::size_t side = 1;
  while (side * side < 2 * features.size()) side *= 2;
  column_mask_ = row_mask_ = side - 1;
  sortIntoSlots(sampled(features), side * side);
}

/// Chooses cells of about one feature each. Their size is bounded, because outliers may enlarge the
/// bounding box.
void FeatureGrid::chooseCell(const std::vector<Feature>& features)
{
  TPoint2D low{0, 0};
  TPoint2D high{0, 0};
  if (!features.empty()) low = high = features.front().position;
  for (const Feature& feature : features)
  {
    low = {std::min(low.x, feature.position.x), std::min(low.y, feature.position.y)};
    high = {std::max(high.x, feature.position.x), std::max(high.y, feature.position.y)};
  }
  origin_ = (low + high) * 0.5;
  const double area = (high.x - low.x) * (high.y - low.y);
  constexpr double kSmallestCell = 0.5;  // [m]
  constexpr double kLargestCell = 4.0;  // [m]
  cell_ =
      std::clamp(std::sqrt(area / static_cast<double>(std::max<std::size_t>(1, features.size()))),
                 kSmallestCell, kLargestCell);
}

/// Returns the place of every feature, and places along a segment no farther apart than a cell.
std::vector<FeatureGrid::Sample> FeatureGrid::sampled(const std::vector<Feature>& features) const
{
  std::vector<Sample> samples;
  samples.reserve(features.size());
  for (std::size_t k = 0; k < features.size(); ++k)
  {
    const Feature& feature = features[k];
    const bool wall = isSegment(feature.type);
    const std::size_t pieces =
        wall ? 1 + static_cast<std::size_t>(std::ceil(feature.size / cell_)) : 1;
    for (std::size_t piece = 0; piece < pieces; ++piece)
    {
      TPoint2D at = feature.position - origin_;
      if (wall)
      {
        // A wall without length is one piece.
        const std::size_t gaps = std::max<std::size_t>(1, pieces - 1);
        const double share = static_cast<double>(piece) / static_cast<double>(gaps);
        at = at + tangentVector(feature) * ((share - 0.5) * feature.size);
      }
      samples.push_back({slotOf(cellOf(at.x), cellOf(at.y)),
                         {static_cast<float>(at.x), static_cast<float>(at.y),
                          static_cast<std::uint32_t>(k), feature.type}});
    }
  }
  return samples;
}

void FeatureGrid::sortIntoSlots(const std::vector<Sample>& samples, std::size_t slots)
{
  starts_.assign(slots + 1, 0);
  for (const Sample& sample : samples) ++starts_[sample.slot + 1];
  for (std::size_t slot = 1; slot < starts_.size(); ++slot) starts_[slot] += starts_[slot - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  entries_.resize(samples.size());
  for (const Sample& sample : samples) entries_[next[sample.slot]++] = sample.entry;
}
}  // namespace sigloc
