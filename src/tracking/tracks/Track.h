// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/tracking/Belief.h"
#include "tracking/evidence/CellEvidence.h"
#include "tracking/evidence/VisitedCells.h"
#include "tracking/tracks/SchmidtKalmanFilter.h"

namespace sigloc
{
// Bounds in log-odds, with a dense field and without. The equations are those of sections 8 to 10
// of docs/algorithm.md.
constexpr double kMaxConfirmed = 12.0;  // of kappa, so that a confirmed track can be lost, (8.7)
constexpr double kMinInMap = -1.0;  // of kappa and gamma, so that a doubtful track can be confirmed
constexpr double kMaxAgainst = 2.0;  // largest loss of kappa per metre of travel, (8.7), (8.18)

/// What a track remembers of the mapped features that it has paired.
struct FeatureMemory
{
  SchmidtKalmanFilter correlation;
  std::size_t paired = 0;  // pairings of the last step
  // Share of pairings with features not paired within the last 10 m, summed since the last travel.
  double new_feature_share = 0;
  double doubt = 0;  // log-odds lately lost against clutter, at most 0, eq. (8.20)
};

/// Log-likelihood that a track has lost to the best track of each scan, by two measures whose
/// errors differ. `by_score` counts whole scans by distance, so a moved chair
/// counts as long as it is in view. `by_cells` counts each observed cell once. The smaller loss
/// decides the weight. \cite algorithm eq. (8.5)
struct LogLikelihoodDeficit
{
  double by_score = 0;
  double by_cells = 0;

  double smaller() const { return std::max(by_score, by_cells); }
  LogLikelihoodDeficit operator+(const LogLikelihoodDeficit& other) const
  {
    return {by_score + other.by_score, by_cells + other.by_cells};
  }
};

/// A hypothesis with what the tracker remembers of it.
struct Track
{
  TrackedHypothesis hypothesis;
  double score = 0;  // of the last scan
  mrpt::math::TPose2D left;  // pose before the last prediction
  mrpt::math::TPose2D moved;  // from there to the updated pose; none before the update
  DenseEvidence evidence;  // of the last scan
  mrpt::math::TPose2D evaluated_at;  // pose at which the observed cells are evaluated
  std::uint64_t through = 0;  // beams that pass walls there, as bits
  double mean_score = 0;  // over the last kMemory of travel, steps in doubt left out
  bool found = false;  // this step's relocation found it best of the whole map
  double confirmed = 0;  // log-odds from relocations: kappa of eq. (8.7)
  VisitedCells seen_at_relocations;  // so that only new cells add to kappa
  double tracked_log_odds = 0;  // log-odds from the way driven: gamma of eq. (8.21)
  VisitedCells seen_while_tracked;  // so that only new cells add to gamma
  double tracked_distance = 0;  // [m] driven since the track began
  double searched_distance = 0;  // [m] driven unlocalized before the track began
  CellEvidence explained;  // how it explains the observed cells, each once
  LogLikelihoodDeficit deficit;  // against its rivals
  bool in_field = false;  // tracked in a dense field
  FeatureMemory features;  // used in a map without a dense field

  /// True for a track that this step's relocation has started.
  bool isNew() const { return hypothesis.age == 0; }

  /// Adds to `tracked_log_odds`, within its bounds. Eq. (8.21)
  void addTrackedLogOdds(double log_odds);

  /// Merges a lighter track that has met this one into it. Eq. (8.10)
  void absorb(const Track& lighter);

  /// Takes over the evidence of the track that it branched off.
  void inherit(const Track& parent);

  /// Log-odds that the robot is in the map at all: eq. (8.22) with a field, (8.23) without one.
  double inMapLogOdds() const;

  /// What speaks for the track being in this map, in numbers.
  InMapEvidence summary() const
  {
    return {confirmed,
            tracked_log_odds,
            explained.offWallShare(),
            explained.known(),
            tracked_distance,
            searched_distance,
            score};
  }

  /// True when the log-odds reach `sure`: the track is not given up because of look-alikes.
  bool retained(double sure) const { return std::max(confirmed, inMapLogOdds()) >= sure; }

  /// True when the score `now` of the last scan is lower than its mean by more than `drop`.
  bool hasFallenTo(double now, double drop) const { return now < mean_score - drop; }
};
}  // namespace sigloc
