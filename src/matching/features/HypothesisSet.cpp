// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/HypothesisSet.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sigloc
{
namespace
{
constexpr std::uint32_t kUnmatched = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostItems = 4096;  // hypotheses kept; with more the worse half is dropped
constexpr std::int64_t kHeadingCells = 21;  // of the grid, each at least kSamePlaceAngle

bool ranksBefore(const FeatureHypothesis& a, const FeatureHypothesis& b)
{
  if (a.log_odds != b.log_odds) return a.log_odds > b.log_odds;
  const auto& p = a.pose.mean;
  const auto& q = b.pose.mean;
  if (p.x != q.x) return p.x < q.x;
  if (p.y != q.y) return p.y < q.y;
  return p.phi < q.phi;
}

struct CellIndex
{
  std::int64_t x;
  std::int64_t y;
  std::int64_t heading;
};

CellIndex cellOf(const mrpt::math::TPose2D& pose)
{
  const double turn = mrpt::math::wrapTo2Pi(pose.phi) / (2 * M_PI);
  return {static_cast<std::int64_t>(std::floor(pose.x / kSamePlaceDistance)),
          static_cast<std::int64_t>(std::floor(pose.y / kSamePlaceDistance)),
          static_cast<std::int64_t>(turn * static_cast<double>(kHeadingCells)) % kHeadingCells};
}

std::uint64_t keyOf(const CellIndex& cell)
{
  return (static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15ULL) ^
         (static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4FULL) ^
         (static_cast<std::uint64_t>(cell.heading) * 0x165667B19E3779F9ULL);
}

std::size_t bitOf(const FeaturePairing& pairing)
{
  const std::uint64_t mixed =
      (static_cast<std::uint64_t>(pairing.observed) << 32 | pairing.mapped) * 0x9E3779B97F4A7C15ULL;
  return static_cast<std::size_t>(mixed >> 50);  // 14 bits
}
}  // namespace

void HypothesisSet::enterCells(std::uint32_t index)
{
  Item& item = items_[index];
  cells_[keyOf(cellOf(item.hypothesis.pose.mean))].push_back(index);
  item.mapped_of.assign(observed_count_, kUnmatched);
  for (const FeaturePairing& pairing : item.hypothesis.pairings)
  {
    item.mapped_of[pairing.observed] = pairing.mapped;
    const std::size_t bit = bitOf(pairing);
    pairing_bits_[bit >> 6] |= 1ULL << (bit & 63);
  }
  best_support_ = std::max(best_support_, item.hypothesis.support);
}

void HypothesisSet::add(FeatureHypothesis hypothesis)
{
  const CellIndex cell = cellOf(hypothesis.pose.mean);
  for (std::int64_t k = 0; k < 27; ++k)
  {
    const CellIndex near{cell.x + k % 3 - 1, cell.y + k / 3 % 3 - 1,
                         (cell.heading + k / 9 - 1 + kHeadingCells) % kHeadingCells};
    const auto found = cells_.find(keyOf(near));
    if (found == cells_.end()) continue;
    for (const std::uint32_t index : found->second)
    {
      const FeatureHypothesis& other = items_[index].hypothesis;
      if (!samePlace(other.pose.mean, hypothesis.pose.mean)) continue;
      if (!ranksBefore(hypothesis, other)) return;
    }
  }
  // Worse ones near the new one stay until the ranking drops them. One may be the only hypothesis
  // near a pose that the new one is not near.
  items_.push_back({std::move(hypothesis), {}});
  enterCells(static_cast<std::uint32_t>(items_.size() - 1));
  if (items_.size() > kMostItems) prune();
}

void HypothesisSet::prune()
{
  std::sort(items_.begin(), items_.end(),
            [](const Item& a, const Item& b) { return ranksBefore(a.hypothesis, b.hypothesis); });
  items_.resize(kMostItems / 2);
  cells_.clear();
  std::fill(pairing_bits_.begin(), pairing_bits_.end(), 0);
  for (std::uint32_t index = 0; index < items_.size(); ++index) enterCells(index);
}

bool HypothesisSet::explains(const FeaturePairing& first, const FeaturePairing& second) const
{
  const auto marked = [&](const FeaturePairing& pairing)
  {
    const std::size_t bit = bitOf(pairing);
    return (pairing_bits_[bit >> 6] >> (bit & 63) & 1) != 0;
  };
  if (!marked(first) || !marked(second)) return false;
  return std::any_of(items_.begin(), items_.end(),
                     [&](const Item& item)
                     {
                       return item.mapped_of[first.observed] == first.mapped &&
                              item.mapped_of[second.observed] == second.mapped;
                     });
}

const FeatureHypothesis* HypothesisSet::best() const
{
  const FeatureHypothesis* best = nullptr;
  for (const Item& item : items_)
  {
    if (!best || ranksBefore(item.hypothesis, *best)) best = &item.hypothesis;
  }
  return best;
}

std::vector<FeatureHypothesis> HypothesisSet::ranked(std::size_t count) const
{
  std::vector<const FeatureHypothesis*> order;
  order.reserve(items_.size());
  for (const Item& item : items_) order.push_back(&item.hypothesis);
  std::sort(order.begin(), order.end(),
            [](const auto* a, const auto* b) { return ranksBefore(*a, *b); });
  std::vector<FeatureHypothesis> kept;
  for (const FeatureHypothesis* candidate : order)
  {
    if (kept.size() >= count) break;
    const bool taken = std::any_of(kept.begin(), kept.end(),
                                   [&](const FeatureHypothesis& other)
                                   { return samePlace(other.pose.mean, candidate->pose.mean); });
    if (!taken) kept.push_back(*candidate);
  }
  return kept;
}
}  // namespace sigloc
