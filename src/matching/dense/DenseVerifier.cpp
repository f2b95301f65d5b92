// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/DenseVerifier.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "geometry/same_place.h"
#include "matching/dense/CellView.h"
#include "matching/dense/CoarseField.h"
#include "matching/dense/likelihood_table.h"
#include "matching/dense/simd.h"
#include "matching/dense/WallCrossings.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
// The cascade, \cite algorithm section 6. Stage 2, one pose of each neighbourhood:
constexpr std::size_t kCoarseSorted = 1024;  // best coarse scores that are considered
constexpr std::size_t kCoarseKept = 40;  // poses that are refined; sets the cost of the cascade
constexpr float kMiddleShare =
    0.65F;  // of the weights (6.6) of the best, below which one is dropped
constexpr std::size_t kMiddleBeams = 32;  // returns that refine
constexpr std::size_t kMiddleScored = 48;  // returns that score
constexpr int kMiddleSteps = 3;  // of refinement
// Stage 3, distinct poses:
constexpr std::size_t kFinalKept = 12;  // poses that are refined
constexpr std::size_t kFinalBeams = 64;  // returns that refine
constexpr double kFinalLead =
    0.3;  // below the best score, from which a pose is not refined further
constexpr int kFinalSteps = 2;  // of refinement
// Stage 4, final refinement:
constexpr std::size_t kFinallyRefined = 4;  // poses that are refined
constexpr int kLastSteps = 12;  // of refinement on all returns
constexpr double kLastLoss = 0.01;  // of the score that it may cost
// All stages:
constexpr double kApartDistance = 0.08;  // [m] between distinct poses after stage 2
constexpr std::size_t kRayBeams = WallCrossings::kRays;  // beams tested for passing through walls
constexpr std::size_t kFinalRays = 24;  // beams tested in stage 3
constexpr double kFreeMargin = 0.4;  // [m] from any wall, from which a return is in free space
constexpr auto kFarFromWall = static_cast<std::uint8_t>(kFreeMargin / DenseField::kDistanceUnit);
constexpr double kThroughPenalty = 0.5;  // score per share of beams through walls, eq. (6.8)
constexpr double kFreePenalty = 0.5;  // score per share of returns in free space, eq. (6.8)

/// Returns L_0.06 of a return, by its distance from the ridge of the nearest wall. Eq. (6.3),
/// (6.12)
float sharpLikelihood(const CellView::Block& block, std::size_t i, float resolution)
{
  constexpr float kSharpSigma = 0.06F;  // [m]
  constexpr float kSlope = -0.5F / (kSharpSigma * kSharpSigma);
  if (block.distance(i) == 255) return 0;
  const float x = block.offsetX(i, resolution);
  const float y = block.offsetY(i, resolution);
  return std::exp(kSlope * (x * x + y * y));
}

/// Orders poses, best first. Ties are broken by the pose, so that the order never depends on how
/// the proposals came in.
bool better(const RankedPose& a, const RankedPose& b)
{
  if (a.evidence.score != b.evidence.score) return a.evidence.score > b.evidence.score;
  if (a.pose.x != b.pose.x) return a.pose.x < b.pose.x;
  if (a.pose.y != b.pose.y) return a.pose.y < b.pose.y;
  return a.pose.phi < b.pose.phi;
}

/// Keeps the best of each group of poses that are not distinct, at most `count`.
void keepDistinct(std::vector<RankedPose>& poses, std::size_t count,
                  double distance = kSamePlaceDistance)
{
  std::sort(poses.begin(), poses.end(), better);
  std::vector<RankedPose> kept;
  for (const RankedPose& candidate : poses)
  {
    if (kept.size() == count) break;
    const bool fresh = std::all_of(
        kept.begin(), kept.end(),
        [&](const RankedPose& other)
        { return !withinReach(candidate.pose, other.pose, distance, kSamePlaceAngle); });
    if (fresh) kept.push_back(candidate);
  }
  poses = std::move(kept);
}

/// Returns the score of the first of sorted poses, or 0 without any.
double bestScore(const std::vector<RankedPose>& poses)
{
  return poses.empty() ? 0 : poses.front().evidence.score;
}

/// Proposals that were chosen. Others near one of them are left out, because refining one is
/// enough.
class TakenPoses
{
 public:
  bool holdsNear(const PoseProposal& p) const
  {
    constexpr float kReach = 0.25F;  // [m] along each axis
    constexpr auto kTurn = static_cast<float>(4.5 * M_PI / 180.0);  // [rad]
    constexpr auto kFullTurn = static_cast<float>(2 * M_PI);
    const float phi = wrapToPi(p.phi);
    int near = 0;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const float turn = std::abs(phi_[i] - phi);
      const bool is_turned = turn < kTurn || turn > kFullTurn - kTurn;
      near |= static_cast<int>(std::abs(x_[i] - p.x) < kReach) &
              static_cast<int>(std::abs(y_[i] - p.y) < kReach) & static_cast<int>(is_turned);
    }
    return near != 0;
  }

  /// Adds one; at most kCoarseKept.
  void add(const PoseProposal& p)
  {
    x_[count_] = p.x;
    y_[count_] = p.y;
    phi_[count_] = wrapToPi(p.phi);
    ++count_;
  }

 private:
  std::array<float, kCoarseKept> x_, y_, phi_;
  std::size_t count_ = 0;
};

