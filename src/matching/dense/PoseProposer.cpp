// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/PoseProposer.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kParallel = 0.35;  // [rad] between walls, below which one of them is enough
constexpr double kSameLine = 0.5;  // [m] between parallel walls, below which one is enough
constexpr double kMinPairDistance = 0.8;  // [m] of circles; shorter pairs give poor headings
constexpr std::size_t kOthers = 16384;  // proposals by all but walls, for which memory is reserved
constexpr double kRadiusTolerance = 0.3;  // [m] gate on the radius of an observed circle
constexpr double kPairTolerance = 0.15;  // [m] gate on the distance of two circles
constexpr double kPairRange = 15.0;  // [m] largest distance of a pair of circles
constexpr double kSlideStep = 0.4;  // [m] of a slid wall
constexpr double kOverhang = 0.3;  // share of an observed wall that may lie beyond the mapped one
constexpr double kLengthTolerance = 0.3;  // [m] by which an observed wall may be the longer one

constexpr std::uint32_t kSlidWalls = 1;  // observed walls that are slid at least
constexpr std::uint32_t kMostSlidWalls = 3;  // observed walls of different direction
constexpr std::uint32_t kEnough = 2000;  // proposals; with fewer another observed wall is slid
constexpr std::uint32_t kMaxPairs = 3;  // observed pairs of circles tried, rarest distance first
// The same in all where further poses are proposed.
constexpr std::uint32_t kThoroughSlidWalls = 3;
constexpr std::uint32_t kThoroughPairs = 6;

/// Orders points by their square of 8 m. What is tried one after the other then lies together in
/// the map, whose memory is read once.
bool isBefore(const TPoint2D& a, const TPoint2D& b)
{
  constexpr double kSquare = 8.0;  // [m]
  const double row_a = std::floor(a.y / kSquare);
  const double row_b = std::floor(b.y / kSquare);
  return row_a != row_b ? row_a < row_b : std::floor(a.x / kSquare) < std::floor(b.x / kSquare);
}

/// Returns the pose with heading `phi` (cosine `c`, sine `s`) that maps a point of the robot frame
/// to one of the map.
PoseProposal poseCarrying(const TPoint2D& in_robot, const TPoint2D& in_map, double phi, double c,
                          double s)
{
  return {static_cast<float>(in_map.x - c * in_robot.x + s * in_robot.y),
          static_cast<float>(in_map.y - s * in_robot.x - c * in_robot.y), static_cast<float>(phi)};
}

/// Returns the longest observed walls, at most `count`, without those that `repeats` one of them.
template <class Repeats>
std::vector<const Feature*> longestWalls(const std::vector<Feature>& observed, std::size_t count,
                                         Repeats&& repeats)
{
  std::vector<const Feature*> walls;
  for (const Feature& feature : observed)
  {
    if (isSegment(feature.type)) walls.push_back(&feature);
  }
  std::stable_sort(walls.begin(), walls.end(),
                   [](const Feature* a, const Feature* b) { return a->size > b->size; });
  std::vector<const Feature*> longest;
  for (const Feature* wall : walls)
  {
    if (longest.size() == count) break;
    const bool known = std::any_of(longest.begin(), longest.end(),
                                   [&](const Feature* other) { return repeats(*wall, *other); });
    if (!known) longest.push_back(wall);
  }
  return longest;
}
}  // namespace

PoseProposer::PoseProposer(const FeatureMap& map)
{
  indexWallEnds(map.features());
  indexWalls(map);
  indexCirclePairs(map.features());
}

void PoseProposer::indexWallEnds(const std::vector<Feature>& features)
{
  for (const Feature& feature : features)
  {
    if (feature.type != FeatureType::wall_end) continue;
    wall_ends_[static_cast<std::size_t>(feature.side)].push_back(
        {feature.position, feature.size, feature.direction, std::cos(feature.direction),
         std::sin(feature.direction)});
  }
  for (auto& ends : wall_ends_)
  {
    std::stable_sort(ends.begin(), ends.end(),
                     [](const MappedEnd& a, const MappedEnd& b)
                     { return isBefore(a.position, b.position); });
  }
}

void PoseProposer::indexWalls(const FeatureMap& map)
{
  const std::vector<Feature>& features = map.features();
  for (const WallLine& line : map.lines())
  {
    const Feature& first = features[line.members.front()];
    const TPoint2D tangent(std::sin(line.direction), -std::cos(line.direction));
    const TPoint2D start = segmentStart(first);
    double length = 0;
    for (const std::uint32_t k : line.members)
    {
      const TPoint2D d = segmentEnd(features[k]) - start;
      length = std::max(length, tangent.x * d.x + tangent.y * d.y);
    }
    walls_.push_back({line.direction, -tangent.y, tangent.x, start, length});
    most_slid_ += static_cast<std::size_t>(std::ceil(length / kSlideStep)) + 1;
  }
  walls_.shrink_to_fit();
  std::stable_sort(walls_.begin(), walls_.end(),
                   [](const MappedWall& a, const MappedWall& b)
                   { return isBefore(a.start, b.start); });
}

