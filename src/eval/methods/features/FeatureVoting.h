// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sigloc/map/FeatureMap.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
struct FeatureVotingOptions
{
  double cell = 0.25;  ///< [m]
  std::uint32_t headings = 72;  ///< bins over the full turn: 5 degrees
  double size_tolerance = 0.3;  ///< [m] or, for a corner's opening, [rad]
  std::uint32_t max_candidates = 10;
  std::optional<PoseRegion> region;
};

/// Relocation by voting. Every pairing of an observed with a mapped feature of its kind votes for
/// the poses it allows, on a grid of positions and headings. The neighbourhoods with the most votes
/// win. The cost is linear in the number of observed and of mapped features; the grid limits the
/// accuracy. After \cite Paz, Pinies, Tardos, Neira, "Large-scale 6-DOF SLAM with stereo-in-hand"
/// and "bilinear time" voting; no binary constraints, no refinement.
class FeatureVoting
{
 public:
  /// Keeps a reference to the map. Throws std::invalid_argument for a map without features.
  FeatureVoting(const FeatureMap& map, const FeatureVotingOptions& options);

  struct Result
  {
    std::vector<Candidate> candidates;  ///< score: votes in the 3 x 3 cells around the position
    std::uint64_t votes = 0;
  };
  Result vote(const std::vector<Feature>& observed) const;

 private:
  struct Votes;
  struct Pairing;
  struct Pairings;

  Pairings pair(const std::vector<Feature>& observed) const;
  double headingOf(std::uint32_t bin) const;
  bool unaryCompatible(const Feature& observed, std::size_t mapped) const;
  void voteForPlaces(const Feature& observed, std::size_t mapped, double heading,
                     Votes& votes) const;
  void collectPeaks(const Votes& votes, double heading, std::vector<Candidate>& peaks) const;

  const FeatureMap& map_;
  FeatureVotingOptions options_;
  mrpt::math::TPoint2D low_;  // corner of the grid of positions
  std::int32_t columns_ = 0;
  std::int32_t rows_ = 0;
  std::vector<double> wall_length_;  // of a segment's linked line; 0 for other features
};
}  // namespace sigloc
