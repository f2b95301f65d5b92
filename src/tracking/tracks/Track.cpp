// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/Track.h"

#include <cmath>

#include "matching/candidate_probabilities.h"

namespace sigloc
{
namespace
{
// The lasting fit, eq. (8.22).
constexpr double kMisfitMemory = 3.0;  // [m] of travel over which the mean misfit fades
constexpr double kMisfitFloor = 0.03;  // share that even the right pose leaves unexplained
constexpr double kNeutralMisfit = 0.068;  // misfit with its floor at which the term is 0
constexpr double kFitSlope = 1.04;  // log-odds per unit of the logarithm of the misfit

// Survival, eq. (8.25).
constexpr double kSurvivalSlope = 0.65;  // [1/m] log-odds per metre survived
constexpr double kSurvivalStart = 10.0;  // [m] driven before the term begins to grow
constexpr double kSurvivalEnd = 20.0;  // [m] driven after which it grows no more
constexpr double kSurvivalMostMisfit = 0.2;  // unexplained share of cells from which it is 0
constexpr double kSurvivalFullMisfit = 0.15;  // unexplained share of cells up to which it is full

// Contested by other poses, eq. (8.28).
constexpr double kRivalSlope = 0.6;  // log-odds lost per unit of ln of the next track's weight
constexpr double kNegligibleWeight = 1e-4;  // weight of the next track that costs nothing
constexpr double kDeficitSlope = 0.2;  // log-odds lost per unit of log-likelihood deficit
constexpr double kUsualDeficit = 4.0;  // deficit that costs nothing: the right pose has it too
constexpr double kMissedPenalty = 2.0;  // log-odds lost where relocations find other poses best
constexpr std::size_t kMinRelocations = 4;  // with fewer relocations nothing is lost
constexpr double kOftenFound = 0.5;  // share that found this track best, from which nothing is lost
constexpr double kSeldomFound = 0.3;  // share that found this track best, up to which all is lost

// Number of things, eq. (8.29).
constexpr double kUnexplainedSlope = 16.0;  // [1/m] log-odds per metre of unexplained share * range
constexpr double kNeutralUnexplained = 0.25;  // [m] unexplained share * range where the term is 0
constexpr double kMostAgainst = 4.0;  // largest log-odds that the term takes away
constexpr double kMostFor = 1.5;  // largest log-odds that the term adds
constexpr double kFullWay = 15.0;  // [m] driven after which it may add kMostFor
constexpr double kFarthest = 8.0;  // [m] bound of the range
constexpr double kLittleInScans = 0.15;  // unexplained share of scans up to which the term is full
constexpr double kMuchInScans = 0.25;  // unexplained share of scans from which it is 0
constexpr double kLittleOfCells = 0.25;  // unexplained share of cells up to which the term is full
constexpr double kMuchOfCells = 0.35;  // unexplained share of cells from which it is 0

// The way driven, eq. (8.21): bounds of its log-odds.
constexpr double kMinTracked = -8.0;
constexpr double kMaxTracked = 12.0;
}  // namespace

void Track::addTrackedLogOdds(double log_odds)
{
  tracked_log_odds = std::clamp(tracked_log_odds + log_odds, kMinTracked, kMaxTracked);
}

void Track::addFit(double travel)
{
  const double now = unexplainedShare(evidence) + evidence.through_wall;
  const double fresh = misfit ? 1.0 - std::exp(-travel / kMisfitMemory) : 1.0;
  misfit = misfit.value_or(0) + fresh * (now - misfit.value_or(0));
}

void Track::inherit(const Track& parent)
{
  confirmed = std::max(confirmed, parent.confirmed);
  seen = parent.seen;
  tracked_log_odds = std::max(tracked_log_odds, parent.tracked_log_odds);
  seen_while_tracked = parent.seen_while_tracked;
  tracked_distance = parent.tracked_distance;
  explained = parent.explained;
}

double Track::inMapLogOdds() const
{
  const double fit = misfit ? kFitSlope * std::log(kNeutralMisfit / (*misfit + kMisfitFloor)) : 0.0;
  return confirmed + tracked_log_odds + fit;
}

double Track::missed() const
{
  if (relocations < kMinRelocations) return 0;
  const double found_share = static_cast<double>(times_found) / static_cast<double>(relocations);
  return std::clamp((kOftenFound - found_share) / (kOftenFound - kSeldomFound), 0.0, 1.0);
}

double Track::explainedCellsLogOdds(const ClaimContext& now) const
{
  const double share = explained.unexplainedShare();
  const double reliable =
      std::clamp((kMuchInScans - now.unexplained) / (kMuchInScans - kLittleInScans), 0.0, 1.0) *
      std::clamp((kMuchOfCells - share) / (kMuchOfCells - kLittleOfCells), 0.0, 1.0) *
      std::min(1.0, explained.seen() / static_cast<double>(kCellsOfView));
  // The pose was chosen because it explains the first scan. That it explains the rest shows only
  // as the robot drives on.
  const double most_for = kMostFor * std::min(1.0, tracked_distance / kFullWay);
  const double unexplained = share * std::min(now.range, kFarthest);
  return reliable * std::clamp(kUnexplainedSlope * (kNeutralUnexplained - unexplained),
                               -kMostAgainst, most_for);
}

double Track::claimLogOdds(const ClaimContext& now) const
{
  if (!misfit) return inMapLogOdds();
  const double reliable = std::clamp((kSurvivalMostMisfit - explained.unexplainedShare()) /
                                         (kSurvivalMostMisfit - kSurvivalFullMisfit),
                                     0.0, 1.0);
  const double survived =
      kSurvivalSlope * reliable *
      (std::clamp(tracked_distance, kSurvivalStart, kSurvivalEnd) - kSurvivalStart);
  const double contested = kRivalSlope * std::log(std::max(1.0, now.next / kNegligibleWeight)) +
                           kDeficitSlope * std::max(0.0, -deficit.smaller() - kUsualDeficit) +
                           kMissedPenalty * missed();
  return inMapLogOdds() + survived - contested + explainedCellsLogOdds(now);
}
}  // namespace sigloc
