// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "matching/dense/DenseVerifier.h"
#include "sigloc/tracking/Belief.h"
#include "tracking/evidence/CellEvidence.h"
#include "tracking/evidence/VisitedCells.h"
#include "tracking/tracks/SchmidtKalmanFilter.h"

namespace sigloc
{
// Bounds of what one relocation or one unit of travel can tell, in log-odds; with a dense field and
// without. Section 8 of docs/algorithm.md gives them where they are used.
constexpr double kMaxRelative = 3.0;  // between rivals
constexpr double kMaxLost = 3.0;  // for "somewhere else"
constexpr double kMaxConfirmed = 12.0;  // what was confirmed long ago can still be lost
constexpr double kMinConfirmed = -1.0;  // what addScan-alikes hid for long can still be confirmed
constexpr double kMaxAgainst = 2.0;  // against a track, a metre
constexpr double kRetained = 4.0;  // from which on a track is not given up for a addScan-alike
constexpr double kFarBetter = 4.0;  // by which a place must beat what is held

/// What a track remembers of the mapped features it was paired with.
struct FeatureMemory
{
  SchmidtKalmanFilter correlation;
  std::size_t paired = 0;  // in the last step
  double fresh_share = 0;  // of them, those that were not seen on the last stretch
  double doubt = 0;  // log-odds lately lost against clutter, at most 0, eq. (8.20)
};

/// Log-odds that a track has lost to the best of each addScan, the first included, as two judges
/// see it that err in different ways: `by_score` hears every scan again after a while, and a chair
/// that was moved as long as it is in view; `by_cells` hears each piece of the ground once. The
/// smaller loss is what the track has paid. Eq. (8.5)
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

/// What a claim of a track stands on besides what the track itself remembers.
struct ClaimContext
{
  double next = 0;  // weight of the next track
  double range = 0;  // [m] median of a scan, lately
  double unexplained = 0;  // share of the scans that the best track leaves unexplained, lately
};

/// A hypothesis with what the tracker remembers of it.
struct Track
{
  TrackedHypothesis hypothesis;
  double score = 0;  // of the last scan
  DenseEvidence evidence;  // of the last scan
  mrpt::math::TPose2D evaluated_at;  // where the ground of that is judged, near the hypothesis
  double mean_score = 0;  // running mean
  bool found = false;  // best of the whole map by this step's relocation
  std::size_t relocations = 0;  // since the track began; not counted without a field
  std::size_t times_found = 0;  // best of the whole map by so many of them
  double confirmed = 0;  // log-odds that relocations, each blind to the track, have given it
  VisitedCells seen;  // what that evidence rests on
  double tracked_log_odds =
      0;  // log-odds from how the map explained what came into view on the way
  VisitedCells seen_while_tracked;  // what has come into view
  std::optional<double> misfit;  // of what is seen, known or new, lately; none without a field
  double tracked_distance = 0;  // [m] driven since the track began
  CellEvidence explained;  // how it explains what is seen, each thing once
  LogLikelihoodDeficit deficit;  // its rivals
  FeatureMemory features;  // in a map without a dense field

  /// True of a track that this step's relocation has started.
  bool isNew() const { return hypothesis.age == 0; }

  /// Notes a relocation: whether it found the track best of the whole map.
  void noteRelocation(bool found_best)
  {
    found = found_best;
    ++relocations;
    if (found_best) ++times_found;
  }

  /// Adds to `tracked_log_odds`, within its bounds.
  void addTrackedLogOdds(double log_odds);

  /// Takes what the map leaves unexplained of the last scan into its mean over some travel [m].
  void addFit(double travel);

  /// Takes over what is known of the track that it branched off.
  void inherit(const Track& parent);

  /// Log-odds of standing in the map at all, eq. (8.22)
  double inMapLogOdds() const;

  /// The same for a claim, which with a field also asks how long the track has been
  /// tracked_log_odds, eq. (8.25), how far other places contest it, eq. (8.28), and how many things
  /// it fails to explain, eq. (8.29).
  double claimLogOdds(const ClaimContext& now) const;

  /// How far relocations have found other places instead, in [0, 1]; few tell nothing.
  double missed() const;

  /// Log-odds by how many of the things in view the track has explained, eq. (8.29)
  double explainedCellsLogOdds(const ClaimContext& now) const;

  /// Whether a relocation or the way has told enough not to give the track up for a addScan-alike.
  bool retained() const { return std::max(confirmed, inMapLogOdds()) >= kRetained; }

  /// Whether the score `now` of the last scan is less by `drop` than the track's scores used to be.
  bool hasFallenTo(double now, double drop) const
  {
    return hypothesis.age > 1 && now < mean_score - drop;
  }
};
}  // namespace sigloc
