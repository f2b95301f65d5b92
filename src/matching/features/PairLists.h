// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/GeneratorOptions.h"
#include "matching/features/PreparedMap.h"
#include "signature/binary_constraint.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace sigloc
{
/// The binary constraints B_k of every map signature: for each feature k its neighbours of each
/// type, sorted by the key of the pair. Neighbours are features within a cut-off between extents;
/// the plain mode has no cut-off. \cite algorithm eq. (3.3), (4.1)
class PairLists
{
 public:
  static constexpr double kUncut = std::numeric_limits<double>::infinity();

  PairLists(const PreparedMap& map, double cut_off);

  /// Returns the distance [m] within which a feature has `max_neighbours` on average, over a sample
  /// of 64 features at most; kUncut where the map has no more. \cite algorithm section 4 (b)
  static double cutOffFor(const PreparedMap& map, const GeneratorOptions& options);

  double cutOff() const { return cut_off_; }

  /// Calls visit(l) for every l of the type `second` whose b_kl is within `tolerance` of the
  /// observed b_ij. This is the list L_j(i, k) before its unary filter, found by binary search.
  /// Returns how many entries were read, those of the search included.
  /// \cite algorithm eq. (4.1)
  template <class Visit>
  std::uint64_t visit(std::size_t k, const BinaryKey& observed, FeatureType second,
                      double tolerance, Visit&& visit) const;

  /// Calls visit(key, l) for all neighbours l of k.
  template <class Visit>
  void visitAll(std::size_t k, Visit&& visit) const
  {
    for (std::size_t e = rows_[k][0]; e < rows_[k + 1][0]; ++e)
    {
      visit(entries_[e].key, entries_[e].feature);
    }
  }

  /// Largest variance [m^2 or rad^2] of a mapped key for a pair of types, which the gates allow
  /// for.
  double largestKeyVariance(FeatureType first, FeatureType second) const
  {
    return key_variance_[typeIndex(first)][typeIndex(second)];
  }

 private:
  struct Entry
  {
    float key;
    std::uint32_t feature;
  };
  template <class Visit>
  std::uint64_t visitRange(std::size_t begin, std::size_t end, double low, double high,
                           Visit&& visit) const;

  double cut_off_;
  std::vector<Entry> entries_;
  std::vector<std::array<std::uint32_t, kFeatureTypes>> rows_;  ///< start of each type's row
  std::array<std::array<double, kFeatureTypes>, kFeatureTypes> key_variance_{};
};

template <class Visit>
std::uint64_t PairLists::visitRange(std::size_t begin, std::size_t end, double low, double high,
                                    Visit&& visit) const
{
  const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = entries_.begin() + static_cast<std::ptrdiff_t>(end);
  std::uint64_t read = 0;
  auto entry = std::lower_bound(first, last, low,
                                [&](const Entry& e, double value)
                                {
                                  ++read;
                                  return static_cast<double>(e.key) < value;
                                });
  for (; entry != last && static_cast<double>(entry->key) <= high; ++entry)
  {
    ++read;
    visit(entry->feature);
  }
  return read;
}

template <class Visit>
std::uint64_t PairLists::visit(std::size_t k, const BinaryKey& observed, FeatureType second,
                               double tolerance, Visit&& visit) const
{
  // Keys are stored in single precision.
  const double slack = tolerance + 1e-5 * (1 + std::abs(observed.value));
  const std::size_t begin = rows_[k][typeIndex(second)];
  const std::size_t end =
      typeIndex(second) + 1 < kFeatureTypes ? rows_[k][typeIndex(second) + 1] : rows_[k + 1][0];
  const double low = observed.value - slack;
  const double high = observed.value + slack;
  std::uint64_t read = visitRange(begin, end, low, high, visit);
  if (!observed.is_angle) return read;
  // Angles wrap: the part of the range beyond +-pi is at the other end.
  if (low < -M_PI) read += visitRange(begin, end, std::max(low + 2 * M_PI, high), 4.0, visit);
  if (high > M_PI) read += visitRange(begin, end, -4.0, std::min(high - 2 * M_PI, low), visit);
  return read;
}
}  // namespace sigloc
