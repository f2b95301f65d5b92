// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "matching/dense/DenseEvidence.h"
#include "matching/dense/DenseScan.h"
#include "matching/dense/likelihood_table.h"
#include "sigloc/map/DenseField.h"
#include "sigloc/matching/RelocationResult.h"

namespace sigloc
{
struct CoarseScore;
class CoarseField;
class DistinctPoses;
class WallCrossings;

/// Scores and refines poses in the dense field. It never searches: every pose comes from a proposal
/// and is refined in a few stages, by at most 0.5 m and 10 degrees each. Const and thread-safe.
/// \cite algorithm section 6
class DenseVerifier
{
 public:
  /// A pose may still win, or be the best rival, if it scores less than this below the best.
  static constexpr double kContender = 0.2;

  /// Distinct poses that are listed; more only where their scores tie.
  static constexpr std::size_t kUsuallyRanked = 10;

  /// Keeps a reference to the field, which must outlive the verifier. `wall_blur` [m] is how far
  /// the field's ridges lie from the walls. Throws std::invalid_argument for a field without cells.
  explicit DenseVerifier(const DenseField& field, double wall_blur = 0);
  ~DenseVerifier();

  /// Returns at most `max_ranked` distinct poses (more than 0.5 m or 17 degrees apart), best first;
  /// more than ten only where they tie with the first.
  /// Counts the poses scored, and a search cut short where more than 400 places fit nearly as well
  /// as the best: the others are not refined. Poses ranked `before` for the same
  /// scan compete with those from the proposals, which are dropped where they end at one of these.
  /// \cite algorithm section 6, "The cascade"
  std::vector<RankedPose> rank(const DenseScan& scan, const std::vector<PoseProposal>& proposals,
                               std::size_t max_ranked, MatchingCounters& counters,
                               std::vector<RankedPose> before = {}) const;

  /// Returns the pose refined by up to `steps` Gauss-Newton steps on the first `beams` returns. It
  /// is the start where the refinement ends more than 0.5 m or 10 degrees away from it.
  /// \cite algorithm eq. (6.4) to (6.7)
  mrpt::math::TPose2D refine(const DenseScan& scan, const mrpt::math::TPose2D& start, int steps,
                             std::size_t beams) const;

  /// Returns the full evidence for a pose. \cite algorithm eq. (6.8)
  DenseEvidence evaluate(const DenseScan& scan, const mrpt::math::TPose2D& pose) const;

  /// Returns the same without beams through walls, which only lower a score. `testRays` adds them.
  DenseEvidence evaluateEnds(const DenseScan& scan, const mrpt::math::TPose2D& pose) const;
  void testRays(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                DenseEvidence& evidence) const;

  /// Returns which of the first 64 beams pass through walls, as DenseEvidence::through does.
  std::uint64_t beamsThroughWalls(const DenseScan& scan, const mrpt::math::TPose2D& pose) const;

  /// Returns how far the map explains each return of the scan, as the score (6.8) does. A narrower
  /// likelihood is added. `through` tells of the first 64 beams which pass through walls there.
  /// \cite algorithm section 8, "Weigh"
  std::vector<ExplainedReturn> explainedReturns(const DenseScan& scan,
                                                const mrpt::math::TPose2D& pose,
                                                std::uint64_t through) const;

  /// Returns the 3x3 covariance of a refined pose [m^2, m rad, rad^2], from the tempered
  /// information of the returns, with a sigma of 0.05 m each. It leaves out the map's own error.
  /// \cite algorithm eq. (6.9)
  mrpt::math::CMatrixDouble33 covarianceAt(const DenseScan& scan,
                                           const mrpt::math::TPose2D& pose) const;

  /// Returns the same covariance, but wider in the least certain direction where a move that way
  /// does not make the fit worse. \cite algorithm eq. (6.13)
  mrpt::math::CMatrixDouble33 testedCovarianceAt(const DenseScan& scan,
                                                 const mrpt::math::TPose2D& pose) const;

  const DenseField& field() const { return field_; }

 private:
  /// A pose refined in the race. Its score is an upper bound until its rays are tested.
  struct Raced
  {
    RankedPose ranked;
    bool rays_tested;
  };
  std::vector<Raced> race(const DenseScan& scan, const std::vector<PoseProposal>& proposals,
                          const std::vector<CoarseScore>& scores,
                          const std::vector<RankedPose>& before, MatchingCounters& counters) const;
  std::vector<RankedPose> bestOf(const DenseScan& scan, std::vector<Raced> raced, std::size_t rays,
                                 DistinctPoses distinct) const;
  void refineAll(const DenseScan& scan, std::vector<mrpt::math::TPose2D>& poses, int steps,
                 std::size_t beams, float least = 0, float* most_weight = nullptr) const;
  DenseEvidence evaluate(const DenseScan& scan, const mrpt::math::TPose2D& pose,
                         std::size_t returns, std::size_t rays) const;
  void testRays(const DenseScan& scan, const mrpt::math::TPose2D& pose, std::size_t rays,
                DenseEvidence& evidence) const;
  void testRays(const DenseScan& scan, std::size_t rays, Raced& raced) const;
  double fineLikelihood(const DenseScan& scan, const mrpt::math::TPose2D& pose) const;

  const DenseField& field_;
  const SharpTable sharp_;
  std::unique_ptr<const CoarseField> coarse_field_;
  std::unique_ptr<const CoarseField> rough_field_;  // where proposals are very many
  std::unique_ptr<const WallCrossings> wall_crossings_;
};
}  // namespace sigloc
