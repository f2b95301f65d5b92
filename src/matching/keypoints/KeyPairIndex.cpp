// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/keypoints/KeyPairIndex.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <numeric>

#include "matching/keypoints/deviation_codes.h"
#include "matching/keypoints/NeighbouringKeyPoints.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kGate = 7.879;  // chi-square with one degree of freedom, 99.5 %
constexpr std::uint32_t kBearingBins = 48;
constexpr std::uint32_t kTurnBins = 32;
constexpr double kMaxRange = 12.0;  // [m] between the key points of a pair
constexpr std::size_t kRangeSteps = 48;  // in which the range is chosen
constexpr std::size_t kRangeSample = 5000;  // key points whose partners are counted for it, at most
constexpr std::size_t kLeastSteps = 8;  // 2 m
constexpr std::size_t kPartners = 64;  // of a key point within the range, on average
constexpr std::size_t kSmallIndex = 50000;  // pairs that any map may have
constexpr std::size_t kEntriesPerCell = 2;  // on average, before distances are cut finer
constexpr std::size_t kMinDistanceBins = 8;
constexpr std::size_t kMaxDistanceBins = 128;
constexpr double kMaxRadius = 2.55;  // [m]; larger circles count as of this radius
constexpr double kFullTurn = 65536;  // parts of a stored bearing

std::size_t tableOf(KeyPointKind first, KeyPointKind second)
{
  return static_cast<std::size_t>(first) * kKeyPointKinds + static_cast<std::size_t>(second);
}

double square(double value)
{
  return value * value;
}

double along(const Symmetric2& covariance, double x, double y)
{
  return covariance.xx * x * x + 2 * covariance.xy * x * y + covariance.yy * y * y;
}

/// A table to be filled with the pairs of two kinds of key points.
struct TableWork
{
  std::size_t a, b;  // kinds
  std::uint32_t before;  // pairs of earlier tables
  std::uint32_t pairs;
};

/// Returns the range [m] of the index. In a sparse map it is longer, because near partners are few,
/// and the pairs that tell most are those of far ones.
double chosenRange(const std::vector<KeyPoint>& points, const NeighbouringKeyPoints& neighbours)
{
  const std::size_t stride = 1 + points.size() / kRangeSample;
  std::vector<std::size_t> counts(kRangeSteps, 0);
  neighbours.forEachPair(
      {KeyPairIndex::kMinDistance, kMaxRange}, stride,
      [&](const KeyPoint& a, const KeyPoint& b)
      {
        const double share = (b.position - a.position).norm() / kMaxRange;
        ++counts[std::min(kRangeSteps - 1, static_cast<std::size_t>(share * kRangeSteps))];
      });
  const std::size_t most = std::max(kPartners * points.size(), kSmallIndex) / stride;
  std::size_t steps = 0;
  std::size_t pairs = 0;
  while (steps < kRangeSteps && (pairs + counts[steps] <= most || steps < kLeastSteps))
  {
    pairs += counts[steps++];
  }
  return kMaxRange * static_cast<double>(steps) / kRangeSteps;
}
}  // namespace

KeyPair keyPair(const KeyPoint& first, const KeyPoint& second)
{
  const TPoint2D between = second.position - first.position;
  const double squared = square(between.x) + square(between.y);
  const double distance = std::sqrt(squared);
  const double ux = between.x / distance;
  const double uy = between.y / distance;
  KeyPair pair;
  pair.table = tableOf(first.kind, second.kind);
  pair.distance = distance;
  pair.bearing = std::atan2(between.y, between.x);
  pair.x = 0.5 * (first.position.x + second.position.x);
  pair.y = 0.5 * (first.position.y + second.position.y);
  pair.distance_variance = along(first.covariance, ux, uy) + along(second.covariance, ux, uy);
  if (first.kind == KeyPointKind::circle)
  {
    pair.first = first.radius;
    pair.first_variance = first.radius_variance;
  }
  else
  {
    const double across = along(first.covariance, -uy, ux) + along(second.covariance, -uy, ux);
    pair.first = wrapToPi(pair.bearing - first.direction);
    pair.first_variance = first.direction_variance + across / squared;
  }
  if (second.kind == KeyPointKind::circle)
  {
    pair.second = second.radius;
    pair.second_variance = second.radius_variance;
  }
  else
  {
    pair.second = wrapToPi(second.direction - first.direction);
    pair.second_variance = first.direction_variance + second.direction_variance;
  }
  return pair;
}

