// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sigloc/tracking/TrackerOptions.h"
#include "tracking/tracks/TrackSet.h"
#include "tracking/tracks/travel.h"

namespace sigloc
{
/// The way driven, and when the next relocation is due. \cite algorithm section 8, "Relocate"
class RelocationSchedule
{
 public:
  explicit RelocationSchedule(const TrackerOptions& options) : options_(options) {}

  /// Counts the travel of a step, turns included.
  void countTravel(const Travel& travel);
  /// Counts the distance of a step that was driven unlocalized.
  void countSearched(const Travel& travel) { searched_ += travel.distance; }
  /// Notes whether the last step ended *localized*, which ends the search.
  void noteVerdict(bool localized);

  /// True at the start and on suspicion. Else relocations come at a steady rate, and at a lower one
  /// while the robot is localized.
  bool isDue(bool suspicious) const;
  /// Notes that the pose is known from elsewhere, as if by a relocation.
  void noteKnownStart();
  /// Notes a relocation. Returns whether it has given an answer. One that ended at its budget with
  /// nothing found has not, but the next one waits as if it had, because it would cost as much.
  bool noteResult(const RelocationResult& result);
  /// How much a relocation counts as new evidence, in [0, 1]: phi of section 8.
  double freshShare() const;

  /// True until a relocation has given an answer.
  bool isWakingUp() const { return waking_up_; }
  /// True once a relocation that gave an answer has searched the map to its end.
  bool hasSearchedAll() const { return searched_all_; }
  /// [m] in all.
  double travelled() const { return travelled_; }
  /// [m] driven since the robot was last localized, or since the start.
  double searched() const { return searched_; }

 private:
  TrackerOptions options_;
  bool waking_up_ = true;
  bool searched_all_ = false;
  bool waits_ = false;  // the last relocation ended at its budget with nothing found
  bool localized_ = false;  // at the last step
  double since_relocation_ = 0;  // [m]
  double travelled_ = 0;
  double searched_ = 0;
};
}  // namespace sigloc