void PoseProposer::indexCirclePairs(const std::vector<Feature>& features)
{
  std::vector<std::uint32_t> circles;
  for (std::uint32_t k = 0; k < features.size(); ++k)
  {
    if (features[k].type == FeatureType::circle) circles.push_back(k);
  }
  // From west to east, so that partners are looked for among few. Rounding takes none away.
  constexpr double kReach = kPairRange + 1e-9;
  std::sort(circles.begin(), circles.end(),
            [&](std::uint32_t a, std::uint32_t b)
            { return features[a].position.x < features[b].position.x; });
  auto nearby = circles.begin();
  for (const std::uint32_t a : circles)
  {
    const TPoint2D& from = features[a].position;
    while (from.x - features[*nearby].position.x > kReach) ++nearby;
    for (auto to = nearby; to != circles.end(); ++to)
    {
      const std::uint32_t b = *to;
      const TPoint2D d = features[b].position - from;
      if (d.x > kReach) break;
      if (a == b || std::abs(d.y) > kReach) continue;
      const double distance = d.norm();
      if (distance < kMinPairDistance || distance > kPairRange) continue;
      pairs_.push_back({distance, a, b, (features[a].position + features[b].position) * 0.5,
                        features[a].size, features[b].size, std::atan2(d.y, d.x), d.x / distance,
                        d.y / distance});
    }
  }
  pairs_.shrink_to_fit();
  std::sort(pairs_.begin(), pairs_.end(),
            [](const CirclePair& a, const CirclePair& b)
            {
              return a.distance != b.distance ? a.distance < b.distance
                     : a.from != b.from       ? a.from < b.from
                                              : a.to < b.to;
            });
}

std::vector<PoseProposal> PoseProposer::propose(const std::vector<Feature>& observed) const
{
  std::vector<PoseProposal> proposals;
  proposals.reserve(mostByWallEnds(observed) + most_slid_ + kOthers);
  proposeWallEnds(observed, proposals);
  proposeCirclePairs(observed, 0, kMaxPairs, proposals);
  const auto parallel = [](const Feature& a, const Feature& b)
  { return std::abs(wrapToPi(a.direction - b.direction)) <= kParallel; };
  const std::vector<const Feature*> walls = longestWalls(observed, kMostSlidWalls, parallel);
  for (std::size_t i = 0; i < walls.size(); ++i)
  {
    if (i >= kSlidWalls && proposals.size() >= kEnough) break;
    slide(*walls[i], proposals);
  }
  return proposals;
}

std::vector<PoseProposal> PoseProposer::proposeFurther(const std::vector<Feature>& observed) const
{
  std::vector<PoseProposal> proposals;
  proposeCirclePairs(observed, kMaxPairs, kThoroughPairs, proposals);
  // The longest wall may be mapped from its other side only, or not at all. So parallel ones are
  // slid as well.
  const auto on_one_line = [](const Feature& a, const Feature& b)
  {
    const TPoint2D normal = directionVector(b);
    const TPoint2D between = a.position - b.position;
    return std::abs(wrapToPi(a.direction - b.direction)) <= kParallel &&
           std::abs(normal.x * between.x + normal.y * between.y) <= kSameLine;
  };
  const std::vector<const Feature*> walls = longestWalls(observed, kThoroughSlidWalls, on_one_line);
  const std::size_t slid = std::max<std::size_t>(walls.size(), kSlidWalls) - kSlidWalls;
  proposals.reserve(proposals.size() + slid * most_slid_);
  for (std::size_t i = kSlidWalls; i < walls.size(); ++i)
  {
    slide(*walls[i], proposals);
  }
  return proposals;
}

/// Returns an upper bound of the proposals by wall ends.
std::size_t PoseProposer::mostByWallEnds(const std::vector<Feature>& observed) const
{
  std::size_t most = 0;
  for (const Feature& end : observed)
  {
    if (end.type == FeatureType::wall_end)
      most += wall_ends_[static_cast<std::size_t>(end.side)].size();
  }
  return most;
}

