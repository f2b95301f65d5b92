// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/keypoints/KeyPairSearch.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr std::size_t kMaxPairs = 200;  // of one scene
constexpr std::size_t kPairsPerPoint = 8;  // that one key point may be in
constexpr double kSupportDistance = 0.4;  // [m]
constexpr double kSupportAngle = 0.12;  // [rad]
constexpr double kMapDirectionVariance = 1e-4;  // [rad^2] of a mapped direction, for weights

/// The shares that the directions of both key points have in the heading. The line between the two
/// has the rest. Each counts by its certainty. Eq. (5.2)
struct HeadingShares
{
  double first = 0, second = 0;
};

HeadingShares headingShares(const KeyPair& observed, const KeyPoint& a, const KeyPoint& b)
{
  const bool first = a.kind != KeyPointKind::circle;
  const bool second = b.kind != KeyPointKind::circle;
  const double spread =
      0.5 * (a.covariance.xx + a.covariance.yy + b.covariance.xx + b.covariance.yy) + 2e-3;
  const double by_line = observed.distance * observed.distance / spread;
  const double by_first = first ? 1 / (a.direction_variance + kMapDirectionVariance) : 0;
  const double by_second = second && first ? 1 / (b.direction_variance + kMapDirectionVariance) : 0;
  const double sum = by_line + by_first + by_second;
  return {by_first / sum, by_second / sum};
}

/// Returns whether a pair that proposed `p` supports a pose. The type of its angle is that in which
/// angles are compared.
template <class Angle>
bool supports(const PoseProposal& p, float x, float y, Angle phi)
{
  constexpr auto kSquaredDistance = static_cast<float>(kSupportDistance * kSupportDistance);
  const float dx = p.x - x;
  const float dy = p.y - y;
  return dx * dx + dy * dy <= kSquaredDistance && std::abs(wrapToPi(p.phi - phi)) <= kSupportAngle;
}
}  // namespace

KeyPairSearch::KeyPairSearch(const KeyPairIndex& index, const std::vector<Feature>& observed)
    : index_(index), counted_(static_cast<float>(kSupportDistance))
{
  const std::vector<KeyPoint> points = observedKeyPoints(observed);
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    for (std::uint32_t j = i + 1; j < points.size(); ++j)
    {
      const bool ordered = points[i].kind <= points[j].kind;
      Pair pair;
      pair.a = ordered ? i : j;
      pair.b = ordered ? j : i;
      const auto between = points[j].position - points[i].position;
      const double distance = std::hypot(between.x, between.y);
      if (distance < KeyPairIndex::kMinDistance || distance >= index.range()) continue;
      pair.observed = keyPair(points[pair.a], points[pair.b]);
      const HeadingShares shares = headingShares(pair.observed, points[pair.a], points[pair.b]);
      pair.share_first = shares.first;
      pair.share_second = shares.second;
      pair.begin = runs_.size();
      pair.count = index.find(pair.observed, runs_);
      pair.end = runs_.size();
      if (pair.count > 0) pairs_.push_back(pair);
    }
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const Pair& a, const Pair& b) { return a.count < b.count; });
  // A key point that is not mapped must not use up the pairs.
  std::vector<std::size_t> uses(points.size(), 0);
  pairs_.erase(std::remove_if(pairs_.begin(), pairs_.end(),
                              [&](const Pair& pair)
                              {
                                if (std::max(uses[pair.a], uses[pair.b]) >= kPairsPerPoint)
                                  return true;
                                ++uses[pair.a];
                                ++uses[pair.b];
                                return false;
                              }),
               pairs_.end());
  if (pairs_.size() > kMaxPairs) pairs_.resize(kMaxPairs);
  counted_for_.assign(pairs_.size(), 0);
}

std::vector<PoseProposal> KeyPairSearch::next(std::size_t wanted)
{
  const std::size_t before = proposals_.size();
  while (proposals_.size() < wanted && next_ < pairs_.size())
  {
    propose(static_cast<std::uint32_t>(next_++));
  }
  return {proposals_.begin() + static_cast<std::ptrdiff_t>(before), proposals_.end()};
}

void KeyPairSearch::propose(std::uint32_t index)
{
  const Pair& pair = pairs_[index];
  matches_.clear();
  for (std::size_t r = pair.begin; r < pair.end; ++r)
  {
    index_.collect(pair.observed, runs_[r], matches_);
  }
  entries_read_ += pair.count;
  for (const KeyPairIndex::Match& match : matches_)
  {
    // The heading by the line, by the first direction and by the second one differ by what the
    // map has more in bearing and turn.
    const double by_line = match.bearing - pair.observed.bearing;
    const auto heading =
        static_cast<float>(by_line - (pair.share_first + pair.share_second) * match.first +
                           pair.share_second * match.second);
    const float c = std::cos(heading);
    const float s = std::sin(heading);
    proposals_.push_back({static_cast<float>(match.x - c * pair.observed.x + s * pair.observed.y),
                          static_cast<float>(match.y - s * pair.observed.x - c * pair.observed.y),
                          heading});
    owners_.push_back(index);
  }
}

std::size_t KeyPairSearch::supportersOf(const TPose2D& pose) const
{
  const auto x = static_cast<float>(pose.x);
  const auto y = static_cast<float>(pose.y);
  std::size_t supporters = 0;
  std::int64_t last = -1;  // proposals come pair by pair
  for (std::size_t k = 0; k < proposals_.size(); ++k)
  {
    if (owners_[k] == last || !supports(proposals_[k], x, y, pose.phi)) continue;
    last = owners_[k];
    ++supporters;
  }
  return supporters;
}

bool KeyPairSearch::anySupportedBy(std::size_t pairs)
{
  while (most_supporters_ < pairs && supports_.size() < proposals_.size())
  {
    countSupporters(static_cast<std::uint32_t>(supports_.size()));
  }
  return most_supporters_ >= pairs;
}

/// Counts the pairs that support the next proposal, and its own pair for those before it. They come
/// pair by pair, so a pair that supports one of these was counted if it was the last one.
void KeyPairSearch::countSupporters(std::uint32_t proposal)
{
  const PoseProposal& p = proposals_[proposal];
  const std::uint32_t owner = owners_[proposal];
  Support own{1, owner};
  counted_for_[owner] = proposal + 1;
  counted_.anyNear(p.x, p.y,
                   [&](std::uint32_t k)
                   {
                     const PoseProposal& other = proposals_[k];
                     if (!supports(p, other.x, other.y, other.phi)) return false;
                     Support& support = supports_[k];
                     if (support.last != owner) support = {support.pairs + 1, owner};
                     most_supporters_ = std::max(most_supporters_, support.pairs);
                     std::uint32_t& counted_for = counted_for_[owners_[k]];
                     if (counted_for != proposal + 1) ++own.pairs;
                     counted_for = proposal + 1;
                     return false;
                   });
  most_supporters_ = std::max(most_supporters_, own.pairs);
  counted_.add(p.x, p.y);
  supports_.push_back(own);
}
}  // namespace sigloc