/// Returns the scan with its residuals weighted by (6.11).
DenseScan balancedScan(DenseScan scan)
{
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    scan.pull_xx[i] *= scan.balance[i];
    scan.pull_xy[i] *= scan.balance[i];
    scan.pull_yy[i] *= scan.balance[i];
  }
  return scan;
}

/// Sums over the cells in which a scan's returns end.
struct EndSums
{
  float fine = 0, coarse = 0;  ///< sums of likelihoods
  std::uint32_t in_free = 0, specks = 0, unknown = 0;  ///< numbers of returns far from any wall
};

SIGLOC_WIDE_VECTORS EndSums sumsOfEnds(const DenseField& field, const DenseScan& scan,
                                       const Placement& place, std::size_t count)
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
      sums.fine += fine[distance];
      sums.coarse += coarse[distance];
      if (distance <= kFarFromWall) continue;
      const CellState state = block.state(i);
      if (state == CellState::free) ++(scan.isolated[first + i] != 0 ? sums.specks : sums.in_free);
      if (state == CellState::unknown) ++sums.unknown;
    }
  }
  return sums;
}
}  // namespace

DenseVerifier::DenseVerifier(const DenseField& field) : field_(field)
{
  if (field.cells.empty()) throw std::invalid_argument("DenseVerifier: the field has no cells");
  coarse_field_ = std::make_unique<CoarseField>(field);
  wall_crossings_ = std::make_unique<WallCrossings>(field);
}

DenseVerifier::~DenseVerifier() = default;

std::vector<RankedPose> DenseVerifier::rank(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t max_ranked, std::uint64_t& poses_scored,
                                            std::vector<RankedPose> before) const
{
  if (scan.size() == 0 || proposals.empty()) return before;
  // 1. Score every proposal coarsely with a few returns.
  std::vector<CoarseScore> scores = coarse_field_->score(scan, proposals);
  poses_scored += scores.size();

  // 2. Refine the best of each neighbourhood on some of the returns.
  std::vector<RankedPose> poses = refineBest(scan, proposals, std::move(scores));
  // Neighbouring poses that did not converge stay rivals until all returns have scored them. Which
  // of them wins must not depend on where the proposals were.
  keepDistinct(poses, kFinalKept, kApartDistance);

  // 3. Refine the best of those on more returns, and score them by all.
  const double promising = std::max(bestScore(poses), bestScore(before)) - kFinalLead;
  std::vector<TPose2D> refined;
  for (const RankedPose& pose : poses)
  {
    if (pose.evidence.score < promising) break;
    refined.push_back(pose.pose);
  }
  refineAll(scan, refined, kFinalSteps, kFinalBeams, 0);
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    if (k < refined.size()) poses[k].pose = refined[k];
    poses[k].evidence = evaluate(scan, poses[k].pose, kFinalRays);
  }
  keepDistinct(poses, max_ranked);

  // 4. Refine those that may win or be the runner-up on all returns.
  const DenseScan balanced = balancedScan(scan);
  const double contender = std::max(bestScore(poses), bestScore(before)) - kContender;
  for (std::size_t k = 0; k < std::min(kFinallyRefined, poses.size()); ++k)
  {
    RankedPose& pose = poses[k];
    if (pose.evidence.score < contender) break;
    refineFinally(scan, balanced, pose);
  }
  poses.insert(poses.end(), before.begin(), before.end());
  keepDistinct(poses, max_ranked);
  return poses;
}

/// Refines a pose on all returns. They fix it better than a small difference of the score does, so
/// a small loss is accepted. The pose ranks by the better of the two scores.
void DenseVerifier::refineFinally(const DenseScan& scan, const DenseScan& balanced,
                                  RankedPose& pose) const
{
  RankedPose settled;
  settled.pose = refine(balanced, pose.pose, kLastSteps, scan.size());
  settled.evidence = evaluate(scan, settled.pose, kRayBeams);
  // Beams through walls only lower a score. So the returns alone often show that the start is not
  // better.
  const double of_ends = pose.evidence.score + kThroughPenalty * pose.evidence.through_wall;
  if (settled.evidence.score < of_ends)
  {
    pose.evidence = evaluate(scan, pose.pose, kRayBeams);
    if (settled.evidence.score < pose.evidence.score - kLastLoss) return;
    if (settled.evidence.score < pose.evidence.score) settled.evidence = pose.evidence;
  }
  pose = settled;
}

