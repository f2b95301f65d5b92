// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace sigloc
{
/// The true path of a log, for scoring only; never handed to the localizer.
class GroundTruth
{
 public:
  /// Reads rows of numbers, or the key frames of a `.simplemap[.gz]` with their time stamps. Rows
  /// have 3 columns (x y phi, row = step), 4 (index or time, x y phi) or 7 (time, x y z yaw pitch
  /// roll). Every pose p becomes map_from_truth (+) p. Throws std::runtime_error naming the path
  /// and the reason.
  static GroundTruth read(const std::filesystem::path& path,
                          const mrpt::math::TPose2D& map_from_truth = {});

  /// Returns the pose at a step or time: by row, by index, or, for times, linearly interpolated
  /// between neighbours at most `max_gap` seconds away. nullopt where there is no truth.
  std::optional<mrpt::math::TPose2D> at(std::size_t step, double time, double max_gap = 1.0) const;

 private:
  enum class Key
  {
    row,
    index,
    time
  };
  struct Entry
  {
    double key;
    mrpt::math::TPose2D pose;
  };
  static std::vector<Entry> inTimeOrder(const std::vector<Entry>& rows);

  Key key_ = Key::row;
  std::vector<Entry> entries_;
};
}  // namespace sigloc
