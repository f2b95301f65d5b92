// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// Tracks every pose hypothesis until one is left. Each step predicts by odometry, updates poses
/// and weights by the scan, relocates where there is reason to, merges and prunes.
/// \cite algorithm section 8
///
///     HypothesisTracker tracker(matcher);
///     while (auto step = log.next())
///       if (tracker.step(step->motion, observe(*step)).verdict == Verdict::localized)
///       ...
///
/// Deterministic. Not thread-safe: use one tracker for each robot. All budgets are operation
/// counts.
class HypothesisTracker
{
 public:
  /// Throws std::invalid_argument for a null matcher or options outside their ranges.
  explicit HypothesisTracker(std::shared_ptr<const SignatureMatcher> matcher,
                             const TrackerOptions& options = {});
  ~HypothesisTracker();
  HypothesisTracker(HypothesisTracker&&) noexcept;
  HypothesisTracker& operator=(HypothesisTracker&&) noexcept;

  /// Advances by one step and returns the belief after it. Without a motion a wide prior is used.
  /// The motion of the first step does not matter.
  /// Throws std::invalid_argument for a motion with a value that is not finite or a negative
  /// variance, and for a scene that SignatureMatcher::localize() refuses. The belief then stays as
  /// it was.
  const Belief& step(const std::optional<MotionIncrement>& motion, const ObservedScene& scene);

  const Belief& belief() const;
  /// What speaks for the first hypothesis being in the map; all 0 without one.
  InMapEvidence evidence() const;
  /// True when the last step ran a relocation.
  bool relocated() const;

  /// Forgets everything. The robot may then be anywhere or, with a region, inside it.
  void reset(const std::optional<PoseRegion>& region = std::nullopt);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace sigloc
