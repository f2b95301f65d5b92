// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/chi_square.h"
#include "matching/features/PreparedScene.h"
#include "signature/binary_constraint.h"
#include "signature/pose_fit.h"

#include <memory>
#include <vector>

namespace sigloc
{
struct FeatureQuery;

/// The pairings that a hypothesis starts from, and the pose that they fix.
struct HypothesisBase
{
  std::vector<FeaturePairing> pairings;
  PoseEstimate pose;
};

/// For every observed feature, the map features that it may be: the lists L_q of the plain mode,
/// \cite algorithm eq. (4.1).
using CandidateLists = std::vector<std::vector<std::uint32_t>>;

/// Verifies pose hypotheses by features alone. A sequential Kalman filter pairs the observed
/// features, nearest to the base first. Pairings pass location-dependent gates, extension and joint
/// compatibility, and are one to one. Least squares, a recount with tight gates and log-odds
/// follow. \cite algorithm section 5
///
/// Const and thread-safe. Each FeatureQuery has what changes.
class FeatureVerifier
{
 public:
  FeatureVerifier(std::shared_ptr<const PreparedMap> map, const GeneratorOptions& options);

  /// Buffers reused from hypothesis to hypothesis.
  struct Workspace
  {
    HypothesisBase base;
    std::vector<FeaturePairing> pairings;
    std::vector<FeaturePairing> before;
    std::vector<DirectedPairing> fitted;
    struct Match
    {
      double squared_distance;
      FeaturePairing pairing;
    };
    std::vector<Match> matches;
  };

  /// Turns two pairings into the workspace's base with its pose. Returns false when they fix no
  /// pose. \cite algorithm eq. (5.1) to (5.4)
  bool makeBase(FeatureQuery& query, const FeaturePairing& first,
                const FeaturePairing& second) const;

  /// Verifies the workspace's base and adds the hypothesis that grows from it to what was found.
  /// With `lists` (the plain mode) partners come from there, and no base is given up early.
  /// Otherwise they come from the spatial hash near the predicted place, and a sequential test may
  /// give the base up. \cite algorithm eq. (5.5) to (5.11)
  void verify(FeatureQuery& query, const CandidateLists* lists = nullptr) const;

  /// Returns the map features that observed feature q may be at an estimated pose with covariance:
  /// all that pass the unary and the location-dependent gates. `relative_sigma` [m] is the map's
  /// own error over the distance in question. \cite algorithm eq. (3.1), (3.9) to (3.12)
  std::vector<Workspace::Match> compatibleAt(const PreparedScene& scene, std::uint32_t q,
                                             const PoseEstimate& pose, double relative_sigma) const;

  /// Upper bound of the summed normalised innovations of jointly compatible pairings.
  /// \cite algorithm eq. (5.6)
  double jointGate(int degrees) const { return chi_square_(degrees); }

  const PreparedMap& map() const { return *map_; }
  const GeneratorOptions& options() const { return options_; }
  const BinaryGates& gates() const { return gates_; }

 private:
  struct Filter;
  bool gatePairing(const PreparedScene& scene, std::uint32_t q, std::uint32_t p,
                   const PoseEstimate& pose, double relative_sigma, double& squared_distance) const;
  bool associate(FeatureQuery& query, const CandidateLists* lists, std::uint32_t needed,
                 Filter& filter) const;
  std::uint32_t bestCandidate(FeatureQuery& query, const CandidateLists* lists, std::uint32_t q,
                              const Filter& filter, double& squared_distance) const;
  template <class Visit>
  std::uint64_t visitCandidates(const PreparedScene& scene, std::uint32_t q,
                                const PoseEstimate& pose, double relative_sigma,
                                Visit&& visit) const;
  void recount(FeatureQuery& query, const PoseEstimate& pose) const;
  std::optional<PoseEstimate> fit(FeatureQuery& query, const PoseEstimate& start) const;
  double logOdds(FeatureQuery& query, const PoseEstimate& pose) const;

  std::shared_ptr<const PreparedMap> map_;
  GeneratorOptions options_;
  ChiSquareGates chi_square_;
  BinaryGates gates_;
};
}  // namespace sigloc
