// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "matching/dense/DenseEvidence.h"
#include "matching/dense/DenseScan.h"
#include "sigloc/map/DenseField.h"

namespace sigloc
{
/// A raster over the same area with cells of about `cell` [m], a whole number of the finer ones.
RasterFrame coarserFrame(const RasterFrame& fine, double cell);

/// A proposal's first look.
struct CoarseScore
{
  std::uint32_t score;  ///< sum of the likelihood bytes of the returns looked up
  std::uint32_t index;  ///< of the proposal
};

/// The first look at many proposals: a few returns each, on a coarse raster of likelihoods, turned
/// by a table of headings. Const and thread-safe. \cite algorithm section 6
class CoarseField
{
 public:
  explicit CoarseField(const DenseField& field);

  /// Looks at the proposals that a robot could stand at, in their order; of very many only at those
  /// that are best by their first returns.
  std::vector<CoarseScore> score(const DenseScan& scan,
                                 const std::vector<PoseProposal>& proposals) const;

 private:
  class TurnedReturns;
  void fillLikelihoods(const DenseField& field);
  void markStanding(const DenseField& field);

  RasterFrame frame_;  ///< with a border around the map
  std::uint32_t border_ = 0;  ///< [cells] of it
  std::vector<std::uint8_t> likelihoods_;  ///< and in their lowest bit whether a robot could stand
};
}  // namespace sigloc