KeyPairIndex::Box::Box(const std::vector<KeyPoint>& points)
{
  constexpr double kMostUnits = (1U << 24U) - 1;
  if (points.empty()) return;
  TPoint2D low = points.front().position;
  TPoint2D high = low;
  for (const KeyPoint& point : points)
  {
    low = {std::min(low.x, point.position.x), std::min(low.y, point.position.y)};
    high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y)};
  }
  x = low.x;
  y = low.y;
  unit = std::max({high.x - low.x, high.y - low.y, kMinDistance}) / kMostUnits;
}

KeyPairIndex::KeyPairIndex(const std::vector<KeyPoint>& points, const MapErrorModel& error)
    : box_(points)
{
  layOutTables();
  const NeighbouringKeyPoints neighbours(points);
  range_ = chosenRange(points, neighbours);
  std::vector<TableWork> work;
  std::uint32_t pairs = 0;
  for (std::size_t a = 0; a < kKeyPointKinds; ++a)
  {
    for (std::size_t b = a; b < kKeyPointKinds; ++b)
    {
      TableWork one{a, b, pairs, 0};
      neighbours.forEachPair(a, b, {kMinDistance, range_},
                             [&](const KeyPoint&, const KeyPoint&) { ++one.pairs; });
      pairs += one.pairs;
      work.push_back(one);
    }
  }
  distance_bins_ = static_cast<std::uint32_t>(std::clamp<std::size_t>(
      pairs / (rows_ * kEntriesPerCell), kMinDistanceBins, kMaxDistanceBins));
  cells_.assign(std::size_t{rows_} * distance_bins_ + 1, 0);
  entries_.resize(pairs);
  // Two threads, each of which takes one table after the other. What waits to be sorted takes
  // little memory that way, and no two tables share a cell.
  std::atomic<std::size_t> next = 0;
  const auto fill = [&]
  {
    std::vector<Placed> placed;
    for (std::size_t k = next++; k < work.size(); k = next++)
    {
      placed.clear();
      placed.reserve(work[k].pairs);
      neighbours.forEachPair(work[k].a, work[k].b, {kMinDistance, range_},
                             [&](const KeyPoint& first, const KeyPoint& second)
                             { placed.push_back(placedEntry(keyPair(first, second), error)); });
      sortInto(tables_[work[k].a * kKeyPointKinds + work[k].b], placed, work[k].before);
    }
  };
  std::future<void> other = std::async(fill);
  fill();
  other.get();
}

/// Sorts the entries of a table by cell, and keeps those of a cell in their order. `before` entries
/// of earlier tables come before them.
void KeyPairIndex::sortInto(Table& table, const std::vector<Placed>& placed, std::uint32_t before)
{
  // While entries are put in, the element after a cell's own says where its next one goes. In the
  // end that is where the next cell begins.
  std::uint32_t* const next = cells_.data() + 1;
  for (const Placed& one : placed) ++next[one.cell];
  const std::size_t first = std::size_t{table.row} * distance_bins_;
  const std::size_t end =
      first + std::size_t{table.first.bins} * table.second.bins * distance_bins_;
  std::exclusive_scan(next + first, next + end, next + first, before);
  std::array<std::uint32_t, 3> largest{};  // codes of standard deviations
  for (const Placed& one : placed)
  {
    entries_[next[one.cell]++] = one.entry;
    for (std::uint32_t k = 0; k < largest.size(); ++k)
      largest[k] = std::max(largest[k], one.entry.deviations >> 5 * k & 31U);
  }
  if (placed.empty()) return;
  table.distance_variance = codedVariances()[largest[0]];
  table.first_variance = codedVariances()[largest[1]];
  table.second_variance = codedVariances()[largest[2]];
}

