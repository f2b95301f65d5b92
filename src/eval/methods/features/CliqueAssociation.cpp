// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/methods/features/CliqueAssociation.h"

#include <algorithm>
#include <boost/graph/adjacency_matrix.hpp>
#include <boost/graph/bron_kerbosch_all_cliques.hpp>

namespace sigloc
{
namespace
{
using Graph = boost::adjacency_matrix<boost::undirectedS>;

/// Boost's search can only be left by an exception.
struct OutOfBudget
{
};

/// Keeps the largest cliques; each one visited counts as a check.
struct LargestCliques
{
  std::vector<std::vector<std::size_t>>& cliques;
  std::uint64_t& checks;
  std::uint64_t most_checks;

  template <class Clique>
  void clique(const Clique& members, const Graph& /*graph*/)
  {
    if (++checks >= most_checks) throw OutOfBudget{};
    const std::size_t largest = cliques.empty() ? 0 : cliques.front().size();
    if (members.size() < largest) return;
    if (members.size() > largest) cliques.clear();
    cliques.emplace_back(members.begin(), members.end());
  }
};
}  // namespace

/// The pairings that are compatible with one pairing, and which of them are compatible with each
/// other.
struct CliqueAssociation::Neighbourhood
{
  std::vector<FeaturePairing> pairings;
  std::vector<std::vector<std::size_t>> compatible;

  /// Repeatedly removes the nodes that have too few neighbours to be in a clique of `wanted`.
  void peel(std::size_t wanted);
};

void CliqueAssociation::Neighbourhood::peel(std::size_t wanted)
{
  std::vector<std::size_t> degree;
  std::vector<std::size_t> leaving;
  std::vector<bool> left(pairings.size(), false);
  for (std::size_t a = 0; a < pairings.size(); ++a)
  {
    degree.push_back(compatible[a].size());
    if (degree[a] + 1 < wanted) leaving.push_back(a);
  }
  while (!leaving.empty())
  {
    const std::size_t a = leaving.back();
    leaving.pop_back();
    if (left[a]) continue;
    left[a] = true;
    for (const std::size_t b : compatible[a])
    {
      if (!left[b] && degree[b]-- + 1 == wanted) leaving.push_back(b);
    }
  }
  std::vector<std::size_t> renamed(pairings.size());
  std::size_t kept = 0;
  for (std::size_t a = 0; a < pairings.size(); ++a) renamed[a] = left[a] ? 0 : kept++;
  Neighbourhood rest;
  for (std::size_t a = 0; a < pairings.size(); ++a)
  {
    if (left[a]) continue;
    rest.pairings.push_back(pairings[a]);
    rest.compatible.emplace_back();
    for (const std::size_t b : compatible[a])
    {
      if (!left[b]) rest.compatible.back().push_back(renamed[b]);
    }
  }
  *this = std::move(rest);
}

void CliqueAssociation::gatherNeighbourhood(Query& query, const FeaturePairing& first,
                                            Neighbourhood& neighbourhood) const
{
  neighbourhood.pairings.clear();
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t j = first.observed + 1; j < query.scene.size(); ++j)
  {
    gather(query, first, j, candidates);
    for (const std::uint32_t l : candidates) neighbourhood.pairings.push_back({j, l});
  }
  const std::vector<FeaturePairing>& pairings = neighbourhood.pairings;
  neighbourhood.compatible.assign(pairings.size(), {});
  for (std::size_t a = 0; a < pairings.size(); ++a)
  {
    for (std::size_t b = a + 1; b < pairings.size(); ++b)
    {
      if (pairings[a].observed == pairings[b].observed) continue;
      if (!binary(query, pairings[a], pairings[b])) continue;
      neighbourhood.compatible[a].push_back(b);
      neighbourhood.compatible[b].push_back(a);
    }
  }
}

void CliqueAssociation::searchCliques(Query& query, const FeaturePairing& first,
                                      Neighbourhood& neighbourhood, std::size_t& most) const
{
  neighbourhood.peel(most - 1);
  const std::size_t size = neighbourhood.pairings.size();
  if (size + 1 < most) return;
  Graph graph(size);
  for (std::size_t a = 0; a < size; ++a)
  {
    for (const std::size_t b : neighbourhood.compatible[a])
    {
      if (a < b) boost::add_edge(a, b, graph);
    }
  }
  std::vector<std::vector<std::size_t>> cliques;
  const std::uint64_t budget = query.limit - query.counters.signature_pairs;
  try
  {
    boost::bron_kerbosch_all_cliques(graph, LargestCliques{cliques, query.counters.checks, budget},
                                     most - 1);
  }
  catch (const OutOfBudget&)
  {
  }
  std::vector<FeaturePairing> pairings;
  for (const std::vector<std::size_t>& clique : cliques)
  {
    pairings.assign(1, first);
    for (const std::size_t a : clique) pairings.push_back(neighbourhood.pairings[a]);
    ++query.counters.hypotheses;
    const auto pose = fit(query, pairings);
    // Distances can't exclude mirror images, the joint fit can.
    if (!pose || !jointlyCompatible(pose->distance, pose->degrees)) continue;
    most = std::max(most, pairings.size());
    add(query, pairings, *pose);
  }
}

void CliqueAssociation::search(Query& query) const
{
  const auto n = static_cast<std::uint32_t>(query.scene.size());
  std::size_t most = std::min<std::size_t>(options().min_support, n);
  Neighbourhood neighbourhood;
  for (std::uint32_t i = 0; i + most <= n; ++i)
  {
    for (std::uint32_t k = 0; k < map().size() && !query.exhausted(); ++k)
    {
      if (!unary(query, i, k)) continue;
      gatherNeighbourhood(query, {i, k}, neighbourhood);
      searchCliques(query, {i, k}, neighbourhood, most);
    }
  }
}
}  // namespace sigloc
