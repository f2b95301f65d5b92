// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PatternIndex.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "geometry/chi_square.h"
#include "matching/generation/pattern_order.h"
#include "matching/generation/sampling.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
constexpr double kFewHits = 100;  // accidental patterns that a query may return, eq. (4.6)
constexpr double kTypicalSigma = 0.05;  // [m] of an observation, before any is known
constexpr double kTypicalDistance = 5;  // [m] between members
constexpr double kFoundOnce = 0.6;  // share of the sets that are not found from another root
constexpr double kLongest = 60;  // [m] longest stored value

/// The point-like features of a map and the nearest neighbours of each among them: `width` a
/// feature, nearest first.
struct NearestPlaces
{
  std::vector<std::uint32_t> roots;
  std::size_t width = 0;
  std::vector<std::uint32_t> table;  ///< by map feature
  std::vector<float> reach;  ///< [m], to the last of them, by map feature

  const std::uint32_t* of(std::uint32_t k) const { return &table[k * width]; }
  bool holds(std::uint32_t k, std::uint32_t neighbour) const
  {
    return std::find(of(k), of(k) + width, neighbour) != of(k) + width;
  }
};

void gatherPlaces(const PreparedMap& map, std::uint32_t root, double reach,
                  std::vector<std::uint32_t>& places)
{
  places.clear();
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    const auto type = static_cast<FeatureType>(t);
    if (isSegment(type)) continue;
    map.grid().visitNear(map.view(root).position(), reach, type,
                         [&](std::uint32_t l)
                         {
                           if (l != root) places.push_back(l);
                         });
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

NearestPlaces nearestPlaces(const PreparedMap& map, std::vector<std::uint32_t> roots,
                            std::size_t width)
{
  NearestPlaces nearest;
  nearest.roots = std::move(roots);
  nearest.width = width;
  nearest.table.assign(map.size() * width, std::numeric_limits<std::uint32_t>::max());
  const double first_reach = std::sqrt(2 * static_cast<double>(width) * map.area() /
                                       (M_PI * static_cast<double>(nearest.roots.size())));
  nearest.reach.assign(map.size(), 0);
  std::vector<std::uint32_t> places;
  for (const std::uint32_t root : nearest.roots)
  {
    double reach = first_reach;
    do
    {
      gatherPlaces(map, root, reach, places);
      reach *= 1.5;
    } while (places.size() < width && reach < 4 * kLongest);
    const auto distance = [&](std::uint32_t l)
    {
      const TPoint2D between = map.view(l).position() - map.view(root).position();
      return dot(between, between);
    };
    const std::size_t kept = std::min(width, places.size());
    std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept),
                      places.end(),
                      [&](std::uint32_t a, std::uint32_t b)
                      { return distance(a) != distance(b) ? distance(a) < distance(b) : a < b; });
    std::copy_n(places.begin(), kept,
                nearest.table.begin() + static_cast<std::ptrdiff_t>(root * width));
    constexpr double kRounding = 1e-4;  // [m]
    if (kept == 0) continue;
    nearest.reach[root] = static_cast<float>(std::sqrt(distance(places[kept - 1])) + kRounding);
  }
  return nearest;
}

/// True when the set is entered from this root. That is the member of lowest index among those that
/// have all others among their nearest neighbours.
bool entersHere(const NearestPlaces& nearest, const PatternMembers& set, std::size_t size)
{
  for (std::size_t q = 1; q < size; ++q)
  {
    if (set[q] > set[0]) continue;
    bool holds_all = true;
    for (std::size_t k = 0; k < size && holds_all; ++k)
    {
      holds_all = k == q || nearest.holds(set[q], set[k]);
    }
    if (holds_all) return false;
  }
  return true;
}

/// Calls visit(members) for every set of a root with `size` - 1 of its neighbours.
template <class Visit>
void visitSets(const NearestPlaces& nearest, std::uint32_t root, std::size_t size, Visit&& visit)
{
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const std::uint32_t* places = nearest.of(root);
  const auto count =
      static_cast<std::size_t>(std::find(places, places + nearest.width, kNone) - places);
  if (count + 1 < size) return;
  // Ascending combinations of size - 1 positions.
  std::array<std::size_t, kLargestPattern> at{};
  const std::size_t chosen = size - 1;
  std::iota(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(chosen), std::size_t{0});
  while (true)
  {
    PatternMembers set{root};
    for (std::size_t k = 0; k < chosen; ++k) set[k + 1] = places[at[k]];
    visit(set);
    std::size_t moving = chosen;
    while (moving > 0 && at[moving - 1] == count - chosen + moving - 1) --moving;
    if (moving == 0) return;
    ++at[moving - 1];
    for (std::size_t k = moving; k < chosen; ++k) at[k] = at[k - 1] + 1;
  }
}
}  // namespace

/// Patterns in the order they are found, before they are sorted into slots.
struct PatternIndex::Draft
{
  std::vector<CellKey> cells;
  std::vector<std::int16_t> values;
  std::vector<std::uint32_t> members;
};