/// Gives each table its axes and rows.
void KeyPairIndex::layOutTables()
{
  const auto angle = [](std::uint32_t bins) { return Axis{-M_PI, 2 * M_PI / bins, bins, true}; };
  const Axis radius{0, kMaxRadius, 1, false};
  for (std::size_t a = 0; a < kKeyPointKinds; ++a)
  {
    for (std::size_t b = a; b < kKeyPointKinds; ++b)
    {
      const auto round = [](std::size_t kind)
      { return static_cast<KeyPointKind>(kind) == KeyPointKind::circle; };
      Table& table = tables_[a * kKeyPointKinds + b];
      table.first = round(a) ? radius : angle(kBearingBins);
      table.second = round(b) ? radius : angle(kTurnBins);
      table.row = rows_;
      rows_ += table.first.bins * table.second.bins;
    }
  }
}

KeyPairIndex::Binned KeyPairIndex::binned(const Axis& axis, double value)
{
  const double at = std::clamp((value - axis.low) / axis.width, 0.0, axis.bins * (1 - 1e-12));
  const auto bin = static_cast<std::uint32_t>(at);
  return {bin, static_cast<std::uint8_t>((at - bin) * 256)};
}

std::uint32_t KeyPairIndex::distanceBin(double distance) const
{
  const double share = (distance - kMinDistance) / (range_ - kMinDistance);
  const double last = distance_bins_ - 1;
  return static_cast<std::uint32_t>(std::clamp(share * distance_bins_, 0.0, last));
}

KeyPairIndex::Placed KeyPairIndex::placedEntry(const KeyPair& pair,
                                               const MapErrorModel& error) const
{
  const Table& table = tables_[pair.table];
  const Binned first = binned(table.first, pair.first);
  const Binned second = binned(table.second, pair.second);
  const double relative = square(error.relativeSigma(pair.distance));
  const double turned = table.first.is_angle ? relative / square(pair.distance) : 0.0;
  const std::uint32_t deviations =
      codeOfVariance(std::min(pair.distance_variance + relative, kMostOfDistance)) |
      codeOfVariance(std::min(pair.first_variance + turned, kMostOfOthers)) << 5U |
      codeOfVariance(std::min(pair.second_variance, kMostOfOthers)) << 10U;
  Placed placed{};
  const std::uint32_t row = table.row + first.bin * table.second.bins + second.bin;
  placed.cell = row * distance_bins_ + distanceBin(pair.distance);
  Entry& entry = placed.entry;
  const auto x = static_cast<std::uint32_t>(std::lround((pair.x - box_.x) / box_.unit));
  const auto y = static_cast<std::uint32_t>(std::lround((pair.y - box_.y) / box_.unit));
  entry.low_x = static_cast<std::uint16_t>(x);
  entry.low_y = static_cast<std::uint16_t>(y);
  entry.high_x = static_cast<std::uint8_t>(x >> 16U);
  entry.high_y = static_cast<std::uint8_t>(y >> 16U);
  entry.distance = static_cast<std::uint16_t>(std::lround(pair.distance / kDistanceUnit));
  entry.bearing = static_cast<std::uint16_t>(
      static_cast<std::int32_t>(std::lround(pair.bearing / (2 * M_PI) * kFullTurn)));
  entry.first = first.residue;
  entry.second = second.residue;
  entry.deviations = static_cast<std::uint16_t>(deviations);
  return placed;
}

