// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/generation/pattern_order.h"

#include "signature/DirectedFeature.h"

#include <algorithm>

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
/// Appends the orders of the members besides the ends (order[2], ...) that are ascending along the
/// side up to the tolerance. The members must be given sorted by index.
void appendAscending(const std::array<double, kLargestPattern>& along, std::size_t count,
                     double tolerance, PatternOrder order, std::vector<PatternOrder>& orders)
{
  const auto begin = order.begin() + 2;
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
  do
  {
    bool ascending = true;
    for (std::size_t a = 2; a < count && ascending; ++a)
    {
      for (std::size_t b = a + 1; b < count && ascending; ++b)
      {
        ascending = along[order[a]] <= along[order[b]] + tolerance;
      }
    }
    if (ascending) orders.push_back(order);
  } while (std::next_permutation(begin, end));
}
}  // namespace

void possibleOrders(const TPoint2D* places, std::size_t count, double tolerance,
                    std::vector<PatternOrder>& orders)
{
  double longest = 0;
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = a + 1; b < count; ++b)
    {
      const TPoint2D side = places[b] - places[a];
      longest = std::max(longest, std::sqrt(dot(side, side)));
    }
  }
  for (std::size_t a = 0; a < count; ++a)
  {
    for (std::size_t b = 0; b < count; ++b)
    {
      const TPoint2D side = places[b] - places[a];
      const double length = std::sqrt(dot(side, side));
      if (a == b || length < longest - tolerance) continue;
      PatternOrder order{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
      std::array<double, kLargestPattern> along{};
      double lean = 0;
      std::size_t filled = 2;
      for (std::size_t k = 0; k < count; ++k)
      {
        if (k == a || k == b) continue;
        along[k] = length > 0 ? dot(places[k] - places[a], side) / length : 0;
        lean += along[k] - 0.5 * length;
        order[filled++] = static_cast<std::uint8_t>(k);
      }
      // The side starts from the end that the others lean to.
      if (lean > tolerance * static_cast<double>(count - 2)) continue;
      appendAscending(along, count, tolerance, order, orders);
    }
  }
}

PatternOrder canonicalOrder(const TPoint2D* places, std::size_t count)
{
  std::vector<PatternOrder> orders;
  // Rounding must not exclude both ends of a pattern that leans to neither of them.
  constexpr double kRounding = 1e-9;  // [m]
  possibleOrders(places, count, kRounding, orders);
  return orders.front();
}
}  // namespace sigloc
