// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "matching/dense/DenseVerifier.h"

namespace sigloc::test
{
/// Three returns in each of a wall's cells of 0.5 m, `cells` of them along x, and one that is
/// isolated, behind the robot.
inline DenseScan wallAhead(int cells)
{
  DenseScan scan;
  for (int k = 0; k < 3 * cells; ++k)
  {
    scan.x.push_back(0.1F + static_cast<float>(k) / 6.0F);
    scan.y.push_back(2.1F);
    scan.isolated.push_back(0);
  }
  scan.x.push_back(-3.0F);
  scan.y.push_back(0.0F);
  scan.isolated.push_back(1);
  return scan;
}
}  // namespace sigloc::test
