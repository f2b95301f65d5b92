// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "matching/generation/PatternQuery.h"

namespace sigloc
{
using mrpt::math::TPoint2D;

namespace
{
// Share of the gate within which an order counts as undecided. Every further order costs a query,
// and an order that is missed costs one draw of many.
constexpr double kOrderShare = 0.5;

/// Returns a hash of the members. Two patterns that share one by accident cost one draw of many.
std::uint64_t keyOf(const PatternMembers& members)
{
  std::uint64_t key = 0;
  for (const std::uint32_t member : members)
  {
    key = (key ^ member) * 0x9E3779B97F4A7C15ULL;
    key ^= key >> 32;
  }
  return key;
}
}  // namespace

/// Every pattern is gated by the variance of its own members. So a feature with a large variance
/// does not make the patterns of others match anything. Eq. (4.7)
void PatternGenerator::gatePattern(Query& query) const
{
  const std::size_t size = index_.patternSize();
  double trace = 0;
  for (std::size_t k = 0; k < size; ++k)
  {
    const auto& p = query.scene.views[query.members[k]].feature->position_covariance;
    trace = std::max(trace, p(0, 0) + p(1, 1));
  }
  query.variance = 0.5 * trace + query.map_variance;
  query.gate.residual = query.variance * residual_gate_;
  query.gate.tolerance = std::sqrt(2 * query.gates.scalar * query.variance);
}

bool PatternGenerator::drawPattern(const std::vector<bool>& among, std::uint32_t root,
                                   std::size_t most_orders, Query& query) const
{
  const PreparedScene& scene = query.scene;
  const std::size_t size = index_.patternSize();
  // As many neighbours as in the map's patterns, and a few more, because spurious ones displace
  // real ones.
  const std::size_t reach = index_.neighbours() + (index_.neighbours() + 2) / 3;
  query.near.clear();
  const std::uint32_t* order = scene.orderFrom(root);
  for (std::size_t step = 0; step < scene.size() && query.near.size() < reach; ++step)
  {
    const std::uint32_t member = order[step];
    if (member != root && among[member] && mayJoin(query, root, member))
    {
      query.near.push_back(member);
    }
  }
  if (query.near.size() + 1 < size) return false;

  query.members = {root};
  for (std::size_t k = 1; k < size; ++k)
  {
    const auto left = static_cast<std::uint32_t>(query.near.size() - (k - 1));
    std::swap(query.near[k - 1], query.near[k - 1 + query.random.index(left)]);
    query.members[k] = query.near[k - 1];
  }
  std::sort(query.members.begin(), query.members.begin() + static_cast<std::ptrdiff_t>(size));
  const std::uint64_t key = keyOf(query.members);
  if (std::find(query.tried.begin(), query.tried.end(), key) != query.tried.end()) return false;
  gatePattern(query);
  std::array<TPoint2D, kLargestPattern> places;
  for (std::size_t k = 0; k < size; ++k) places[k] = scene.views[query.members[k]].position();
  query.orders.clear();
  possibleOrders(places.data(), size, kOrderShare * query.gate.tolerance, query.orders);
  if (query.orders.size() > most_orders) return false;
  query.tried.push_back(key);
  return true;
}

bool PatternGenerator::leadsToPartners(const Query& query, const PatternMembers& observed,
                                       const std::uint32_t* mapped) const
{
  if (query.partners.empty()) return false;
  std::size_t k = 0;
  while (k < index_.patternSize() && query.partners[observed[k]] == mapped[k]) ++k;
  return k == index_.patternSize();
}

/// True when the index has patterns of the root with this member, at the pose whose look-alikes are
/// sought. While no pose is known, every member may join.
bool PatternGenerator::mayJoin(const Query& query, std::uint32_t root, std::uint32_t member) const
{
  return query.partners.empty() ||
         index_.isNeighbour(query.map, query.partners[root], query.partners[member]);
}
}  // namespace sigloc
