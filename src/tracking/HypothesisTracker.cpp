// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/tracking/HypothesisTracker.h"

namespace sigloc
{
struct HypothesisTracker::State
{
  Belief belief;
};
HypothesisTracker::HypothesisTracker(std::shared_ptr<const SignatureMatcher>, const TrackerOptions&)
    : state_(std::make_unique<State>())
{
}
HypothesisTracker::~HypothesisTracker() = default;
const Belief& HypothesisTracker::step(const std::optional<MotionIncrement>&, const ObservedScene&)
{
  return state_->belief;
}
const Belief& HypothesisTracker::belief() const
{
  return state_->belief;
}
bool HypothesisTracker::relocated() const
{
  return false;
}
void HypothesisTracker::reset(const std::optional<PoseRegion>&) {}
}  // namespace sigloc