std::size_t KeyPairIndex::find(const KeyPair& observed, std::vector<Run>& runs) const
{
  const Table& table = tables_[observed.table];
  /// The bins of an axis that a gate reaches: `count` of them from `begin` on, wrapping around.
  struct Bins
  {
    std::int64_t begin, count;
  };
  const auto reached = [](const Axis& axis, double value, double variance)
  {
    if (!axis.is_angle) return Bins{0, 1};
    const double tolerance = std::sqrt(kGate * variance) + axis.width / 512;
    const auto low =
        static_cast<std::int64_t>(std::floor((value - tolerance - axis.low) / axis.width));
    const auto high =
        static_cast<std::int64_t>(std::floor((value + tolerance - axis.low) / axis.width));
    return Bins{low + axis.bins, std::min<std::int64_t>(high - low + 1, axis.bins)};
  };
  const Bins first =
      reached(table.first, observed.first, observed.first_variance + table.first_variance);
  const Bins second =
      reached(table.second, observed.second, observed.second_variance + table.second_variance);
  const double tolerance =
      std::sqrt(kGate * (observed.distance_variance + table.distance_variance));
  const std::uint32_t nearest = distanceBin(observed.distance - tolerance);
  const std::uint32_t farthest = distanceBin(observed.distance + tolerance);
  std::size_t count = 0;
  for (std::int64_t a = first.begin; a < first.begin + first.count; ++a)
  {
    const auto base =
        table.row + static_cast<std::uint32_t>(a % table.first.bins) * table.second.bins;
    for (std::int64_t b = second.begin; b < second.begin + second.count; ++b)
    {
      const auto row = base + static_cast<std::uint32_t>(b % table.second.bins);
      const std::size_t cell = std::size_t{row} * distance_bins_;
      const Run run{row, cells_[cell + nearest], cells_[cell + farthest + 1]};
      if (run.begin == run.end) continue;
      runs.push_back(run);
      count += run.end - run.begin;
    }
  }
  return count;
}

void KeyPairIndex::collect(const KeyPair& observed, const Run& run,
                           std::vector<Match>& matches) const
{
  const auto& variances = codedVariances();
  const Table& table = tables_[observed.table];
  const std::uint32_t bin = run.row - table.row;
  // The differences at the lower border of the row's bins, and what a 256th of a bin adds.
  const auto difference = [](const Axis& axis, std::uint32_t axis_bin, double value)
  {
    const double low = axis.low + axis.width * (axis_bin + 0.5 / 256) - value;
    return static_cast<float>(axis.is_angle ? wrapToPi(low) : low);
  };
  const float first_low = difference(table.first, bin / table.second.bins, observed.first);
  const float second_low = difference(table.second, bin % table.second.bins, observed.second);
  const auto first_step = static_cast<float>(table.first.width / 256);
  const auto second_step = static_cast<float>(table.second.width / 256);
  const auto unit = static_cast<float>(kDistanceUnit);
  const auto seen = static_cast<float>(observed.distance);
  const auto gate = static_cast<float>(kGate);
  const auto of_distance = static_cast<float>(observed.distance_variance);
  const auto of_first = static_cast<float>(observed.first_variance);
  const auto of_second = static_cast<float>(observed.second_variance);
  const Entry* const entries = entries_.data();
  std::array<std::uint32_t, 128> fitting;
  for (std::uint32_t begin = run.begin; begin < run.end; begin += fitting.size())
  {
    // An entry is kept or overwritten by the next one: a branch here could not be predicted.
    const std::uint32_t end = std::min<std::uint32_t>(begin + fitting.size(), run.end);
    std::size_t count = 0;
    for (std::uint32_t k = begin; k < end; ++k)
    {
      const Entry& entry = entries[k];
      const float distance = entry.distance * unit - seen;
      const float first = first_low + first_step * entry.first;
      const float second = second_low + second_step * entry.second;
      const bool distance_fits =
          distance * distance <= gate * (of_distance + variances[entry.deviations & 31U]);
      const bool first_fits =
          first * first <= gate * (of_first + variances[entry.deviations >> 5U & 31U]);
      const bool second_fits =
          second * second <= gate * (of_second + variances[entry.deviations >> 10U & 31U]);
      fitting[count] = k;
      count += static_cast<std::size_t>(distance_fits & first_fits & second_fits);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const Entry& entry = entries[fitting[i]];
      const auto bearing =
          static_cast<float>(static_cast<std::int16_t>(entry.bearing) * (2 * M_PI / kFullTurn));
      const double x = box_.x + box_.unit * (entry.high_x << 16 | entry.low_x);
      const double y = box_.y + box_.unit * (entry.high_y << 16 | entry.low_y);
      matches.push_back({static_cast<float>(x), static_cast<float>(y), bearing,
                         first_low + first_step * entry.first,
                         second_low + second_step * entry.second});
    }
  }
}
}  // namespace sigloc
