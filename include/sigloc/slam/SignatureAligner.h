// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CMetricMapsAlignmentAlgorithm.h>

#include <memory>
#include <optional>

#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// Aligns a local map with a map by their signatures, from no initial guess, behind the interface
/// of MRPT's `CICP` and `CGridMapAligner`:
///
///     SignatureAligner aligner;
///     CMetricMapsAlignmentAlgorithm& algorithm = aligner;
///     const auto pdf = algorithm.AlignPDF(&map, &local_view, {});   // a CPosePDFSOG
///
/// * m1, the map: a `SignatureMap` or a `COccupancyGridMap2D`, by itself or inside a
///   `CMultiMetricMap` (the first kind is preferred). The features of a grid map are found anew at
///   each call.
/// * m2, the robot's observation around the origin of its own frame: a points map, such as one made
///   from a scan, or a `SignatureMap`, by itself or inside a `CMultiMetricMap`.
///
/// Anything else throws std::invalid_argument. Not thread-safe.
class SignatureAligner : public mrpt::slam::CMetricMapsAlignmentAlgorithm
{
 public:
  /// What an alignment returns besides the poses: pass one as the last argument.
  struct TReturnInfo : public mrpt::slam::TMetricMapAlignmentResult
  {
    RelocationResult relocation;
  };

  /// How far from the mean of the initial estimate poses are considered.
  struct SearchLimits
  {
    double distance = 0;  ///< [m], in x and in y
    double turn = 0;  ///< [rad]
  };

  /// Throws std::invalid_argument for options outside their ranges.
  explicit SignatureAligner(const MatcherOptions& options = {});

  /// None: all of m1 is considered, and the initial estimate does not matter.
  std::optional<SearchLimits> search_limits;

  /// Returns every pose of m2 in m1 that is possible as a `CPosePDFSOG`, with weights and
  /// covariances, heaviest first; a sum without modes when there is none. The verdict in
  /// `TReturnInfo` says whether the first one can be trusted.
  mrpt::poses::CPosePDF::Ptr AlignPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPosePDFGaussian& initial_estimate,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> out_info = std::nullopt) override;

  /// The same in the plane of a 3D world, as a `CPose3DPDFSOG`.
  mrpt::poses::CPose3DPDF::Ptr Align3DPDF(
      const mrpt::maps::CMetricMap* m1, const mrpt::maps::CMetricMap* m2,
      const mrpt::poses::CPose3DPDFGaussian& initial_estimate,
      mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> out_info = std::nullopt) override;

 private:
  const SignatureMatcher& matcherFor(const mrpt::maps::CMetricMap* m1);

  MatcherOptions options_;
  std::shared_ptr<const SignatureMatcher> matcher_;  // of the last map
};
}  // namespace sigloc
