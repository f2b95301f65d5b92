// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/RelocalizationPolicy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sigloc
{
using mrpt::math::TPose2D;

const char* toString(PoseState state)
{
  switch (state)
  {
    case PoseState::searching:
      return "searching";
    case PoseState::confirming:
      return "confirming";
    case PoseState::known:
      return "known";
    case PoseState::holding:
      return "holding";
  }
  return "unknown";
}

RelocalizationPolicy::RelocalizationPolicy(const RelocalizationPolicyOptions& options)
    : options_(options)
{
  checkOptions(options_);
}

void RelocalizationPolicy::requestRestart()
{
  restart_wanted_ = true;
}

PolicyDecision RelocalizationPolicy::update(const PolicyStep& step)
{
  if (!std::isfinite(step.time) || step.time < time_.value_or(step.time))
  {
    throw std::invalid_argument("a step's time is no number, or before that of the last step");
  }
  if (!time_) search_began_ = step.time;
  time_ = step.time;
  if (pose_ && step.motion) pose_ = *pose_ + *step.motion;
  PolicyDecision decision;
  if (restart_wanted_)
  {
    searches_ = 0;
    announcements_ = 0;
    decision = restart("a search from nothing was asked for");
  }
  else
  {
    const bool localized =
        step.belief.verdict == Verdict::localized && !step.belief.hypotheses.empty();
    decision = localized ? whileLocalized(step) : whileNot(step);
  }
  decision.state = state_;
  return decision;
}

bool RelocalizationPolicy::agree(const TPose2D& a, const TPose2D& b) const
{
  const PoseError error = errorBetween(a, b);
  return error.distance <= options_.agree_distance && error.angle <= options_.agree_turn;
}

void RelocalizationPolicy::beginConfirming(const TPose2D& pose)
{
  pose_ = pose;
  state_ = PoseState::confirming;
  agreeing_steps_ = 0;
  agreeing_since_ = *time_;
}

/// One of the poses that explain the scan alone must be the tracked one.
bool RelocalizationPolicy::crossChecked(const PolicyStep& step) const
{
  if (!step.localize_alone) return true;
  const RelocationResult alone = step.localize_alone();
  return std::any_of(alone.candidates.begin(), alone.candidates.end(),
                     [this](const Candidate& candidate)
                     { return agree(candidate.pose.mean, *pose_); });
}

PolicyDecision RelocalizationPolicy::whileLocalized(const PolicyStep& step)
{
  const GaussianPose& pose = step.belief.hypotheses.front().pose;
  localized_at_ = *time_;
  const bool same = pose_ && agree(*pose_, pose.mean);
  const bool jumped = isInUse() && !same;
  if (!same) beginConfirming(pose.mean);
  pose_ = pose.mean;
  PolicyDecision decision;
  if (!isInUse())
  {
    if (jumped) search_began_ = *time_;
    ++agreeing_steps_;
    if (agreeing_steps_ < options_.confirm_steps ||
        *time_ - agreeing_since_ < options_.confirm_time)
    {
      return stillSearching(jumped ? "the pose jumped: confirming it again"
                                   : "confirming the pose");
    }
    if (!crossChecked(step))
    {
      beginConfirming(pose.mean);
      return stillSearching("the scan alone does not explain the pose: confirming it again");
    }
    searches_ = 1;
    announcements_ = 0;
    disagreeing_since_ = std::nullopt;
    // Announced at once, unless the filter has it already.
    decision.announce = !step.filter_pose || !agree(*step.filter_pose, pose.mean);
  }
  state_ = PoseState::known;
  decision.pose = pose;
  decision.message = step.belief.reason;
  watchFilter(step, decision);
  return decision;
}

void RelocalizationPolicy::watchFilter(const PolicyStep& step, PolicyDecision& decision)
{
  if (!decision.announce)
  {
    if (!step.filter_pose) return;
    if (agree(*step.filter_pose, *pose_))
    {
      announcements_ = 0;
      disagreeing_since_ = std::nullopt;
      return;
    }
    const bool settling = announcements_ > 0 && *time_ - announced_at_ < options_.settle_time;
    if (settling) return;
    if (!disagreeing_since_) disagreeing_since_ = time_;
    if (*time_ - *disagreeing_since_ < options_.disagree_time) return;
    if (announcements_ >= options_.max_attempts)
    {
      decision.alarm = true;
      decision.message = fmt::format(
          "given up: the filter does not take the pose, {} times announced", announcements_);
      return;
    }
    decision.announce = true;
    decision.message = "the filter is off the pose: announcing it again";
  }
  ++announcements_;
  announced_at_ = *time_;
  disagreeing_since_ = std::nullopt;
}

PolicyDecision RelocalizationPolicy::whileNot(const PolicyStep& step)
{
  const std::string& reason = step.belief.reason;
  if (isInUse() && *time_ - localized_at_ < options_.lost_time)
  {
    state_ = PoseState::holding;
    PolicyDecision decision;
    decision.message = "not localized at the moment: " + reason;
    return decision;
  }
  const bool lost = isInUse();
  state_ = PoseState::searching;
  pose_ = std::nullopt;
  if (!lost) return stillSearching(reason);
  search_began_ = *time_;
  return stillSearching("lost: " + reason);
}

/// A search that takes too long begins again, or is given up.
PolicyDecision RelocalizationPolicy::stillSearching(std::string message)
{
  PolicyDecision decision;
  decision.message = std::move(message);
  if (*time_ - search_began_ < options_.attempt_time) return decision;
  if (searches_ < options_.max_attempts) return restart("searching again from nothing");
  decision.alarm = true;
  decision.message =
      fmt::format("given up after searching {} times: {}", searches_, decision.message);
  return decision;
}

PolicyDecision RelocalizationPolicy::restart(std::string message)
{
  restart_wanted_ = false;
  state_ = PoseState::searching;
  pose_ = std::nullopt;
  search_began_ = *time_;
  ++searches_;
  PolicyDecision decision;
  decision.restart = true;
  decision.message = std::move(message);
  return decision;
}
}  // namespace sigloc
