// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sigloc
{
/// Places that are added one by one, hashed into `slots` lists of cells, so that those near a place
/// are found without going through all. The caller tests what is found: moving all places must not
/// change what is near.
template <std::size_t slots>
class NearPlaces
{
 public:
  /// `reach` > 0 [m] is the distance along either axis up to which places are found for certain.
  explicit NearPlaces(float reach) : reach_(reach), cells_per_metre_(0.499F / reach)
  {
    newest_in_.fill(kNone);
  }

  /// Adds a place [m]. Its index is the number of those before it.
  void add(float x, float y)
  {
    std::uint32_t& newest = newest_in_[slotOf(cellOf(x), cellOf(y))];
    before_.push_back(newest);
    newest = static_cast<std::uint32_t>(before_.size() - 1);
  }

  /// Calls `found(index)` for every place within reach of (x, y), and for others, until it returns
  /// true. Returns whether it did. A place may be found more than once.
  template <class Found>
  bool anyNear(float x, float y, const Found& found) const
  {
    // A cell is twice the reach wide: these four hold all that may be near.
    const std::int32_t column = cellOf(x - reach_);
    const std::int32_t row = cellOf(y - reach_);
    return anyIn(slotOf(column, row), found) || anyIn(slotOf(column + 1, row), found) ||
           anyIn(slotOf(column, row + 1), found) || anyIn(slotOf(column + 1, row + 1), found);
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::int32_t cellOf(float coordinate) const
  {
    const float cells = coordinate * cells_per_metre_;
    const auto towards_zero = static_cast<std::int32_t>(cells);
    return towards_zero - (static_cast<float>(towards_zero) > cells ? 1 : 0);
  }
  static std::size_t slotOf(std::int32_t column, std::int32_t row)
  {
    const std::uint32_t mixed = static_cast<std::uint32_t>(column) * 73856093U ^
                                static_cast<std::uint32_t>(row) * 19349663U;
    return mixed % slots;
  }
  template <class Found>
  bool anyIn(std::size_t slot, const Found& found) const
  {
    for (std::uint32_t k = newest_in_[slot]; k != kNone; k = before_[k])
    {
      if (found(k)) return true;
    }
    return false;
  }

  float reach_, cells_per_metre_;
  std::array<std::uint32_t, slots> newest_in_;
  std::vector<std::uint32_t> before_;  // the place added before each in its slot
};
}  // namespace sigloc
