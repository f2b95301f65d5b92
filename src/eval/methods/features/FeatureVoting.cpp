// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/FeatureVoting.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "eval/methods/lattice/DenseSearchSpace.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr std::size_t kKeptPeaks = 200;  // over all headings, before look-alikes are merged

// Ties are broken by the pose, so that the order does not depend on the sorting algorithm.
bool higherScore(const Candidate& a, const Candidate& b)
{
  const auto& p = a.pose.mean;
  const auto& q = b.pose.mean;
  return std::tie(b.score, p.phi, p.y, p.x) < std::tie(a.score, q.phi, q.y, q.x);
}

bool hasHeading(const Feature& feature)
{
  return isSegment(feature.type) || hasBearing(feature.type);
}
}  // namespace

/// An observed and a mapped feature, and the heading that this fixes [rad].
struct FeatureVoting::Pairing
{
  std::uint32_t observed;
  std::uint32_t mapped;
  double heading;
};

struct FeatureVoting::Pairings
{
  std::vector<std::vector<Pairing>> at_heading;  // each in the two bins next to its heading
  std::vector<Pairing> at_any_heading;
};

/// Votes for the positions at one heading. A feature votes for a position once.
struct FeatureVoting::Votes
{
  std::vector<std::uint16_t> count;
  std::vector<std::uint32_t> last_voter;
  std::uint32_t voter = 0;  // stamp of the observed feature that votes; grows from 1
  std::uint64_t cast = 0;
};

FeatureVoting::FeatureVoting(const FeatureMap& map, const FeatureVotingOptions& options)
    : map_(map), options_(options)
{
  if (map.empty()) throw std::invalid_argument("voting needs a map with features");
  low_ = map.features().front().position;
  TPoint2D high = low_;
  for (const Feature& feature : map.features())
  {
    low_.x = std::min(low_.x, feature.position.x);
    low_.y = std::min(low_.y, feature.position.y);
    high.x = std::max(high.x, feature.position.x);
    high.y = std::max(high.y, feature.position.y);
  }
  columns_ = static_cast<std::int32_t>((high.x - low_.x) / options_.cell) + 1;
  rows_ = static_cast<std::int32_t>((high.y - low_.y) / options_.cell) + 1;
  wall_length_.resize(map.features().size(), 0);
  for (std::size_t k = 0; k < map.features().size(); ++k)
  {
    if (map.lineOf(k) < 0) continue;
    for (const std::uint32_t member : map.lines()[static_cast<std::size_t>(map.lineOf(k))].members)
    {
      wall_length_[k] += map.features()[member].size;
    }
  }
}

double FeatureVoting::headingOf(std::uint32_t bin) const
{
  return mrpt::math::wrapToPi(2 * M_PI * bin / options_.headings);
}

bool FeatureVoting::unaryCompatible(const Feature& observed, std::size_t mapped) const
{
  const Feature& feature = map_.features()[mapped];
  if (feature.type != observed.type) return false;
  if (observed.label >= 0 && feature.label >= 0 && observed.label != feature.label) return false;
  if (isSegment(observed.type))
  {
    return observed.size <= wall_length_[mapped] + options_.size_tolerance;
  }
  if (isSeenInPart(observed.type)) return observed.side == feature.side;
  return !hasSize(observed.type) ||
         std::abs(observed.size - feature.size) <= options_.size_tolerance;
}

void FeatureVoting::voteForPlaces(const Feature& observed, std::size_t mapped, double heading,
                                  Votes& votes) const
{
  const Feature& feature = map_.features()[mapped];
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const TPoint2D& p = observed.position;
  const TPoint2D place = feature.position - TPoint2D(c * p.x - s * p.y, s * p.x + c * p.y) - low_;
  // A wall does not fix the position along it: the observed piece may lie anywhere on the mapped
  // one.
  const bool wall = isSegment(observed.type);
  const double slide = wall ? 0.5 * std::max(0.0, feature.size - observed.size) : 0;
  const TPoint2D along = wall ? tangentVector(feature) : TPoint2D(0, 0);
  const auto steps = static_cast<int>(slide / options_.cell);
  for (int k = -steps; k <= steps; ++k)
  {
    const TPoint2D at = place + along * (k * options_.cell);
    const auto column = static_cast<std::int32_t>(std::floor(at.x / options_.cell));
    const auto row = static_cast<std::int32_t>(std::floor(at.y / options_.cell));
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
    const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column);
    ++votes.cast;
    if (votes.last_voter[cell] == votes.voter) continue;
    votes.last_voter[cell] = votes.voter;
    ++votes.count[cell];
  }
}

