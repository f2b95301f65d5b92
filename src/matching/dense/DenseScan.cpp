// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include "matching/dense/DenseVerifier.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr float kOnSegment = 0.05F;  // [m] from a fitted segment, within which a return is on it
constexpr double kMostLength = 0.2;  // [m] bound of the distance between returns, eq. (6.11)
constexpr double kLeastLength = 0.002;  // [m] of a return that repeats those beside it
constexpr double kSpacing = 0.1;  // [m] of surface for each return that scores

/// Returns the indices 0..n-1 in van der Corput order: every first part is spread evenly.
std::vector<std::uint32_t> interleavedOrder(std::uint32_t n)
{
  // One index of the next half goes between any two of the indices so far.
  if (n == 0) return {};
  std::vector<std::uint32_t> order = {0};
  while (order.size() < n)
  {
    for (std::uint32_t& index : order) index *= 2;
    const std::size_t half = order.size();
    order.resize(2 * half);
    for (std::size_t i = 0; i < half; ++i) order[half + i] = order[i] + 1;
  }
  order.erase(std::remove_if(order.begin(), order.end(), [&](std::uint32_t i) { return i >= n; }),
              order.end());
  return order;
}

/// Returns the distance [m] up to which a beam's neighbour ends on the same surface.
double gapAt(const BeamEnd& beam)
{
  constexpr double kGap = 0.3;  // [m]
  constexpr double kGapPerRange = 0.05;  // [m/m], because beams diverge
  return kGap + kGapPerRange * beam.point.norm();
}

/// What the beams beside a return show of it.
struct Surroundings
{
  bool isolated = true;  ///< none ends near it: clutter, or something thin and far.
  /// Mean distance [m] to the beams beside it on the same surface, in [kLeastLength, kMostLength].
  double length = kMostLength;
};

Surroundings surroundingsOf(const std::vector<BeamEnd>& beams, std::size_t i)
{
  const BeamEnd& beam = beams[i];
  const double gap = gapAt(beam);
  Surroundings surroundings;
  double sum = 0;
  int neighbours = 0;
  for (const std::size_t k : {i - 2, i - 1, i + 1, i + 2})
  {
    // An index before the first beam wraps around to far beyond the last.
    if (k >= beams.size() || beams[k].origin != beam.origin) continue;
    const double dx = beams[k].point.x - beam.point.x;
    const double dy = beams[k].point.y - beam.point.y;
    const double squared = dx * dx + dy * dy;
    if (!(squared < gap * gap)) continue;
    surroundings.isolated = false;
    if (k + 2 == i || k == i + 2) continue;
    sum += std::sqrt(squared);
    ++neighbours;
  }
  if (neighbours > 0)
  {
    surroundings.length = std::clamp(sum / neighbours, kLeastLength, kMostLength);
  }
  return surroundings;
}

/// Returns one return for each kSpacing of surface, at most `most`, in van der Corput order. Where
/// neighbours lie farther apart, each is one. Something near fills many beams, and would otherwise
/// outweigh all the rest.
std::vector<std::uint32_t> spacedReturns(const std::vector<Surroundings>& surroundings,
                                         std::size_t most)
{
  const auto share = [](const Surroundings& around)
  { return std::min(1.0, around.length / kSpacing); };
  double sum = 0;
  for (const Surroundings& around : surroundings) sum += share(around);
  const auto count = static_cast<std::uint32_t>(
      std::min(static_cast<double>(most), std::max(1.0, std::floor(sum))));
  std::vector<std::uint32_t> evenly;  // the returns in the middle of `count` equal shares
  evenly.reserve(count);
  std::uint32_t at = 0;
  double up_to = share(surroundings[at]);
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const double middle = (k + 0.5) * sum / count;
    while (up_to < middle) up_to += share(surroundings[++at]);
    evenly.push_back(at);
  }
  std::vector<std::uint32_t> chosen;
  chosen.reserve(count);
  for (const std::uint32_t k : interleavedOrder(count)) chosen.push_back(evenly[k]);
  return chosen;
}

