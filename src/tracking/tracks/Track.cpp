// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/Track.h"

#include <cmath>

#include "matching/candidate_probabilities.h"

namespace sigloc
{
namespace
{
constexpr double kMisfitMemory = 3.0;  // [m] of travel
constexpr double kMisfitFloor = 0.03;  // share that even the right pose leaves unexplained
constexpr double kUsualMisfit = 0.068;  // with its floor, of a pose that may be right or foreign
constexpr double kFitSlope = 1.04;
constexpr double kSurvival = 0.65;  // log-odds of a metre that a track has survived ...
constexpr double kUsualLife = 10.0;  // [m] ... beyond what a wrong one often lasts, too,
constexpr double kLongLife = 20.0;  // [m] up to here,
constexpr double kMuchUnexplained = 0.2;  // none where as much of the ground was unexplained,
constexpr double kLittleUnexplained = 0.15;  // all from here on
constexpr double kOfRival = 0.6;  // of the log-odds of a rival ...
constexpr double kNoRival = 1e-4;  // ... against one of this weight
constexpr double kOfLoss = 0.2;  // of what was lost to rivals ...
constexpr double kUsualLoss = 4.0;  // ... beyond what the right one loses, too
constexpr double kOfMissed = 2.0;  // log-odds where relocations find other places instead,
constexpr std::size_t kFewRelocations = 4;
constexpr double kOftenFound = 0.5;  // share of them from which on nothing,
constexpr double kSeldomFound = 0.3;  // up to which all is taken
constexpr double kOfUnexplained = 16.0;  // log-odds of a metre of unexplained share times range ...
constexpr double kUsualUnexplained =
    0.25;  // [m] ... beyond this, which the right one seldom exceeds,
constexpr double kMostAgainst = 4.0;
constexpr double kMostFor = 1.5;
constexpr double kShownWay = 15.0;  // [m] driven, from which on they speak for it in full
constexpr double kFarthest = 8.0;  // [m]
constexpr double kLittleInScans = 0.15;  // share of whole scans left unexplained up to which all
constexpr double kMuchInScans = 0.25;  // of it, and from which on nothing is told
constexpr double kLittleOfCells = 0.25;  // the same for the share of the ground
constexpr double kMuchOfCells = 0.35;
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
  const double fit = misfit ? kFitSlope * std::log(kUsualMisfit / (*misfit + kMisfitFloor)) : 0.0;
  return confirmed + tracked_log_odds + fit;
}

double Track::missed() const
{
  if (relocations < kFewRelocations) return 0;
  const double found_share = static_cast<double>(times_found) / static_cast<double>(relocations);
  return std::clamp((kOftenFound - found_share) / (kOftenFound - kSeldomFound), 0.0, 1.0);
}

double Track::explainedCellsLogOdds(const ClaimContext& now) const
{
  const double share = explained.unexplainedShare();
  const double telling =
      std::clamp((kMuchInScans - now.unexplained) / (kMuchInScans - kLittleInScans), 0.0, 1.0) *
      std::clamp((kMuchOfCells - share) / (kMuchOfCells - kLittleOfCells), 0.0, 1.0) *
      std::min(1.0, explained.seen() / static_cast<double>(kCellsOfView));
  // What was chosen for explaining the first addScan shows by and by that it explains the rest.
  const double most_for = kMostFor * std::min(1.0, tracked_distance / kShownWay);
  const double things = share * std::min(now.range, kFarthest);
  return telling *
         std::clamp(kOfUnexplained * (kUsualUnexplained - things), -kMostAgainst, most_for);
}

double Track::claimLogOdds(const ClaimContext& now) const
{
  if (!misfit) return inMapLogOdds();
  const double told = std::clamp(
      (kMuchUnexplained - explained.unexplainedShare()) / (kMuchUnexplained - kLittleUnexplained),
      0.0, 1.0);
  const double survived =
      kSurvival * told * (std::clamp(tracked_distance, kUsualLife, kLongLife) - kUsualLife);
  const double contested = kOfRival * std::log(std::max(1.0, now.next / kNoRival)) +
                           kOfLoss * std::max(0.0, -deficit.smaller() - kUsualLoss) +
                           kOfMissed * missed();
  return inMapLogOdds() + survived - contested + explainedCellsLogOdds(now);
}
}  // namespace sigloc