void FeatureVoting::collectPeaks(const Votes& votes, double heading,
                                 std::vector<Candidate>& peaks) const
{
  const auto& region = options_.region;
  for (std::int32_t row = 0; row < rows_; ++row)
  {
    for (std::int32_t column = 0; column < columns_; ++column)
    {
      const auto centre = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                          static_cast<std::size_t>(column);
      if (votes.count[centre] == 0) continue;
      std::uint32_t sum = 0;
      for (std::int32_t y = std::max(row - 1, 0); y <= std::min(row + 1, rows_ - 1); ++y)
      {
        for (std::int32_t x = std::max(column - 1, 0); x <= std::min(column + 1, columns_ - 1); ++x)
        {
          sum += votes.count[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                             static_cast<std::size_t>(x)];
        }
      }
      if (peaks.size() == kKeptPeaks && sum <= peaks.front().score) continue;
      Candidate peak;
      peak.pose.mean = {low_.x + (column + 0.5) * options_.cell,
                        low_.y + (row + 0.5) * options_.cell, heading};
      peak.score = sum;
      if (region && !region->contains(peak.pose.mean)) continue;
      if (peaks.size() == kKeptPeaks)
      {
        std::pop_heap(peaks.begin(), peaks.end(), higherScore);
        peaks.pop_back();
      }
      peaks.push_back(peak);
      std::push_heap(peaks.begin(), peaks.end(), higherScore);
    }
  }
}

FeatureVoting::Pairings FeatureVoting::pair(const std::vector<Feature>& observed) const
{
  Pairings pairings;
  pairings.at_heading.resize(options_.headings);
  const double bins_per_radian = options_.headings / (2 * M_PI);
  for (std::uint32_t i = 0; i < observed.size(); ++i)
  {
    for (std::uint32_t k = 0; k < map_.features().size(); ++k)
    {
      if (!unaryCompatible(observed[i], k)) continue;
      if (!hasHeading(observed[i]))
      {
        pairings.at_any_heading.push_back({i, k, 0});
        continue;
      }
      const double heading =
          mrpt::math::wrapTo2Pi(map_.features()[k].direction - observed[i].direction);
      const auto bin =
          static_cast<std::uint32_t>(std::floor(heading * bins_per_radian)) % options_.headings;
      pairings.at_heading[bin].push_back({i, k, heading});
      pairings.at_heading[(bin + 1) % options_.headings].push_back({i, k, heading});
    }
  }
  return pairings;
}

FeatureVoting::Result FeatureVoting::vote(const std::vector<Feature>& observed) const
{
  const Pairings pairings = pair(observed);
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  Votes votes{std::vector<std::uint16_t>(cells), std::vector<std::uint32_t>(cells, 0)};
  // Pairings come in the order of the observed features, so a change of feature is a new voter.
  const auto cast = [&](const std::vector<Pairing>& list, std::optional<double> heading)
  {
    std::optional<std::uint32_t> voter;
    for (const Pairing& pairing : list)
    {
      if (voter != pairing.observed) ++votes.voter;
      voter = pairing.observed;
      voteForPlaces(observed[pairing.observed], pairing.mapped, heading.value_or(pairing.heading),
                    votes);
    }
  };
  std::vector<Candidate> peaks;
  for (std::uint32_t h = 0; h < options_.headings; ++h)
  {
    std::fill(votes.count.begin(), votes.count.end(), std::uint16_t{0});
    cast(pairings.at_heading[h], std::nullopt);
    cast(pairings.at_any_heading, headingOf(h));
    collectPeaks(votes, headingOf(h), peaks);
  }
  std::sort(peaks.begin(), peaks.end(), higherScore);
  return {distinctCandidates(peaks, options_.max_candidates), votes.cast};
}
}  // namespace sigloc
