// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/LargeVector.h"
#include "matching/features/GeneratorOptions.h"
#include "matching/features/PreparedMap.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sigloc
{
constexpr std::size_t kLargestPattern = 5;

/// The shape of a pattern of point-like features: its longest side, and the other members in the
/// frame of that side, (along, across) each. It is invariant under rigid motion, but not under
/// reflection. \cite algorithm eq. (4.5)
struct PatternShape
{
  std::array<double, 2 * kLargestPattern - 3> values{};  ///< [m]
};

/// Members of a pattern in the order of its shape: the ends of the longest side, then the others
/// along it.
using PatternMembers = std::array<std::uint32_t, kLargestPattern>;

/// A hash over the shapes of small patterns of map features. A pattern is a feature with some of
/// its nearest neighbours. So patterns are wide where the map is sparse, and every feature has
/// equally many. Their size grows with the logarithm of the map, so that every query returns about
/// as many. \cite algorithm eq. (4.6)
class PatternIndex
{
 public:
  PatternIndex(const PreparedMap& map, const GeneratorOptions& options);

  std::size_t patternSize() const { return size_; }
  /// Number of nearest neighbours that form patterns with a feature.
  std::size_t neighbours() const { return neighbours_; }

  /// True when `other` is one of the `neighbours()` that form patterns with `root`.
  bool isNeighbour(const PreparedMap& map, std::uint32_t root, std::uint32_t other) const
  {
    return (map.view(other).position() - map.view(root).position()).norm() <= reach_[root];
  }

  /// How much a mapped pattern may differ from an observed one.
  struct Gate
  {
    double tolerance = 0;  ///< [m], of each value of the shape
    double residual = 0;  ///< [m^2], sum of squares over the members after the best alignment
  };
  /// Calls visit(const std::uint32_t* members) for every mapped pattern whose shape fits the given
  /// one. The caller checks the types. Returns how many groups, cells and patterns were read.
  /// \cite algorithm eq. (4.7)
  template <class Visit>
  std::uint64_t visit(const PatternShape& shape, const Gate& gate, Visit&& visit) const;

  // For tests.
  std::size_t count() const { return size_ > 0 ? members_.size() / size_ : 0; }
  std::size_t bytes() const;
  /// Calls visit(const std::uint32_t* members) for every mapped pattern.
  template <class Visit>
  void visitAll(Visit&& visit) const
  {
    for (std::size_t e = 0; e < count(); ++e) visit(&members_[e * size_]);
  }

  /// Returns the shape of `count` places [m] given in pattern order.
  static PatternShape shapeOf(const mrpt::math::TPoint2D* places, std::size_t count);

 private:
  static constexpr std::size_t kHashedValues = 6;  // values of a shape that are hashed
  static constexpr std::size_t kMostCells = 4096;  // that one query may visit
  static constexpr std::size_t kGroupedValues = 3;  // last values, whose cells form groups
  static constexpr std::size_t kGroupBits = 2;  // of each grouped value: 64 cells a group

  std::size_t valueCount() const { return 2 * size_ - 3; }
  std::size_t hashedCount() const { return std::min(kHashedValues, valueCount()); }
  std::int64_t cellOf(double value) const
  {
    return static_cast<std::int64_t>(std::floor(value / cell_));
  }
  static std::uint64_t mix(std::uint64_t hash, std::int64_t cell)
  {
    hash = (hash ^ static_cast<std::uint64_t>(cell + 4096)) * 0x9E3779B97F4A7C15ULL;
    return hash ^ (hash >> 29);
  }
  /// The position of a cell of shapes in the table. Cells that differ little in the last values
  /// share a group and are side by side in memory, because a query visits many of them.
  struct CellKey
  {
    std::uint64_t group = 0;
    std::uint32_t member = 0;
  };
  /// Index of the first grouped value. The hashed values before it separate groups; the others also
  /// separate cells of a group.
  std::size_t firstGrouped() const { return hashedCount() - kGroupedValues; }
  /// Position of a cell along a grouped value among those of its group.
  static std::uint32_t laneOf(std::int64_t cell)
  {
    return static_cast<std::uint32_t>(cell & ((1 << kGroupBits) - 1));
  }
  /// Bits by which the lane of a grouped value is shifted in the member.
  std::uint32_t laneShift(std::size_t v) const
  {
    return static_cast<std::uint32_t>((v - firstGrouped()) * kGroupBits);
  }
  CellKey keyOf(const PatternShape& shape) const;
  /// Returns the members, a bit each, that the members `stem` give along the cells first..last of
  /// value v.
  std::uint64_t membersAlong(std::size_t v, std::uint64_t stem, std::int64_t first,
                             std::int64_t last) const;
  std::size_t slotOf(std::uint64_t group, std::uint32_t member) const
  {
    return (group >> 7 << kGroupedValues * kGroupBits | member) & slot_mask_;
  }
  std::size_t wordOf(std::uint64_t group) const { return (group >> 20) & occupied_mask_; }
  /// What aligns an observed shape with stored ones. \cite algorithm eq. (4.7)
  struct Alignment
  {
    std::array<double, kLargestPattern> x{};  ///< [m], members from their centroid
    std::array<double, kLargestPattern> y{};  ///< [m], members from their centroid
    double inertia = 0;  ///< [m^2], sum of the squared distances from the centroid
  };
  Alignment alignmentOf(const PatternShape& shape) const;
  double residualOf(const PatternShape& shape, const Alignment& alignment,
                    const std::int16_t* stored) const;
  std::size_t slotsNear(const PatternShape& shape, double tolerance,
                        std::array<std::size_t, kMostCells>& slots, std::uint64_t& read) const;
  struct Draft;
  void chooseSize(const PreparedMap& map, const GeneratorOptions& options);
  void appendPattern(const PreparedMap& map, const PatternMembers& set, Draft& draft) const;
  void sortIntoSlots(const Draft& draft);

  std::size_t size_ = 0;  ///< members of a pattern, 0 when the map has no patterns
  std::size_t neighbours_ = 0;
  double cell_ = 0.4;
  double unit_ = 1e-3;  ///< [m] of a stored value
  std::size_t slot_mask_ = 0;
  std::uint64_t occupied_mask_ = 0;
  LargeVector<std::uint64_t> occupied_;  ///< a word a group, a bit for each cell with patterns
  LargeVector<std::uint32_t> starts_;
  LargeVector<std::int16_t> values_;  ///< valueCount() a pattern
  LargeVector<std::uint32_t> members_;  ///< size_ a pattern
  std::vector<float> reach_;  ///< [m], of each mapped feature to the last of its neighbours
};

inline double PatternIndex::residualOf(const PatternShape& shape, const Alignment& alignment,
                                       const std::int16_t* stored) const
{
  // The differences of the members when both longest sides start together and point the same way.
  // The common shift and turn are then removed, eq. (4.7).
  const double share = 1 / static_cast<double>(size_);
  double sum_x = 0;
  double sum_y = 0;
  double squares = 0;
  double turn = 0;
  const auto add = [&](std::size_t member, double dx, double dy)
  {
    sum_x += dx;
    sum_y += dy;
    squares += dx * dx + dy * dy;
    turn += alignment.x[member] * dy - alignment.y[member] * dx;
  };
  add(1, stored[0] * unit_ - shape.values[0], 0);
  for (std::size_t k = 2; k < size_; ++k)
  {
    add(k, stored[2 * k - 3] * unit_ - shape.values[2 * k - 3],
        stored[2 * k - 2] * unit_ - shape.values[2 * k - 2]);
  }
  return squares - share * (sum_x * sum_x + sum_y * sum_y) - turn * turn / alignment.inertia;
}

template <class Visit>
std::uint64_t PatternIndex::visit(const PatternShape& shape, const Gate& gate, Visit&& visit) const
{
  if (members_.empty()) return 0;
  std::uint64_t read = 0;
  std::array<std::size_t, kMostCells> slots;
  const std::size_t slot_count = slotsNear(shape, gate.tolerance, slots, read);
  // The slots are far apart in memory, so all are prefetched before the first is read.
  for (std::size_t s = 0; s < slot_count; ++s) __builtin_prefetch(&starts_[slots[s]]);
  const std::size_t width = valueCount();
  std::array<std::int32_t, 2 * kLargestPattern - 3> low{};
  std::array<std::int32_t, 2 * kLargestPattern - 3> high{};
  for (std::size_t v = 0; v < width; ++v)
  {
    low[v] = static_cast<std::int32_t>(std::floor((shape.values[v] - gate.tolerance) / unit_));
    high[v] = static_cast<std::int32_t>(std::ceil((shape.values[v] + gate.tolerance) / unit_));
  }
  const Alignment alignment = alignmentOf(shape);
  for (std::size_t s = 0; s < slot_count; ++s)
  {
    __builtin_prefetch(&values_[starts_[slots[s]] * width]);
  }
  for (std::size_t s = 0; s < slot_count; ++s)
  {
    read += starts_[slots[s] + 1] - starts_[slots[s]];
    for (std::uint32_t e = starts_[slots[s]]; e < starts_[slots[s] + 1]; ++e)
    {
      const std::int16_t* values = &values_[e * width];
      std::size_t v = 0;
      while (v < width && values[v] >= low[v] && values[v] <= high[v]) ++v;
      if (v < width || residualOf(shape, alignment, values) > gate.residual) continue;
      visit(&members_[e * size_]);
    }
  }
  return read;
}
}  // namespace sigloc
