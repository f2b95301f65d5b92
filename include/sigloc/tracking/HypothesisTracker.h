// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "sigloc/config/option_fields.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/Belief.h"

namespace sigloc
{
struct TrackerOptions
{
  std::uint32_t max_hypotheses = 20;
  double localized_probability = 0.99;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = TrackerOptions;
    visit(OptionField{"max_hypotheses", &O::max_hypotheses, 1U, 1000U,
                      "[-] how many hypotheses are followed at most"});
    visit(OptionField{"localized_probability", &O::localized_probability, 0.5, 1.0,
                      "[-] the verdict is localized from this probability on"});
  }
};

/// Follows every pose hypothesis until one is left: predict with the odometry, update by the
/// matcher's verification at each pose, prune, merge, respawn. \cite algorithm section 5
///
/// Deterministic; not thread-safe (one tracker a robot); all budgets are operation counts.
class HypothesisTracker
{
 public:
  explicit HypothesisTracker(std::shared_ptr<const SignatureMatcher> matcher,
                             const TrackerOptions& options = {});
  ~HypothesisTracker();

  /// Advances by one step and returns the belief after it. Without a motion a wide prior is used.
  const Belief& step(const std::optional<MotionIncrement>& motion, const ObservedScene& scene);

  const Belief& belief() const;
  /// True when the last step ran a relocation.
  bool relocated() const;

  /// Forgets everything: lost anywhere, or inside a region.
  void reset(const std::optional<PoseRegion>& region = std::nullopt);

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace sigloc
