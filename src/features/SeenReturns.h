// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "sigloc/features/LaserScan.h"

namespace sigloc
{
/// Whether any of some scans has a valid return.
class SeenReturns
{
 public:
  void add(const LaserScan& scan);

  bool anyScan() const { return scans_ > 0; }

  /// True where there are scans, and none has a valid return.
  bool none() const { return scans_ > 0 && !any_; }

  /// Returns one line for people that says why there is none.
  std::string whyNone() const;

 private:
  std::size_t scans_ = 0;
  bool any_ = false;
  double limit_ = 0;  // [m], the largest range of a laser
};
}  // namespace sigloc