/// Adds returns that are not among those chosen, evenly, until there are `most`.
void addOthers(std::size_t total, std::size_t most, std::vector<std::uint32_t>& chosen)
{
  std::vector<bool> is_chosen(total, false);
  for (const std::uint32_t i : chosen) is_chosen[i] = true;
  std::vector<std::uint32_t> others;
  others.reserve(total - chosen.size());
  for (std::uint32_t i = 0; i < total; ++i)
  {
    if (!is_chosen[i]) others.push_back(i);
  }
  const std::size_t count = std::min(others.size(), most - std::min(most, chosen.size()));
  for (const std::uint32_t k : interleavedOrder(static_cast<std::uint32_t>(count)))
  {
    chosen.push_back(others[k * others.size() / count]);
  }
}

/// Sets the directions of the residuals: the normal of the wall that a return lies on, or both axes
/// alike. Of several walls the first one counts. Eq. (6.4)
void setPulls(const std::vector<Feature>& features, DenseScan& scan)
{
  const std::size_t n = scan.x.size();
  scan.pull_xx.assign(n, 0.5F);
  scan.pull_xy.assign(n, 0.0F);
  scan.pull_yy.assign(n, 0.5F);
  for (auto feature = features.rbegin(); feature != features.rend(); ++feature)
  {
    if (feature->type != FeatureType::segment) continue;
    const TPoint2D normal = directionVector(*feature);
    const auto nx = static_cast<float>(normal.x);
    const auto ny = static_cast<float>(normal.y);
    const auto x0 = static_cast<float>(feature->position.x);
    const auto y0 = static_cast<float>(feature->position.y);
    const auto reach = static_cast<float>(0.5 * feature->size + kOnSegment);
    const float xx = nx * nx;
    const float xy = nx * ny;
    const float yy = ny * ny;
    // There are no branches, so that compilers can process several returns at once.
    for (std::size_t i = 0; i < n; ++i)
    {
      const float dx = scan.x[i] - x0;
      const float dy = scan.y[i] - y0;
      const float off =
          std::max(std::abs(nx * dx + ny * dy) - kOnSegment, std::abs(ny * dx - nx * dy) - reach);
      const float kept = off > 0 ? 1.0F : 0.0F;
      scan.pull_xx[i] = xx + kept * (scan.pull_xx[i] - xx);
      scan.pull_xy[i] = xy + kept * (scan.pull_xy[i] - xy);
      scan.pull_yy[i] = yy + kept * (scan.pull_yy[i] - yy);
    }
  }
}
}  // namespace

DenseScan makeDenseScan(const ObservedScene& scene, std::size_t max_beams)
{
  DenseScan scan;
  scan.origins = scene.sensor_origins;
  const std::size_t total = scene.beams.size();
  if (total == 0) return scan;
  std::vector<Surroundings> surroundings;
  surroundings.reserve(total);
  for (std::size_t i = 0; i < total; ++i) surroundings.push_back(surroundingsOf(scene.beams, i));
  std::vector<std::uint32_t> chosen = spacedReturns(surroundings, max_beams);
  scan.spaced = chosen.size();
  addOthers(total, max_beams, chosen);

  for (auto* column : {&scan.x, &scan.y, &scan.balance}) column->reserve(chosen.size());
  scan.isolated.reserve(chosen.size());
  scan.origin.reserve(chosen.size());
  for (const std::uint32_t i : chosen)
  {
    const BeamEnd& beam = scene.beams[i];
    scan.x.push_back(static_cast<float>(beam.point.x));
    scan.y.push_back(static_cast<float>(beam.point.y));
    scan.balance.push_back(static_cast<float>(std::sqrt(surroundings[i].length)));
    scan.isolated.push_back(surroundings[i].isolated ? 1 : 0);
    scan.origin.push_back(beam.origin);
  }
  setPulls(scene.features, scan);
  const float sum = std::accumulate(scan.balance.begin(), scan.balance.end(), 0.0F);
  for (float& weight : scan.balance) weight *= static_cast<float>(chosen.size()) / sum;
  return scan;
}
}  // namespace sigloc
