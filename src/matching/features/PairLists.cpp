// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/features/PairLists.h"

#include <numeric>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
double distanceToExtent(const TPoint2D& p, const DirectedFeature& view)
{
  const TPoint2D from = p - view.position();
  if (!isSegment(view.type())) return std::sqrt(dot(from, from));
  const double half = 0.5 * view.feature->size;
  const double along = std::clamp(dot(from, view.tangent()), -half, half);
  const TPoint2D rest = from - view.tangent() * along;
  return std::sqrt(dot(rest, rest));
}

bool extentsCross(const DirectedFeature& a, const DirectedFeature& b)
{
  if (!isSegment(a.type()) || !isSegment(b.type())) return false;
  const auto separates = [](const DirectedFeature& line, const DirectedFeature& piece)
  {
    const double p = dot(segmentStart(*piece.feature) - line.position(), line.normal);
    const double q = dot(segmentEnd(*piece.feature) - line.position(), line.normal);
    return (p > 0) == (q > 0);
  };
  return !separates(a, b) && !separates(b, a);
}

/// Returns the shortest distance [m] between the mapped pieces themselves.
double distanceBetween(const DirectedFeature& a, const DirectedFeature& b)
{
  if (extentsCross(a, b)) return 0;
  double best = std::min(distanceToExtent(a.position(), b), distanceToExtent(b.position(), a));
  if (isSegment(a.type()))
  {
    best = std::min({best, distanceToExtent(segmentStart(*a.feature), b),
                     distanceToExtent(segmentEnd(*a.feature), b)});
  }
  if (isSegment(b.type()))
  {
    best = std::min({best, distanceToExtent(segmentStart(*b.feature), a),
                     distanceToExtent(segmentEnd(*b.feature), a)});
  }
  return best;
}

/// Gathers the indices of the features within the cut-off of feature k, without k, ascending.
void gatherNeighbours(const PreparedMap& map, std::size_t k, double cut_off,
                      std::vector<std::uint32_t>& neighbours)
{
  neighbours.clear();
  if (!std::isfinite(cut_off))
  {
    neighbours.resize(map.size());
    std::iota(neighbours.begin(), neighbours.end(), 0U);
    neighbours.erase(neighbours.begin() + static_cast<std::ptrdiff_t>(k));
    return;
  }
  const DirectedFeature& view = map.view(k);
  const double half = isSegment(view.type()) ? 0.5 * view.feature->size : 0.0;
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    map.grid().visitNear(view.position(), cut_off + half, static_cast<FeatureType>(t),
                         [&](std::uint32_t l) { neighbours.push_back(l); });
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  const auto too_far = [&](std::uint32_t l)
  { return l == k || distanceBetween(view, map.view(l)) > cut_off; };
  neighbours.erase(std::remove_if(neighbours.begin(), neighbours.end(), too_far), neighbours.end());
}
}  // namespace

PairLists::PairLists(const PreparedMap& map, double cut_off) : cut_off_(cut_off)
{
  rows_.resize(map.size() + 1);
  std::vector<std::uint32_t> neighbours;
  std::array<std::vector<Entry>, kFeatureTypes> by_type;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    gatherNeighbours(map, k, cut_off, neighbours);
    for (auto& row : by_type) row.clear();
    for (const std::uint32_t l : neighbours)
    {
      const BinaryKey key = binaryKey(map.view(k), map.view(l));
      const std::size_t first = typeIndex(map.view(k).type());
      const std::size_t second = typeIndex(map.view(l).type());
      key_variance_[first][second] = std::max(key_variance_[first][second], key.variance);
      by_type[second].push_back({static_cast<float>(key.value), l});
    }
    for (std::size_t t = 0; t < kFeatureTypes; ++t)
    {
      std::sort(by_type[t].begin(), by_type[t].end(),
                [](const Entry& a, const Entry& b)
                { return a.key != b.key ? a.key < b.key : a.feature < b.feature; });
      rows_[k][t] = static_cast<std::uint32_t>(entries_.size());
      entries_.insert(entries_.end(), by_type[t].begin(), by_type[t].end());
    }
  }
  rows_[map.size()].fill(static_cast<std::uint32_t>(entries_.size()));
  entries_.shrink_to_fit();
}

double PairLists::cutOffFor(const PreparedMap& map, const GeneratorOptions& options)
{
  if (map.size() <= options.max_neighbours + 1) return kUncut;
  // The distance within which the wanted number of neighbours is, over a sample of features.
  constexpr std::size_t kSamples = 64;
  const std::size_t samples = std::min(kSamples, map.size());
  std::vector<float> distances;
  distances.reserve(samples * map.size());
  for (std::size_t s = 0; s < samples; ++s)
  {
    const DirectedFeature& view = map.view(s * map.size() / samples);
    for (std::size_t l = 0; l < map.size(); ++l)
    {
      distances.push_back(static_cast<float>(distanceToExtent(view.position(), map.view(l))));
    }
  }
  const auto wanted =
      distances.begin() + static_cast<std::ptrdiff_t>(samples * (options.max_neighbours + 1));
  std::nth_element(distances.begin(), wanted, distances.end());
  return static_cast<double>(*wanted);
}
}  // namespace sigloc
