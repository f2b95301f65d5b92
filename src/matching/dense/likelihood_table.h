// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Likelihood in [0, 1] of a return, for each distance of a dense cell.
/// \cite algorithm eq. (6.3)
using LikelihoodTable = std::array<float, DenseCell::kFar + 1>;

/// [m], of the fine likelihood. Refinements and the test of their covariance share its scale.
constexpr double kFineSigma = 0.12;

/// Returns the table for kFineSigma (fine) or a sigma of 0.25 m (coarse).
const LikelihoodTable& fineTable();
const LikelihoodTable& coarseTable();

/// The sharp likelihood by the squared distance from the ridge of the nearest wall, up to four
/// sigmas: linear between the values of a table. \cite algorithm eq. (6.3), (6.14)
class SharpTable
{
 public:
  /// `wall_blur` [m] is how far the ridges of the map lie from its walls.
  explicit SharpTable(double wall_blur);

  float at(float square) const
  {
    const float step = std::min(square * per_square_, static_cast<float>(kSteps));
    const auto i = static_cast<std::size_t>(step);
    return values_[i] + (step - static_cast<float>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr std::size_t kSteps = 512;
  float per_square_;  // [1/m^2]
  std::array<float, kSteps + 2> values_{};
};
}  // namespace sigloc
