// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/img/CImage.h>

#include <vector>

namespace sigloc
{
/// Gathers pictures of a run, shrunk, and lays them out on one sheet, in rows from the upper left.
class ContactSheet
{
 public:
  static constexpr std::size_t kMost = 12;  ///< further pictures replace the last one

  /// Adds a picture of three channels.
  void add(const mrpt::img::CImage& picture);
  bool empty() const { return small_.empty(); }
  /// Returns the sheet; at least one picture must have been added.
  mrpt::img::CImage sheet() const;

 private:
  std::vector<mrpt::img::CImage> small_;
};
}  // namespace sigloc