PatternShape PatternIndex::shapeOf(const TPoint2D* places, std::size_t count)
{
  PatternShape shape;
  const TPoint2D side = places[1] - places[0];
  const double length = std::sqrt(dot(side, side));
  const TPoint2D unit = length > 0 ? side * (1 / length) : TPoint2D{1, 0};
  shape.values[0] = length;
  for (std::size_t k = 2; k < count; ++k)
  {
    const TPoint2D from = places[k] - places[0];
    shape.values[2 * k - 3] = dot(from, unit);
    shape.values[2 * k - 2] = cross(unit, from);
  }
  return shape;
}

void PatternIndex::chooseSize(const PreparedMap& map, const GeneratorOptions& options)
{
  const double gate = chiSquareGate(options.gate_probability, 1);
  const double relative = map.map().error().relativeSigma(kTypicalDistance);
  double variance = 0;
  double places = 0;
  for (std::size_t k = 0; k < map.size(); ++k) places += isPointLike(map.view(k).type());
  for (std::size_t t = 0; t < kFeatureTypes; ++t)
  {
    const auto type = static_cast<FeatureType>(t);
    if (!isSegment(type)) variance = std::max(variance, map.typicalPositionVariance(type));
  }
  const double spread = kTypicalSigma * kTypicalSigma + variance + relative * relative;
  cell_ = 2 * std::sqrt(2 * gate * spread);  // twice the expected tolerance
  size_ = options.pattern_size;
  if (size_ >= 3) return;

  // Eq. (4.6): each further member multiplies the accidental matches by the probability p that a
  // map feature is in its gate. There are as many members as leave few such matches.
  const double area = 2 * M_PI * chiSquareGate(options.gate_probability, 2) * spread;
  const double p = std::clamp(places / map.area() * area, 1e-3, 0.3);
  constexpr double kSmallMap = 200;
  size_ = places < kSmallMap ? 3 : 4;
  for (double hits = places * std::pow(p, size_ - 2); hits > kFewHits && size_ < kLargestPattern;
       hits *= p)
    ++size_;
}

PatternIndex::PatternIndex(const PreparedMap& map, const GeneratorOptions& options)
    : unit_(kLongest / std::numeric_limits<std::int16_t>::max())
{
  std::vector<std::uint32_t> roots;
  for (std::uint32_t k = 0; k < map.size(); ++k)
  {
    if (isPointLike(map.view(k).type())) roots.push_back(k);
  }
  if (roots.size() < 3) return;
  chooseSize(map, options);
  neighbours_ = size_ - 1;
  while (neighbours_ + 1 < roots.size() && kFoundOnce * combinations(neighbours_ + 1, size_ - 1) <=
                                               static_cast<double>(options.max_patterns))
  {
    ++neighbours_;
  }

  NearestPlaces nearest = nearestPlaces(map, std::move(roots), neighbours_);
  Draft draft;
  for (const std::uint32_t root : nearest.roots)
  {
    visitSets(nearest, root, size_,
              [&](const PatternMembers& set)
              {
                if (entersHere(nearest, set, size_)) appendPattern(map, set, draft);
              });
  }
  sortIntoSlots(draft);
  reach_ = std::move(nearest.reach);
}

void PatternIndex::appendPattern(const PreparedMap& map, const PatternMembers& set,
                                 Draft& draft) const
{
  std::array<TPoint2D, kLargestPattern> at;
  for (std::size_t k = 0; k < size_; ++k) at[k] = map.view(set[k]).position();
  const PatternOrder order = canonicalOrder(at.data(), size_);
  std::array<TPoint2D, kLargestPattern> ordered;
  for (std::size_t k = 0; k < size_; ++k) ordered[k] = at[order[k]];
  const PatternShape shape = shapeOf(ordered.data(), size_);
  if (shape.values[0] > kLongest) return;

  for (std::size_t v = 0; v < valueCount(); ++v)
  {
    draft.values.push_back(static_cast<std::int16_t>(std::lround(shape.values[v] / unit_)));
  }
  for (std::size_t k = 0; k < size_; ++k) draft.members.push_back(set[order[k]]);
  draft.cells.push_back(keyOf(shape));
}

