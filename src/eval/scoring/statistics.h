// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "config/columns.h"

namespace sigloc
{
/// A share with its Wilson 95 % interval; NaN when there are no cases.
struct Proportion
{
  std::size_t count = 0;
  std::size_t cases = 0;
  /// Adds a case.
  void add(bool counts);
  double value() const;
  double low() const;
  double high() const;
};

/// "0.968 (0.94-0.98)", or "-" without cases.
std::string withInterval(const Proportion& proportion);

/// Keys `` (the share), `_counts` ([count, cases]) and `_interval` ([low, high], 95 %), share and
/// interval null without cases; one cell, with its interval.
Written written(const Proportion& proportion, int decimals);

struct Quantiles
{
  double median = std::numeric_limits<double>::quiet_NaN();
  double p95 = std::numeric_limits<double>::quiet_NaN();
  double mean = std::numeric_limits<double>::quiet_NaN();
};
/// Nearest-rank quantiles; NaN for an empty list.
Quantiles quantilesOf(std::vector<double> values);

/// {"median", "p95", "mean"}, a cell each.
Written written(const Quantiles& quantiles, int decimals);

// What columns of a summary are: functions of a group, any struct whose `records` are summed up.
// `read` is a member of a record or a function of it.

/// The sum; of a condition, the number of records that fulfil it.
template <class Read>
auto total(Read read)
{
  return [read](const auto& group)
  {
    std::size_t sum = 0;
    for (const auto& record : group.records) sum += std::invoke(read, record);
    return sum;
  };
}

/// The share of the records that fulfil a condition; a condition that is none leaves a record out.
template <class Read>
auto share(Read read)
{
  return [read](const auto& group)
  {
    Proportion share;
    for (const auto& record : group.records)
    {
      if (const std::optional<bool> holds = std::invoke(read, record)) share.add(*holds);
    }
    return share;
  };
}

/// The values of a number, or of several numbers, that each record has; NaN is left out.
template <class Read>
auto values(Read read)
{
  return [read](const auto& group)
  {
    std::vector<double> found;
    for (const auto& record : group.records)
    {
      const auto& value = std::invoke(read, record);
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
      {
        found.push_back(static_cast<double>(value));
      }
      else
      {
        found.insert(found.end(), value.begin(), value.end());
      }
    }
    const auto is_nan = [](double value) { return std::isnan(value); };
    found.erase(std::remove_if(found.begin(), found.end(), is_nan), found.end());
    return found;
  };
}

template <class Read>
auto quantiles(Read read)
{
  return [read](const auto& group) { return quantilesOf(values(read)(group)); };
}

/// One of the figures that `read` makes of a group.
template <class Read, class Figures>
auto part(double Figures::*figure, Read read)
{
  return [figure, read](const auto& group) { return read(group).*figure; };
}
}  // namespace sigloc
