// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/Track.h"

#include <algorithm>
#include <cmath>

#include "geometry/pose_fusion.h"

namespace sigloc
{
namespace
{
// In the map or not, eq. (8.22): a logistic regression by scripts/fit_evidence.
constexpr double kOffset = -1.40;  // log-odds without the prior
constexpr double kRelocationSlope = 0.92;  // per unit of kappa
constexpr double kWaySlope = 0.0145;  // per unit of gamma squared
constexpr double kUnexplainedSlope = 3.9;  // per unexplained share of the mapped area seen
constexpr double kFollowedSlope = 4.5;  // for kFullWay followed, explained or found
constexpr double kFullWay = 20.0;  // [m]
constexpr double kSearchedSlope = 1.9;  // for kFullWay driven unlocalized before
constexpr double kMostUnexplained = 0.2;  // from which the way counts as far as it is found
constexpr double kMaxTracked = 16.0;  // bound of gamma
constexpr double kFound =
    4.6;  // kappa from which relocations are sure, ln 99 whatever a claim takes
constexpr double kPriorHere = 0.6;  // log-odds of being in the map, of a robot that is tracked

// The same in a map of landmarks, eq. (8.23), by the same script.
constexpr double kFeatureOffset = -3.87;  // log-odds, a prior of 1.6 within
constexpr double kPairingSlope = 0.85;  // per unit of kappa
}  // namespace

void Track::addTrackedLogOdds(double log_odds)
{
  tracked_log_odds = std::clamp(tracked_log_odds + log_odds, kMinInMap, kMaxTracked);
}

void Track::absorb(const Track& lighter)
{
  const TrackedHypothesis& other = lighter.hypothesis;
  hypothesis.pose = mergeByMoments(hypothesis.pose, hypothesis.weight, other.pose, other.weight);
  hypothesis.weight += other.weight;
  hypothesis.id = std::min(hypothesis.id, other.id);
  hypothesis.age = std::max(hypothesis.age, other.age);
  confirmed = std::max(confirmed, lighter.confirmed);
  tracked_log_odds = std::max(tracked_log_odds, lighter.tracked_log_odds);
  tracked_distance = std::max(tracked_distance, lighter.tracked_distance);
  searched_distance = std::min(searched_distance, lighter.searched_distance);
  found = found || lighter.found;
}

void Track::inherit(const Track& parent)
{
  confirmed = std::max(confirmed, parent.confirmed);
  seen_at_relocations = parent.seen_at_relocations;
  tracked_log_odds = std::max(tracked_log_odds, parent.tracked_log_odds);
  seen_while_tracked = parent.seen_while_tracked;
  tracked_distance = parent.tracked_distance;
  searched_distance = parent.searched_distance;
  explained = parent.explained;
}

double Track::inMapLogOdds() const
{
  if (!in_field) return kFeatureOffset + kPairingSlope * confirmed;
  const double unexplained = explained.offWallShare();
  const double way = std::min(1.0, tracked_distance / kFullWay);
  const double searched = std::min(1.0, searched_distance / kFullWay);
  const double fit = std::max(0.0, 1.0 - unexplained / kMostUnexplained);
  // Clutter leaves much unexplained at the right pose, too, but relocations find it.
  const double backed = fit + (1.0 - fit) * std::min(1.0, confirmed / kFound);
  return kPriorHere + kOffset + kRelocationSlope * confirmed +
         kWaySlope * tracked_log_odds * std::abs(tracked_log_odds) -
         kUnexplainedSlope * unexplained + kFollowedSlope * way * backed -
         kSearchedSlope * searched;
}
}  // namespace sigloc