void PatternIndex::sortIntoSlots(const Draft& draft)
{
  std::size_t slots = 1;
  while (slots < draft.cells.size()) slots *= 2;
  slot_mask_ = slots - 1;
  constexpr std::size_t kSlotsPerWord = 8;  // 8 bits a slot
  const std::size_t words = std::max<std::size_t>(1, slots / kSlotsPerWord);
  occupied_mask_ = words - 1;
  occupied_.assign(words, 0);
  starts_.assign(slots + 1, 0);
  for (const CellKey& cell : draft.cells)
  {
    occupied_[wordOf(cell.group)] |= 1ULL << cell.member;
    ++starts_[slotOf(cell.group, cell.member) + 1];
  }
  for (std::size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  values_.resize(draft.values.size());
  members_.resize(draft.members.size());
  const std::size_t width = valueCount();
  for (std::size_t e = 0; e < draft.cells.size(); ++e)
  {
    const CellKey& cell = draft.cells[e];
    const std::size_t to = next[slotOf(cell.group, cell.member)]++;
    std::copy_n(&draft.values[e * width], width, &values_[to * width]);
    std::copy_n(&draft.members[e * size_], size_, &members_[to * size_]);
  }
}

PatternIndex::Alignment PatternIndex::alignmentOf(const PatternShape& shape) const
{
  Alignment alignment;
  alignment.x[1] = shape.values[0];
  for (std::size_t k = 2; k < size_; ++k)
  {
    alignment.x[k] = shape.values[2 * k - 3];
    alignment.y[k] = shape.values[2 * k - 2];
  }
  const double share = 1 / static_cast<double>(size_);
  const double x = share * std::accumulate(alignment.x.begin(), alignment.x.end(), 0.0);
  const double y = share * std::accumulate(alignment.y.begin(), alignment.y.end(), 0.0);
  alignment.inertia = 1e-9;  // [m^2], avoids a division by zero for coincident members
  for (std::size_t k = 0; k < size_; ++k)
  {
    alignment.x[k] -= x;
    alignment.y[k] -= y;
    alignment.inertia += alignment.x[k] * alignment.x[k] + alignment.y[k] * alignment.y[k];
  }
  return alignment;
}

PatternIndex::CellKey PatternIndex::keyOf(const PatternShape& shape) const
{
  CellKey key;
  for (std::size_t v = 0; v < hashedCount(); ++v)
  {
    const std::int64_t cell = cellOf(shape.values[v]);
    const bool grouped = v >= firstGrouped();
    key.group = mix(key.group, grouped ? cell >> kGroupBits : cell);
    if (grouped) key.member |= laneOf(cell) << laneShift(v);
  }
  return key;
}

std::uint64_t PatternIndex::membersAlong(std::size_t v, std::uint64_t stem, std::int64_t first,
                                         std::int64_t last) const
{
  std::uint64_t members = 0;
  for (std::int64_t cell = first; cell <= last; ++cell)
  {
    members |= stem << (laneOf(cell) << laneShift(v));
  }
  return members;
}

std::size_t PatternIndex::slotsNear(const PatternShape& shape, double tolerance,
                                    std::array<std::size_t, kMostCells>& slots,
                                    std::uint64_t& read) const
{
  // 1. All groups that the tolerance reaches in each value, and which of their cells it reaches.
  struct Reached
  {
    std::uint64_t group;  // without initial values, because the array has thousands of elements
    std::uint64_t members;  ///< a bit each
  };
  std::array<Reached, kMostCells> reached;
  std::size_t cells = 1;
  std::size_t count = 1;
  reached[0] = {0, 1};
  for (std::size_t v = 0; v < hashedCount(); ++v)
  {
    const std::int64_t first = cellOf(shape.values[v] - tolerance);
    const std::int64_t last = cellOf(shape.values[v] + tolerance);
    cells *= static_cast<std::size_t>(last - first + 1);
    if (cells > kMostCells) return 0;
    const bool grouped = v >= firstGrouped();
    const std::size_t bits = grouped ? kGroupBits : 0;
    const std::int64_t first_block = first >> bits;
    const auto blocks = static_cast<std::size_t>((last >> bits) - first_block + 1);
    for (std::size_t k = count; k-- > 0;)
    {
      const Reached stem = reached[k];
      for (std::size_t b = 0; b < blocks; ++b)
      {
        const std::int64_t block = first_block + static_cast<std::int64_t>(b);
        const std::int64_t start = block * (std::int64_t{1} << bits);
        const std::int64_t end = start + (1 << bits) - 1;
        reached[k * blocks + b] = {
            mix(stem.group, block),
            grouped ? membersAlong(v, stem.members, std::max(first, start), std::min(last, end))
                    : stem.members};
      }
    }
    count *= blocks;
  }
  for (std::size_t k = 0; k < count; ++k) __builtin_prefetch(&occupied_[wordOf(reached[k].group)]);

  // 2. Keep the cells that may have patterns: most have none.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    std::uint64_t held = occupied_[wordOf(reached[k].group)] & reached[k].members;
    for (; held != 0; held &= held - 1)
    {
      slots[kept++] = slotOf(reached[k].group, static_cast<std::uint32_t>(__builtin_ctzll(held)));
    }
  }
  read += count + kept;
  return kept;
}

std::size_t PatternIndex::bytes() const
{
  return occupied_.capacity() * sizeof(occupied_[0]) + starts_.capacity() * sizeof(starts_[0]) +
         values_.capacity() * sizeof(values_[0]) + members_.capacity() * sizeof(members_[0]) +
         reach_.capacity() * sizeof(reach_[0]);
}
}  // namespace sigloc
