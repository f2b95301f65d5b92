// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace sigloc
{
/// Returns the value below which a chi-square variable stays with the given probability.
/// Throws std::invalid_argument unless 0 < probability < 1 and degrees >= 1.
double chiSquareGate(double probability, int degrees);

/// Gates of one probability for 1..max degrees of freedom, from a table.
class ChiSquareGates
{
 public:
  ChiSquareGates(double probability, int max_degrees);

  /// Gate for `degrees` >= 1; beyond the table it is computed.
  double operator()(int degrees) const;

 private:
  double probability_;
  std::vector<double> gates_;
};
}  // namespace sigloc
