// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bitset>

#include "geometry/simd.h"
#include "matching/dense/CellView.h"
#include "matching/dense/DenseVerifier.h"
#include "matching/dense/likelihood_table.h"
#include "matching/dense/WallCrossings.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kRayBeams = WallCrossings::kRays;  // beams tested for passing through walls
constexpr double kFreeMargin = 0.4;  // [m] from any wall, from which a return is in free space
constexpr auto kFarFromWall = static_cast<std::uint8_t>(kFreeMargin / DenseField::kDistanceUnit);

/// Returns the sharp likelihood of a return, by its distance from the ridge of the nearest wall.
/// Eq. (6.3), (6.12)
inline float sharpLikelihood(const SharpTable& table, const CellView::Block& block, std::size_t i,
                             float resolution)
{
  const float x = block.offsetX(i, resolution);
  const float y = block.offsetY(i, resolution);
  return block.distance(i) == DenseCell::kFar ? 0.0F : table.at(x * x + y * y);
}

/// Sums over the cells in which a scan's returns end.
struct EndSums
{
  float sharp = 0, fine = 0, coarse = 0;  ///< sums of likelihoods
  std::uint32_t in_free = 0, specks = 0, unknown = 0;  ///< numbers of returns far from any wall
};

SIGLOC_WIDE_VECTORS EndSums sumsOfEnds(const DenseField& field, const SharpTable& sharp,
                                       const DenseScan& scan, const Placement& place,
                                       std::size_t count)
{
  const CellView cells(field);
  const LikelihoodTable& fine = fineTable();
  const LikelihoodTable& coarse = coarseTable();
  EndSums sums;
  CellView::Block block;
  for (std::size_t first = 0; first < count; first += CellView::Block::kSize)
  {
    const std::size_t size = std::min(CellView::Block::kSize, count - first);
    block.fill(cells, place, &scan.x[first], &scan.y[first], size);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::uint8_t distance = block.distance(i);
      if (distance > kFarFromWall)
      {
        const CellState state = block.state(i);
        const bool is_speck = state == CellState::free && scan.isolated[first + i] != 0;
        if (is_speck) ++sums.specks;
        if (is_speck) continue;
        if (state == CellState::free) ++sums.in_free;
        if (state == CellState::unknown) ++sums.unknown;
      }
      sums.sharp += sharpLikelihood(sharp, block, i, cells.resolution());
      sums.fine += fine[distance];
      sums.coarse += coarse[distance];
    }
  }
  return sums;
}
}  // namespace

/// Returns the sum of the fine likelihood over the returns: F of eq. (6.13).
double DenseVerifier::fineLikelihood(const DenseScan& scan, const TPose2D& pose) const
{
  return static_cast<double>(sumsOfEnds(field_, sharp_, scan, Placement(pose), scan.size()).fine);
}

std::uint64_t DenseVerifier::beamsThroughWalls(const DenseScan& scan, const TPose2D& pose) const
{
  return wall_crossings_->throughBits(scan, pose, kRayBeams);
}

std::vector<ExplainedReturn> DenseVerifier::explainedReturns(const DenseScan& scan,
                                                             const TPose2D& pose,
                                                             std::uint64_t through) const
{
  constexpr double kOffWall = 0.25;  // [m] from any wall, from which a return is on none
  constexpr auto kOffAnyWall = static_cast<std::uint8_t>(kOffWall / DenseField::kDistanceUnit);
  constexpr float kSharpShare = 0.35F;
  constexpr auto kPenalty = static_cast<float>(DenseEvidence::kPenalty);
  const CellView cells(field_);
  const Placement place(pose);
  const LikelihoodTable& fine = fineTable();
  const LikelihoodTable& coarse = coarseTable();
  std::vector<ExplainedReturn> explained(scan.size());
  CellView::Block block;
  for (std::size_t first = 0; first < scan.size(); first += CellView::Block::kSize)
  {
    const std::size_t size = std::min(CellView::Block::kSize, scan.size() - first);
    block.fill(cells, place, &scan.x[first], &scan.y[first], size);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::uint8_t distance = block.distance(i);
      const bool in_free = distance > kFarFromWall && block.state(i) == CellState::free;
      const float blunt = (fine[distance] + coarse[distance]) / 2;
      const float sharp = sharpLikelihood(sharp_, block, i, cells.resolution());
      float share = blunt + kSharpShare * (sharp - blunt) - (in_free ? kPenalty : 0.0F);
      const bool passes_wall = first + i < kRayBeams && (through >> (first + i) & 1U) != 0;
      if (passes_wall) share -= kPenalty;
      const bool on_no_wall = distance > kOffAnyWall;
      ExplainedReturn& at = explained[first + i];
      at.share = std::max(0.0F, share);
      at.unknown = !passes_wall && on_no_wall && block.state(i) == CellState::unknown;
      at.off_walls = passes_wall || (on_no_wall && !at.unknown);
    }
  }
  return explained;
}

DenseEvidence DenseVerifier::evaluate(const DenseScan& scan, const TPose2D& pose) const
{
  return evaluate(scan, pose, scan.spaced, kRayBeams);
}

DenseEvidence DenseVerifier::evaluateEnds(const DenseScan& scan, const TPose2D& pose) const
{
  return evaluate(scan, pose, scan.spaced, 0);
}

void DenseVerifier::testRays(const DenseScan& scan, const TPose2D& pose,
                             DenseEvidence& evidence) const
{
  testRays(scan, pose, kRayBeams, evidence);
}

/// Returns the evidence of the first `returns` of the spaced ones, with `rays` beams tested for
/// passing through walls. Eq. (6.8)
DenseEvidence DenseVerifier::evaluate(const DenseScan& scan, const TPose2D& pose,
                                      std::size_t returns, std::size_t rays) const
{
  DenseEvidence evidence;
  const std::size_t count = std::min(returns, scan.spaced);
  if (count == 0) return evidence;
  const EndSums sums = sumsOfEnds(field_, sharp_, scan, Placement(pose), count);
  // An isolated return in free space is a speck of clutter, and no evidence.
  const auto n = static_cast<double>(std::max<std::size_t>(1, count - sums.specks));
  evidence.sharp = static_cast<double>(sums.sharp) / n;
  evidence.fine = static_cast<double>(sums.fine) / n;
  evidence.coarse = static_cast<double>(sums.coarse) / n;
  evidence.in_free = static_cast<double>(sums.in_free) / n;
  evidence.unknown = static_cast<double>(sums.unknown) / n;
  testRays(scan, pose, rays, evidence);
  return evidence;
}

/// Tests up to `rays` beams for passing through walls, and scores the evidence with what is found.
/// Only those of spaced returns count.
void DenseVerifier::testRays(const DenseScan& scan, const TPose2D& pose, std::size_t rays,
                             DenseEvidence& evidence) const
{
  const std::size_t counted = std::min(rays, scan.spaced);
  if (counted > 0)
  {
    evidence.through = wall_crossings_->throughBits(scan, pose, rays);
    const std::bitset<kRayBeams> crossed(evidence.through << (kRayBeams - counted));
    evidence.through_wall = static_cast<double>(crossed.count()) / static_cast<double>(counted);
  }
  evidence.score = (evidence.sharp + evidence.coarse) / 2 -
                   DenseEvidence::kPenalty * evidence.through_wall -
                   DenseEvidence::kPenalty * evidence.in_free;
}
}  // namespace sigloc
