// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>

namespace sigloc
{
/// True for a matrix that is finite, symmetric but for rounding, and positive definite.
inline bool isPositiveDefinite(const Eigen::Matrix3d& matrix)
{
  constexpr double kRounding = 1e-6;
  return matrix.allFinite() &&
         (matrix - matrix.transpose()).norm() < kRounding * (1.0 + matrix.norm()) &&
         Eigen::LLT<Eigen::Matrix3d>(matrix).info() == Eigen::Success;
}
}  // namespace sigloc
