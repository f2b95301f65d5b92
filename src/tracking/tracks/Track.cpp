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
constexpr double kOfThings = 16.0;  // log-odds of a metre of unexplained share times range ...
constexpr double kUsualThings = 0.25;  // [m] ... beyond this, which the right one seldom exceeds,
constexpr double kMostAgainstThings = 4.0;
constexpr double kMostForThings = 1.5;
constexpr double kShownWay = 15.0;  // [m] driven, from which on they speak for it in full
constexpr double kFarthest = 8.0;  // [m]
constexpr double kLittleInScans = 0.15;  // share of whole scans left unexplained up to which all
constexpr double kMuchInScans = 0.25;  // of it, and from which on nothing is told
constexpr double kLittleOfGround = 0.25;  // the same for the share of the ground
constexpr double kMuchOfGround = 0.35;
constexpr double kMinFollowed = -8.0;
constexpr double kMaxFollowed = 12.0;
}  // namespace

void Track::addFollowed(double log_odds)
{
  followed = std::clamp(followed + log_odds, kMinFollowed, kMaxFollowed);
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
  followed = std::max(followed, parent.followed);
  on_the_way = parent.on_the_way;
  followed_way = parent.followed_way;
  explained = parent.explained;
}

double Track::presence() const
{
  const double fit = misfit ? kFitSlope * std::log(kUsualMisfit / (*misfit + kMisfitFloor)) : 0.0;
  return confirmed + followed + fit;
}

double Track::missed() const
{
  if (relocations < kFewRelocations) return 0;
  const double found_share = static_cast<double>(times_found) / static_cast<double>(relocations);
  return std::clamp((kOftenFound - found_share) / (kOftenFound - kSeldomFound), 0.0, 1.0);
}

double Track::thingsExplained(const Circumstances& now) const
{
  const double share = explained.unexplainedShare();
  const double telling =
      std::clamp((kMuchInScans - now.unexplained) / (kMuchInScans - kLittleInScans), 0.0, 1.0) *
      std::clamp((kMuchOfGround - share) / (kMuchOfGround - kLittleOfGround), 0.0, 1.0) *
      std::min(1.0, explained.seen() / static_cast<double>(kCellsOfView));
  // What was chosen for explaining the first look shows by and by that it explains the rest.
  const double most_for = kMostForThings * std::min(1.0, followed_way / kShownWay);
  const double things = share * std::min(now.range, kFarthest);
  return telling * std::clamp(kOfThings * (kUsualThings - things), -kMostAgainstThings, most_for);
}

double Track::standing(const Circumstances& now) const
{
  if (!misfit) return presence();
  const double told = std::clamp(
      (kMuchUnexplained - explained.unexplainedShare()) / (kMuchUnexplained - kLittleUnexplained),
      0.0, 1.0);
  const double survived =
      kSurvival * told * (std::clamp(followed_way, kUsualLife, kLongLife) - kUsualLife);
  const double contested = kOfRival * std::log(std::max(1.0, now.next / kNoRival)) +
                           kOfLoss * std::max(0.0, -behind.told() - kUsualLoss) +
                           kOfMissed * missed();
  return presence() + survived - contested + thingsExplained(now);
}
}  // namespace sigloc
