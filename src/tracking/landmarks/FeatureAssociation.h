// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "matching/features/FeatureVerifier.h"
#include "sigloc/geometry/GaussianPose.h"
#include "tracking/landmarks/FeatureSpacing.h"
#include "tracking/tracks/SchmidtKalmanFilter.h"

namespace sigloc
{
/// Factor tau of the log-odds of features, because scans of the same features share their errors.
/// \cite algorithm eq. (8.15) to (8.18)
constexpr double kFeatureTempering = 0.25;

/// One jointly compatible way of pairing the observed features with the map, and its pose.
struct FeatureAssociation
{
  PoseEstimate pose;
  SchmidtKalmanFilter correlation;
  std::vector<FeaturePairing> pairings;
  double log_odds = 0;  // against "all clutter", eq. (8.14)
  double new_feature_share = 0;  // of the pairings: with features not paired within the last 10 m
  double share = 1;  // of the parent's weight; all alternatives sum to one
};

/// Pairs the features of one step with the map, at one predicted pose after another. Each feature
/// takes its nearest compatible partner, and an EKF update follows each pairing. Joint
/// compatibility costs one addition a pairing. \cite algorithm section 10
class FeatureAssociator
{
 public:
  /// Keeps references to the verifier, the spacing of its map and the features, which must outlive
  /// it. `travelled` [m] counts from any start and never falls.
  FeatureAssociator(const FeatureVerifier& verifier, const FeatureSpacing& spacing,
                    const std::vector<Feature>& observed, double travelled);

  /// Returns the ways of pairing at distinct poses, best first. Never empty; one way where nothing
  /// is ambiguous. Eq. (8.15)
  std::vector<FeatureAssociation> associate(const GaussianPose& predicted,
                                            const SchmidtKalmanFilter& correlation) const;

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
  const FeatureSpacing& spacing_;
  PreparedScene scene_;
  std::vector<std::uint32_t> order_;  // nearest to the robot first, derived features last
  double travelled_;
};
}  // namespace sigloc
