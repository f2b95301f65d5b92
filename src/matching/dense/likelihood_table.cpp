// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/likelihood_table.h"

#include <cmath>

#include "sigloc/map/DenseField.h"

namespace sigloc
{
namespace
{
constexpr double kFineSigma = 0.12;  // [m]
constexpr double kCoarseSigma = 0.25;  // [m]

LikelihoodTable makeTable(double sigma)
{
  LikelihoodTable table{};
  for (std::size_t d = 0; d < 255; ++d)
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

}  // namespace sigloc
