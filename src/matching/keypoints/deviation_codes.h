// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sigloc
{
constexpr std::size_t kDeviationCodes = 32;  ///< of a standard deviation, in five bits

/// Returns the variances [m^2 or rad^2] that the codes stand for.
inline const std::array<float, kDeviationCodes>& codedVariances()
{
  constexpr double kLeastDeviation = 0.002;  // [m or rad]
  constexpr double kDeviationRatio = 1.25;  // from one code to the next
  static const std::array<float, kDeviationCodes> kVariances = []
  {
    std::array<float, kDeviationCodes> table{};
    double deviation = kLeastDeviation;
    for (float& variance : table)
    {
      variance = static_cast<float>(deviation * deviation);
      deviation *= kDeviationRatio;
    }
    return table;
  }();
  return kVariances;
}

/// Returns the code of the least variance that is not below the given one, or the last code.
inline std::uint32_t codeOfVariance(double variance)
{
  // A binary search without branches: no processor foresees which way it goes.
  const auto& variances = codedVariances();
  std::uint32_t code = 0;
  for (std::uint32_t step = kDeviationCodes / 2; step > 0; step /= 2)
    code += variances[code + step - 1] < variance ? step : 0;
  return code;
}
}  // namespace sigloc