void PoseProposer::proposeWallEnds(const std::vector<Feature>& observed,
                                   std::vector<PoseProposal>& out) const
{
  for (const Feature& end : observed)
  {
    if (end.type != FeatureType::wall_end) continue;
    const double c = std::cos(end.direction);
    const double s = std::sin(end.direction);
    for (const MappedEnd& mapped : wall_ends_[static_cast<std::size_t>(end.side)])
    {
      if (mapped.length + kLengthTolerance < end.size * (1.0 - kOverhang)) continue;
      out.push_back(poseCarrying(end.position, mapped.position, mapped.direction - end.direction,
                                 mapped.c * c + mapped.s * s, mapped.s * c - mapped.c * s));
    }
  }
}

/// Slides an observed wall along every mapped one that is long enough. Eq. (4.9)
void PoseProposer::slide(const Feature& wall, std::vector<PoseProposal>& out) const
{
  const TPoint2D normal = directionVector(wall);
  const double inside = wall.size * (0.5 - kOverhang);
  // Appended many at a time, because the compiler keeps nothing in registers across push_back.
  std::array<PoseProposal, 256> some;
  std::size_t count = 0;
  const auto append = [&]
  {
    out.insert(out.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
    count = 0;
  };
  for (const MappedWall& mapped : walls_)
  {
    const bool is_long = mapped.length + kLengthTolerance >= wall.size * (1.0 - kOverhang);
    if (!is_long) continue;
    const double phi = mapped.direction - wall.direction;
    const double c = mapped.c * normal.x + mapped.s * normal.y;
    const double s = mapped.s * normal.x - mapped.c * normal.y;
    const TPoint2D tangent(mapped.s, -mapped.c);
    const double low = std::min(inside, 0.5 * mapped.length);
    const double high = std::max(mapped.length - inside, 0.5 * mapped.length);
    const int steps = static_cast<int>(std::ceil((high - low) / kSlideStep));
    const double step = steps == 0 ? 0 : (high - low) / steps;
    PoseProposal next = poseCarrying(wall.position, mapped.start + tangent * low, phi, c, s);
    const auto dx = static_cast<float>(tangent.x * step);
    const auto dy = static_cast<float>(tangent.y * step);
    for (int i = 0; i <= steps; ++i)
    {
      if (count == some.size()) append();
      some[count++] = next;
      next.x += dx;
      next.y += dy;
    }
  }
  append();
}

/// Two observed circles, and the mapped pairs of about their distance.
struct PoseProposer::ObservedPair
{
  std::size_t count;
  const Feature* a;
  const Feature* b;
  std::vector<CirclePair>::const_iterator begin, end;
};

/// Returns the pairs of observed circles, those of the rarest distance first.
std::vector<PoseProposer::ObservedPair> PoseProposer::rankedCirclePairs(
    const std::vector<Feature>& observed) const
{
  std::vector<ObservedPair> ranked;
  for (std::size_t i = 0; i < observed.size(); ++i)
  {
    if (observed[i].type != FeatureType::circle) continue;
    for (std::size_t j = i + 1; j < observed.size(); ++j)
    {
      if (observed[j].type != FeatureType::circle) continue;
      const double distance = (observed[i].position - observed[j].position).norm();
      if (distance < kMinPairDistance || distance > kPairRange) continue;
      const auto less = [](const CirclePair& p, double d) { return p.distance < d; };
      const auto begin =
          std::lower_bound(pairs_.begin(), pairs_.end(), distance - kPairTolerance, less);
      const auto end = std::lower_bound(begin, pairs_.end(), distance + kPairTolerance, less);
      ranked.push_back(
          {static_cast<std::size_t>(end - begin), &observed[i], &observed[j], begin, end});
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const ObservedPair& a, const ObservedPair& b) { return a.count < b.count; });
  return ranked;
}

/// Proposes by pairs of observed circles, from the `first` rarest up to before the `last`.
void PoseProposer::proposeCirclePairs(const std::vector<Feature>& observed, std::size_t first,
                                      std::size_t last, std::vector<PoseProposal>& out) const
{
  const std::vector<ObservedPair> ranked = rankedCirclePairs(observed);
  for (std::size_t k = first; k < std::min(last, ranked.size()); ++k)
  {
    const ObservedPair& circles = ranked[k];
    const TPoint2D seen = circles.b->position - circles.a->position;
    const double bearing = std::atan2(seen.y, seen.x);
    const double c = std::cos(bearing);
    const double s = std::sin(bearing);
    const TPoint2D middle_seen = (circles.a->position + circles.b->position) * 0.5;
    for (auto pair = circles.begin; pair != circles.end; ++pair)
    {
      if (std::abs(pair->from_radius - circles.a->size) > kRadiusTolerance ||
          std::abs(pair->to_radius - circles.b->size) > kRadiusTolerance)
      {
        continue;
      }
      out.push_back(poseCarrying(middle_seen, pair->middle, pair->bearing - bearing,
                                 pair->c * c + pair->s * s, pair->s * c - pair->c * s));
    }
  }
}
}  // namespace sigloc
