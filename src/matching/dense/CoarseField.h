// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/ByteRaster.h"
#include "matching/dense/DenseEvidence.h"
#include "matching/dense/DenseScan.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// Returns a raster over the same area with cells of about `cell` [m]: a whole number of fine
/// cells.
RasterFrame coarserFrame(const RasterFrame& fine, double cell);

/// The coarse score of a proposal.
struct CoarseScore
{
  static constexpr std::size_t kReturns = 24;  ///< first returns that score
  static constexpr std::uint32_t kMost = 255 * kReturns;  ///< the largest score
  std::uint32_t score;  ///< sum of the likelihood bytes at the first returns
  std::uint32_t index;  ///< of the proposal
};

/// The coarse likelihood field, which scores many proposals first. It uses a few returns for each,
/// on a coarse raster, with the returns turned by a table of headings. Const and thread-safe.
/// \cite algorithm section 6, "The cascade"
class CoarseField
{
 public:
  /// The lowest bit of a byte: a robot could be there. The likelihood has the other bits. In a sum
  /// of bytes this bit is too little to matter.
  static constexpr std::uint8_t kStanding = 1;

  /// Where a robot could be, for several coarse fields of one field.
  class Standing;

  /// A field with cells of 0.1 m, or 0.2 m where that would be too large for the cache.
  CoarseField(const DenseField& field, const Standing& standing);
  /// A field with cells of about `cell` [m].
  CoarseField(const DenseField& field, const Standing& standing, double cell);

  /// Returns the scores of the proposals at which a robot could be, in their order. Of very many
  /// only those are returned that are best by their first returns.
  std::vector<CoarseScore> score(const DenseScan& scan,
                                 const std::vector<PoseProposal>& proposals) const;

  /// Returns the `count` proposals that are best by 12 returns, and those that equal the last of
  /// them, in their order.
  std::vector<PoseProposal> best(const DenseScan& scan, const std::vector<PoseProposal>& proposals,
                                 std::size_t count) const;

  /// Returns the best score of any of the poses.
  std::uint32_t bestScore(const DenseScan& scan,
                          const std::vector<mrpt::math::TPose2D>& poses) const;

 private:
  CoarseField(const DenseField& field, const Standing& standing, const RasterFrame& frame);
  class TurnedReturns;
  void fillLikelihoods(const DenseField& field);
  void mark(const Standing& standing, const RasterFrame& fine);

  RasterFrame frame_;  ///< with a border around the map, in which no robot is
  std::uint32_t border_ = 0;  ///< [cells] width of the border
  ByteRaster likelihoods_;
};

/// The blocks of a field with free space, and those around them: a map may end a little before the
/// free space does.
class CoarseField::Standing
{
 public:
  explicit Standing(const DenseField& field);

 private:
  friend class CoarseField;
  RasterFrame frame_;
  ByteRaster blocks_;
};
}  // namespace sigloc
