// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "matching/features/FeatureVerifier.h"
#include "sigloc/geometry/GaussianPose.h"
#include "tracking/tracks/SchmidtKalmanFilter.h"

namespace sigloc
{
/// What the log-odds of features count for tracks: looks at the same features share their errors.
constexpr double kFeatureTempering = 0.25;

/// One jointly compatible way of pairing what is seen with the map, and the pose that follows.
struct FeatureAssociation
{
  PoseEstimate pose;
  SchmidtKalmanFilter correlation;
  std::vector<FeaturePairing> pairings;
  double log_odds = 0;  // against "all clutter", eq. (8.14)
  double fresh_share = 0;  // of the pairings, those with features not seen on the last stretch
  double share = 1;  // of the parent's weight; all alternatives sum to one
};

/// Pairs the features of one step with the map at one predicted pose after another: nearest
/// compatible first, an EKF update after each, joint compatibility in one addition a pairing.
/// \cite algorithm section 8, "By features alone"
class FeatureAssociator
{
 public:
  /// Refers to the verifier and the features, which must outlive it. `travelled` [m] counts from
  /// any start and never falls.
  FeatureAssociator(const FeatureVerifier& verifier, const std::vector<Feature>& observed,
                    double travelled);

  /// Returns the ways of pairing that hold a share worth following, at poses that can be told
  /// apart, best first; one where nothing is ambiguous. Never empty. Eq. (8.15)
  std::vector<FeatureAssociation> associate(const GaussianPose& predicted,
                                            const SchmidtKalmanFilter& correlation) const;

  std::size_t size() const { return scene_.size(); }

 private:
  struct Growing;
  struct Option;
  double relativeSigma(std::uint32_t q) const;
  bool tryPairing(const FeaturePairing& pairing, Growing& growing) const;
  void grow(Growing& growing) const;
  FeatureAssociation finished(const Growing& growing) const;
  std::vector<Option> optionsAt(const PoseEstimate& predicted) const;
  std::vector<FeatureAssociation> grownFromBases(const Growing& start,
                                                 const std::vector<Option>& options) const;

  const FeatureVerifier& verifier_;
  PreparedScene scene_;
  std::vector<std::uint32_t> order_;  // nearest to the robot first, derived features last
  double travelled_;
};
}  // namespace sigloc
