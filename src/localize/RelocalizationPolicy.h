// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "sigloc/config/option_fields.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/matching/RelocationResult.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
/// When a robot's pose is given out. Units, ranges and meanings are in `visitFields`.
struct RelocalizationPolicyOptions
{
  std::uint32_t confirm_steps = 3;
  double confirm_time = 1.0;
  double agree_distance = 0.5;
  double agree_turn = 0.2;
  double lost_time = 2.0;
  double disagree_time = 2.0;
  double settle_time = 3.0;
  double attempt_time = 60.0;
  std::uint32_t max_attempts = 3;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = RelocalizationPolicyOptions;
    constexpr double kHour = 3600;
    visit(OptionField{
        "confirm_steps", &O::confirm_steps, 1U, 1000U,
        "[-] steps in a row that must be localized at one pose before it is given out"});
    visit(OptionField{"confirm_time", &O::confirm_time, 0.0, kHour,
                      "[s] time that these steps must span at least"});
    visit(OptionField{"agree_distance", &O::agree_distance, 0.01, 100.0,
                      "[m] poses this close may be the same"});
    visit(
        OptionField{"agree_turn", &O::agree_turn, 0.01, 3.2, "[rad] and with headings this close"});
    visit(OptionField{"lost_time", &O::lost_time, 0.0, kHour,
                      "[s] without a localized step after which the robot is lost"});
    visit(OptionField{"disagree_time", &O::disagree_time, 0.0, kHour,
                      "[s] the user's filter may be off our pose before it is set again"});
    visit(OptionField{"settle_time", &O::settle_time, 0.0, kHour,
                      "[s] the user's filter is given to take over a pose"});
    visit(OptionField{"attempt_time", &O::attempt_time, 0.1, kHour,
                      "[s] a search may take before it starts again from nothing"});
    visit(OptionField{"max_attempts", &O::max_attempts, 1U, 1000U,
                      "[-] searches, or times that the filter is set, before giving up"});
  }
};

/// What is known about the robot's pose, for those who use it.
enum class PoseState : std::uint8_t
{
  searching,  ///< not known yet, or again
  confirming,  ///< localized, but not for long enough to be used
  known,  ///< localized and confirmed
  holding,  ///< was known a moment ago, and is not localized now
};

/// Returns "searching", "confirming", "known" or "holding".
const char* toString(PoseState state);

/// One step of the robot, for the policy.
struct PolicyStep
{
  double time = 0;  ///< [s], not earlier than that of the step before
  Belief belief;  ///< of the tracker after the step
  std::optional<mrpt::math::TPose2D> motion;  ///< since the step before; none where unknown
  /// Where the robot is according to the filter that poses are given to. None where there is none.
  std::optional<mrpt::math::TPose2D> filter_pose;
  /// Answers what the step's scan alone tells, for the cross-check. It is called where that is
  /// needed, and at most once.
  std::function<RelocationResult()> localize_alone;
};

/// What is to be done after a step.
struct PolicyDecision
{
  PoseState state = PoseState::searching;
  std::optional<GaussianPose> pose;  ///< only where the state is `known`: it may be used
  bool announce = false;  ///< give `pose` to the filter now
  bool restart = false;  ///< search from nothing: HypothesisTracker::reset()
  bool alarm = false;  ///< given up: a person must look
  std::string message;  ///< one line for people
};

/// Decides what of a tracker's beliefs leaves it. It knows no middleware.
///
/// * A pose is given out only while the belief is *localized*. It must have been so for
///   `confirm_steps` and `confirm_time`, at one pose carried along by odometry.
/// * It is cross-checked by the scan alone, which knows nothing of the steps before: one of the
///   poses that explain it must be this one. After a failed check confirming starts again.
/// * A robot is lost after `lost_time` without a localized step. Nothing is given out meanwhile.
///   One whose pose jumps must be confirmed again.
/// * The pose is announced when it becomes known, and again where the user's filter stays away from
///   it for `disagree_time`.
/// * After `attempt_time` a search starts again from nothing. After `max_attempts` searches, or
///   announcements that the filter does not take, it is given up: every decision has the alarm
///   until the pose is known and the filter agrees.
///
/// The result depends on the steps and options alone. Not thread-safe.
class RelocalizationPolicy
{
 public:
  /// Throws std::invalid_argument for options outside their ranges.
  explicit RelocalizationPolicy(const RelocalizationPolicyOptions& options = {});

  /// Throws std::invalid_argument for a time that is no number or before that of the last step.
  PolicyDecision update(const PolicyStep& step);

  /// A person asks for a search from nothing. The next decision says so, and attempts count anew.
  void requestRestart();

 private:
  bool agree(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) const;
  bool isInUse() const { return state_ == PoseState::known || state_ == PoseState::holding; }
  void beginConfirming(const mrpt::math::TPose2D& pose);
  bool crossChecked(const PolicyStep& step) const;
  PolicyDecision whileLocalized(const PolicyStep& step);
  PolicyDecision whileNot(const PolicyStep& step);
  PolicyDecision stillSearching(std::string message);
  PolicyDecision restart(std::string message);
  void watchFilter(const PolicyStep& step, PolicyDecision& decision);

  RelocalizationPolicyOptions options_;
  PoseState state_ = PoseState::searching;
  std::optional<double> time_;  // [s] of the last step, as all times here
  double search_began_ = 0;
  std::uint32_t searches_ = 1;
  bool restart_wanted_ = false;

  std::optional<mrpt::math::TPose2D> pose_;  // being confirmed or in use, carried along by odometry
  std::uint32_t agreeing_steps_ = 0;
  double agreeing_since_ = 0;
  double localized_at_ = 0;

  std::uint32_t announcements_ = 0;  // since the filter last agreed
  double announced_at_ = 0;
  std::optional<double> disagreeing_since_;
};
}  // namespace sigloc
