// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/PairIndex.h"

#include <algorithm>
#include <cmath>

namespace sigloc
{
PairIndex::PairIndex(const PreparedMap& map, const PairLists& lists)
{
  // Each pair is entered once, the lower type first and of equal types the lower index. They are
  // counted first, because growing tables would double the memory of the index for a while.
  const auto each_pair = [&](auto&& enter)
  {
    for (std::uint32_t k = 0; k < map.size(); ++k)
    {
      const FeatureType first = map.view(k).type();
      lists.visitAll(k,
                     [&](float key, std::uint32_t l)
                     {
                       const FeatureType second = map.view(l).type();
                       if (first < second || (first == second && k < l))
                       {
                         enter(tableOf(first, second), Entry{key, k, l});
                       }
                     });
    }
  };
  std::array<std::size_t, kFeatureTypes * kFeatureTypes> counts{};
  each_pair([&](std::size_t table, const Entry&) { ++counts[table]; });
  for (std::size_t t = 0; t < tables_.size(); ++t) tables_[t].reserve(counts[t]);
  each_pair([&](std::size_t table, const Entry& entry) { tables_[table].push_back(entry); });
  for (auto& table : tables_)
  {
    std::sort(table.begin(), table.end(),
              [](const Entry& a, const Entry& b)
              {
                if (a.key != b.key) return a.key < b.key;
                return a.first != b.first ? a.first < b.first : a.second < b.second;
              });
  }
}

std::uint64_t PairIndex::Runs::pairs() const
{
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < count; ++r) sum += runs[r].end - runs[r].begin;
  return sum;
}

void PairIndex::appendRange(std::size_t table, double low, double high, bool swapped,
                            Runs& runs) const
{
  const std::vector<Entry>& entries = tables_[table];
  const auto before = [](const Entry& e, double value)
  { return static_cast<double>(e.key) < value; };
  const auto begin = std::lower_bound(entries.begin(), entries.end(), low, before);
  const auto end = std::lower_bound(begin, entries.end(), high, before);
  if (begin == end || runs.count == runs.runs.size()) return;
  runs.runs[runs.count++] = {static_cast<std::size_t>(begin - entries.begin()),
                             static_cast<std::size_t>(end - entries.begin()), swapped};
}

PairIndex::Runs PairIndex::find(FeatureType first, FeatureType second, const BinaryKey& observed,
                                double tolerance) const
{
  const double slack = tolerance + 1e-5 * (1 + std::abs(observed.value));
  const bool reversed = second < first;
  Runs runs;
  runs.first_types = reversed ? tableOf(second, first) : tableOf(first, second);
  const auto append = [&](double value, bool swapped)
  {
    appendRange(runs.first_types, value - slack, value + slack, swapped, runs);
    if (!observed.is_angle) return;
    const double turned = value > 0 ? value - 2 * M_PI : value + 2 * M_PI;
    const bool wraps = std::abs(value) + slack > M_PI;
    if (wraps) appendRange(runs.first_types, turned - slack, turned + slack, swapped, runs);
  };
  append(observed.value, reversed);
  // Two features of one type may be in either order. An angle then changes its sign, a distance
  // does not.
  if (first == second) append(observed.is_angle ? -observed.value : observed.value, true);
  return runs;
}
}  // namespace sigloc
