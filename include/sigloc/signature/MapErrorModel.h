// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc
{
/// The map's own error, beyond the covariance of each feature: relative between two features at
/// distance d, and common to a whole neighbourhood. \cite algorithm section 3
struct MapErrorModel
{
  double relative_constant = 0.02;  ///< [m], a of sigma_rel(d) = a + b d
  double relative_slope = 0.002;  ///< [-], b
  double common_sigma = 0.10;  ///< [m], moves a neighbourhood together

  /// sigma_rel(d) [m], \cite algorithm eq. (3.2)
  double relativeSigma(double distance) const
  {
    return relative_constant + relative_slope * distance;
  }
};
}  // namespace sigloc
