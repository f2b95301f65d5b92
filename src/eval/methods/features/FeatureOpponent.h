// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "geometry/chi_square.h"
#include "matching/features/FeatureQuery.h"
#include "matching/features/PairLists.h"
#include "signature/pose_fit.h"

namespace sigloc
{
/// The common part of the opponents that use features alone. It has the map with its sorted binary
/// constraints, and the pose that pairings fix with its joint chi-square test. It has a budget of
/// operations, and ranks by the number of pairings. The opponents share the constraints of the
/// signatures, so that all use the same evidence. They share no part of our search or verification.
class FeatureOpponent : public FeatureHypothesisGenerator
{
 public:
  /// Operations (signatures compared and checks) after which a search gives up: a few seconds.
  static constexpr std::uint64_t kBudget = 100'000'000;

  /// Keeps a reference to the map.
  FeatureOpponent(const FeatureMap& map, const GeneratorOptions& options,
                  std::uint64_t budget = kBudget);

  /// Hypotheses with the most pairings come first; of equally many, those that fit better.
  /// `log_odds` holds that rank: the pairings less the residual's share of the joint gate. A search
  /// that ran out of its budget counts in `MatchingCounters::cut_short`.
  std::vector<FeatureHypothesis> generate(const std::vector<Feature>& observed,
                                          MatchingCounters& counters) const final;

 protected:
  /// The pose of a set of pairings, by least squares.
  struct Fit
  {
    PoseEstimate pose;
    double distance = 0;  ///< joint squared Mahalanobis distance of all residuals
    int degrees = 0;  ///< of freedom of that distance
  };

  /// State of one query that all searches need.
  struct Query : FeatureQuery
  {
    Query(const std::vector<Feature>& features, const FeatureOpponent& by,
          MatchingCounters& counted_in)
        : FeatureQuery(features, by.map_, by.options_, by.gates_, counted_in),
          limit(counters.signature_pairs + counters.checks + by.budget_)
    {
    }
    bool exhausted() const { return counters.signature_pairs + counters.checks >= limit; }

    std::uint64_t limit;  ///< of operations counted
  };

  virtual void search(Query& query) const = 0;
  /// How many pairings fix the first pose, for the significance of what grows from it.
  virtual std::uint32_t baseSize() const = 0;

  const PreparedMap& map() const { return map_; }
  const GeneratorOptions& options() const { return options_; }
  const BinaryGates& gates() const { return gates_; }

  bool unary(const Query& query, std::uint32_t observed, std::uint32_t mapped) const;
  /// The binary test of two pairings, counted as a check. One map feature is never paired twice.
  bool binary(Query& query, const FeaturePairing& a, const FeaturePairing& b) const;
  /// L_j(i, k) from the sorted binary constraints, counted as a check.
  void gather(Query& query, const FeaturePairing& anchor, std::uint32_t j,
              std::vector<std::uint32_t>& candidates) const;
  /// nullopt when the pairings (at least two) fix no pose.
  std::optional<Fit> fit(const Query& query, const std::vector<FeaturePairing>& pairings) const;
  bool jointlyCompatible(double distance, int degrees) const
  {
    return distance <= chi_square_(std::max(1, degrees));
  }
  void add(Query& query, const std::vector<FeaturePairing>& pairings, const Fit& fit) const;

 private:
  PreparedMap map_;
  GeneratorOptions options_;
  ChiSquareGates chi_square_;
  BinaryGates gates_;
  PairLists lists_;
  std::uint64_t budget_;
};
}  // namespace sigloc
