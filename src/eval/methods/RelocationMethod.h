// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eval/data/evaluation_data.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
/// A method that finds a robot in a map from one scan, ours or an opponent's. It is made from map
/// data, then given raw scans: extracting features is part of its cost.
class RelocationMethod
{
 public:
  virtual ~RelocationMethod() = default;

  /// Returns ranked candidates, at most ten. Const and thread-safe; the result depends on the
  /// scans, the map and the seed only.
  virtual RelocationResult localize(const std::vector<LaserScan>& scans) const = 0;

  /// Returns all poses that the method considers one by one before ranking them. Returns nullopt
  /// for a method that searches instead of proposing.
  virtual std::optional<std::vector<mrpt::math::TPose2D>> propose(
      const std::vector<LaserScan>& /*scans*/) const
  {
    return std::nullopt;
  }

  /// True when verdict and probability mean something; a plain search never claims to be sure.
  virtual bool claimsVerdict() const { return false; }

  /// Look-ups in a likelihood field that one scored pose takes, 0 where that is not constant.
  virtual double lookupsPerPose() const { return 0; }
};

/// Options that a run gives to every method.
struct RelocationMethodOptions
{
  std::optional<PoseRegion> region;
  bool use_dense_field = true;  ///< for the signature methods
  std::uint32_t seed = 1;
  std::optional<std::uint32_t> particles;  ///< of the particle filters, instead of their own number
  std::optional<double> tempering;  ///< of `mcl-best`, instead of its own exponent
};

/// Names that `makeRelocationMethod` accepts, in the order of the documentation.
std::vector<std::string> relocationMethodNames();

/// Builds a method's own structures from the map data. Throws std::invalid_argument for an unknown
/// name, or when the map lacks what the method needs.
std::unique_ptr<RelocationMethod> makeRelocationMethod(const std::string& name,
                                                       const EvaluationMap& map,
                                                       const RelocationMethodOptions& options);

namespace detail
{
/// MRPT's particle filter after its first scan. Particles are drawn over the free cells of the
/// whole map and weighted by the one scan, as many as `mcl` or `mcl-tuned` starts with. Candidates
/// are the heaviest clusters. It claims nothing, since the filter's rule for that takes five steps.
/// Before the robot has moved KLD has nothing to adapt, so `mcl-fixed` would be `mcl` again.
/// Concurrent calls run one after another: MRPT's grid keeps likelihoods in a cache without a lock.
std::unique_ptr<RelocationMethod> makeMonteCarloRelocation(const std::string& name,
                                                           const EvaluationMap& map,
                                                           const RelocationMethodOptions& options);
}  // namespace detail
}  // namespace sigloc
