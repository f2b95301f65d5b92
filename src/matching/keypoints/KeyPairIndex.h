// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/LargeVector.h"
#include "matching/keypoints/KeyPoint.h"
#include "sigloc/geometry/GaussianPose.h"

namespace sigloc
{
/// The binary constraints of an ordered pair of key points, none of which depends on the pose. For
/// a circle its radius takes the place of the direction that it lacks.
struct KeyPair
{
  std::size_t table = 0;  ///< of the two kinds
  double distance = 0;  ///< [m]
  double first = 0;  ///< bearing of the second in the first one's frame [rad], or a radius [m]
  double second = 0;  ///< turn from direction to direction [rad], or a radius [m]
  double distance_variance = 0;  ///< [m^2]
  double first_variance = 0;  ///< [rad^2 or m^2]
  double second_variance = 0;  ///< [rad^2 or m^2]
  double x = 0, y = 0;  ///< [m], the middle of the two
  double bearing = 0;  ///< [rad], of the second from the first, in the frame of the key points
};

/// Returns the constraints of a pair. The second kind is not before the first one.
/// \cite algorithm eq. (3.3) to (3.5)
KeyPair keyPair(const KeyPoint& first, const KeyPoint& second);

/// An index of the pairs of mapped key points that are at least 0.7 m and at most range() apart, by
/// their binary constraints. Those that fit an observed pair lie in a few runs of memory, so they
/// are counted without being read. Const and thread-safe. \cite algorithm section 4
/// (f)
class KeyPairIndex
{
 public:
  static constexpr double kMinDistance = 0.7;  ///< [m]
  // Most that counts of a mapped pair's variances. A few vague pairs would widen all searches.
  static constexpr double kMostOfDistance = 0.05 * 0.05;  ///< [m^2]
  static constexpr double kMostOfOthers = 0.035 * 0.035;  ///< [rad^2 or m^2]

  KeyPairIndex(const std::vector<KeyPoint>& points, const MapErrorModel& error);

  /// A mapped pair that fits an observed one.
  struct Match
  {
    float x = 0, y = 0;  ///< [m], the middle of the mapped two
    float bearing = 0;  ///< [rad], of the second from the first, in the map
    float first = 0, second = 0;  ///< what the map has more than the observed pair
  };

  /// Entries of one row whose distance may fit.
  struct Run
  {
    std::uint32_t row = 0;
    std::uint32_t begin = 0, end = 0;
  };

  /// Appends the runs of entries that may fit an observed pair, and returns how many entries they
  /// hold.
  std::size_t find(const KeyPair& observed, std::vector<Run>& runs) const;

  /// Appends the entries of a run that pass the gates. \cite algorithm eq. (3.4)
  void collect(const KeyPair& observed, const Run& run, std::vector<Match>& matches) const;

  /// Returns the distance [m] up to which pairs are held: that within which a key point has 64
  /// partners on average. It is longer where the map has fewer than 50 000 pairs, 12 m at most.
  double range() const { return range_; }
  std::size_t size() const { return entries_.size(); }

 private:
  /// A mapped pair. What its row says is left out; standard deviations are rounded up.
  struct Entry
  {
    std::uint16_t low_x, low_y;  // the lower bytes of the middle, in units of the index
    std::uint16_t distance;  // of kDistanceUnit
    std::uint16_t bearing;  // of a full turn
    std::uint16_t deviations;  // three times five bits: codes of standard deviations
    std::uint8_t high_x, high_y;  // the highest bytes of the middle
    std::uint8_t first, second;  // within the bin of the row
  };
  static_assert(sizeof(Entry) == 14, "a map has some sixty of them a square metre");

  /// Units of 24 bits for positions in the box around all key points.
  struct Box
  {
    explicit Box(const std::vector<KeyPoint>& points);

    double x = 0, y = 0;  // [m], its lower left corner
    double unit = 1;  // [m]
  };

  /// An entry on its way to its cell.
  struct Placed
  {
    std::uint32_t cell;
    Entry entry;
  };

  /// How a coordinate is cut into bins: directions turn around, radii have one bin.
  struct Axis
  {
    double low = 0, width = 1;
    std::uint32_t bins = 1;
    bool is_angle = false;
  };
  struct Table
  {
    Axis first, second;
    std::uint32_t row = 0;  // of its first bins
    double distance_variance = 0, first_variance = 0, second_variance = 0;  // largest of any entry
  };

  static constexpr double kDistanceUnit = 1.0 / 5000;  // [m]
  static constexpr std::size_t kTables = kKeyPointKinds * kKeyPointKinds;

  /// A value of an axis: its bin, and the 256th of the bin.
  struct Binned
  {
    std::uint32_t bin;
    std::uint8_t residue;
  };
  static Binned binned(const Axis& axis, double value);

  void layOutTables();
  std::uint32_t distanceBin(double distance) const;
  Placed placedEntry(const KeyPair& pair, const MapErrorModel& error) const;
  void sortInto(Table& table, const std::vector<Placed>& placed, std::uint32_t before);

  std::array<Table, kTables> tables_{};
  Box box_;
  double range_ = 0;  // [m]
  std::uint32_t rows_ = 0;
  std::uint32_t distance_bins_ = 1;  // of a row
  LargeVector<std::uint32_t> cells_;  // by row, then by distance: the first entry; and the end
  LargeVector<Entry> entries_;  // by cell
};
}  // namespace sigloc
