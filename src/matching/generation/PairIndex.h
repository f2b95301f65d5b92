// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/features/PairLists.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// All pairs of neighbouring map features, by the types of the two and sorted by their key. A
/// binary search finds the pairs that fit an observed one, and their number. \cite algorithm
/// section 4 (c)
class PairIndex
{
 public:
  PairIndex(const PreparedMap& map, const PairLists& lists);

  /// A run of pairs (k, l) whose key fits. It is `swapped` when observed i is l and j is k.
  struct Run
  {
    std::size_t begin = 0;
    std::size_t end = 0;
    bool swapped = false;
  };
  /// The runs that fit an observed pair (i, j): both orders for two features of one type, and the
  /// part of an angle range beyond +-pi.
  struct Runs
  {
    std::array<Run, 4> runs{};
    std::size_t count = 0;
    std::size_t first_types = 0;  ///< index of the table that has the runs
    std::uint64_t pairs() const;
  };
  Runs find(FeatureType first, FeatureType second, const BinaryKey& observed,
            double tolerance) const;

  /// Calls visit(mapped for i, mapped for j) for every pair of the runs.
  template <class Visit>
  void visit(const Runs& runs, Visit&& visit) const
  {
    const std::vector<Entry>& table = tables_[runs.first_types];
    for (std::size_t r = 0; r < runs.count; ++r)
    {
      const Run& run = runs.runs[r];
      for (std::size_t e = run.begin; e < run.end; ++e)
      {
        const Entry& entry = table[e];
        run.swapped ? visit(entry.second, entry.first) : visit(entry.first, entry.second);
      }
    }
  }

 private:
  struct Entry
  {
    float key;
    std::uint32_t first;
    std::uint32_t second;
  };
  static std::size_t tableOf(FeatureType first, FeatureType second)
  {
    return typeIndex(first) * kFeatureTypes + typeIndex(second);
  }
  void appendRange(std::size_t table, double low, double high, bool swapped, Runs& runs) const;

  std::array<std::vector<Entry>, kFeatureTypes * kFeatureTypes> tables_;
};
}  // namespace sigloc