std::vector<RankedPose> DenseVerifier::refineBest(const DenseScan& scan,
                                                  const std::vector<PoseProposal>& proposals,
                                                  std::vector<CoarseScore> scores) const
{
  const auto worse = [](const CoarseScore& a, const CoarseScore& b)
  { return a.score != b.score ? a.score < b.score : a.index > b.index; };
  // Few are needed before enough are chosen, and a heap sorts no more than those.
  std::make_heap(scores.begin(), scores.end(), worse);
  auto end = scores.end();
  std::vector<TPose2D> places;
  places.reserve(kCoarseKept);
  // Neighbours are found by distance, not by cells of the map: moving the map must not change which
  // poses are refined.
  TakenPoses taken;
  for (std::size_t k = 0; k < kCoarseSorted && end != scores.begin() && places.size() < kCoarseKept;
       ++k)
  {
    std::pop_heap(scores.begin(), end, worse);
    const PoseProposal& p = proposals[(--end)->index];
    if (taken.holdsNear(p)) continue;
    taken.add(p);
    places.emplace_back(p.x, p.y, p.phi);
  }
  refineAll(scan, places, kMiddleSteps, kMiddleBeams, kMiddleShare);
  std::vector<RankedPose> poses(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    poses[k].pose = places[k];
    poses[k].evidence.score = likelihood(scan, places[k], kMiddleScored);
  }
  return poses;
}

/// Returns the mean of the fine and the coarse likelihood of the first `beams` returns.
double DenseVerifier::likelihood(const DenseScan& scan, const TPose2D& pose,
                                 std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  const EndSums sums = sumsOfEnds(field_, scan, Placement(pose), count);
  return 0.5 * static_cast<double>(sums.fine + sums.coarse) / static_cast<double>(count);
}

/// Returns the sum of the fine likelihood over the returns: F of eq. (6.13).
double DenseVerifier::fineLikelihood(const DenseScan& scan, const TPose2D& pose) const
{
  return static_cast<double>(sumsOfEnds(field_, scan, Placement(pose), scan.size()).fine);
}

std::vector<float> DenseVerifier::explainedReturns(const DenseScan& scan, const TPose2D& pose) const
{
  constexpr float kSharpShare = 0.35F;
  constexpr auto kFree = static_cast<float>(kFreePenalty);
  constexpr auto kThrough = static_cast<float>(kThroughPenalty);
  const CellView cells(field_);
  const Placement place(pose);
  const LikelihoodTable& fine = fineTable();
  const LikelihoodTable& coarse = coarseTable();
  const std::uint64_t through = wall_crossings_->throughBits(scan, pose, kRayBeams);
  std::vector<float> explained(scan.size());
  CellView::Block block;
  for (std::size_t first = 0; first < scan.size(); first += CellView::Block::kSize)
  {
    const std::size_t size = std::min(CellView::Block::kSize, scan.size() - first);
    block.fill(cells, place, &scan.x[first], &scan.y[first], size);
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::uint8_t distance = block.distance(i);
      const bool in_free = distance > kFarFromWall && block.state(i) == CellState::free;
      const float blunt = 0.5F * (fine[distance] + coarse[distance]);
      const float sharp = sharpLikelihood(block, i, cells.resolution());
      float share = blunt + kSharpShare * (sharp - blunt) - (in_free ? kFree : 0.0F);
      if (first + i < kRayBeams && (through >> (first + i) & 1U) != 0) share -= kThrough;
      explained[first + i] = std::max(0.0F, share);
    }
  }
  return explained;
}

DenseEvidence DenseVerifier::evaluate(const DenseScan& scan, const TPose2D& pose) const
{
  return evaluate(scan, pose, kRayBeams);
}

DenseEvidence DenseVerifier::evaluate(const DenseScan& scan, const TPose2D& pose,
                                      std::size_t rays) const
{
  DenseEvidence evidence;
  if (scan.size() == 0) return evidence;
  const EndSums sums = sumsOfEnds(field_, scan, Placement(pose), scan.size());
  // An isolated return in free space is a speck of clutter, and no evidence.
  const auto n = static_cast<double>(std::max<std::size_t>(1, scan.size() - sums.specks));
  evidence.fine = static_cast<double>(sums.fine) / n;
  evidence.coarse = static_cast<double>(sums.coarse) / n;
  evidence.in_free = static_cast<double>(sums.in_free) / n;
  evidence.unknown = static_cast<double>(sums.unknown) / n;
  evidence.through_wall = wall_crossings_->throughShare(scan, pose, rays);
  evidence.score = 0.5 * (evidence.fine + evidence.coarse) -
                   kThroughPenalty * evidence.through_wall - kFreePenalty * evidence.in_free;
  return evidence;
}
}  // namespace sigloc
