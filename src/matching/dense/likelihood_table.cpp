// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/likelihood_table.h"

#include <cmath>

namespace sigloc
{
namespace
{
constexpr double kSharpSigma = 0.055;  // [m] without the blur of the map, eq. (6.14)
constexpr double kCoarseSigma = 0.25;  // [m]

LikelihoodTable makeTable(double sigma)
{
  LikelihoodTable table{};
  for (std::size_t d = 0; d < DenseCell::kFar; ++d)
  {
    const double distance = static_cast<double>(d) * DenseField::kDistanceUnit;
    table[d] = static_cast<float>(std::exp(-0.5 * distance * distance / (sigma * sigma)));
  }
  return table;
}

}  // namespace

const LikelihoodTable& fineTable()
{
  static const LikelihoodTable kTable = makeTable(kFineSigma);
  return kTable;
}
const LikelihoodTable& coarseTable()
{
  static const LikelihoodTable kTable = makeTable(kCoarseSigma);
  return kTable;
}

SharpTable::SharpTable(double wall_blur)
{
  const double variance = kSharpSigma * kSharpSigma + wall_blur * wall_blur;
  per_square_ = static_cast<float>(kSteps / (16 * variance));
  for (std::size_t i = 0; i < values_.size(); ++i)
  {
    const double square = static_cast<double>(i) * 16 * variance / kSteps;
    values_[i] = static_cast<float>(std::exp(-0.5 * square / variance));
  }
}
}  // namespace sigloc
