// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/DenseVerifier.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "geometry/same_place.h"
#include "matching/dense/CellView.h"
#include "matching/dense/CoarseField.h"
#include "matching/dense/likelihood_table.h"
#include "matching/dense/simd.h"
#include "matching/dense/WallCrossings.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr std::size_t kQuickSorted = 1024;  // best first looks that are sorted at all
constexpr std::size_t kQuickKept = 40;  // places that are refined: the cascade's knob
constexpr float kMiddleShare = 0.65F;  // of what the best explains: with less a place is dropped
constexpr std::size_t kMiddleBeams = 32;
constexpr std::size_t kMiddleScored = 48;
constexpr int kMiddleSteps = 3;
constexpr std::size_t kFinalKept = 12;
constexpr std::size_t kFinalBeams = 64;
constexpr double kFinalLead = 0.3;  // of the best; what is farther behind is not refined further
constexpr int kFinalSteps = 2;
constexpr std::size_t kSettled = 4;
constexpr int kSettleSteps = 12;
constexpr double kSettleLoss = 0.01;  // of the score, that settling may cost
constexpr double kApartDistance = 0.08;  // [m]
constexpr std::size_t kRayBeams = WallCrossings::kRays;  // beams tested for passing through walls
constexpr std::size_t kFinalRays = 24;  // of them, for a pose that may still be no contender
constexpr double kFreeMargin = 0.4;  // [m] from any wall that makes an end in free space count
constexpr auto kFarFromWall = static_cast<std::uint8_t>(kFreeMargin / DenseField::kDistanceUnit);
constexpr double kThroughPenalty = 0.5;
constexpr double kFreePenalty = 0.5;

/// Of a return by its distance from the ridge of the nearest wall.
float sharpLikelihood(const CellView::Block& block, std::size_t i, float resolution)
{
  constexpr float kSharpSigma = 0.06F;  // [m]
  constexpr float kSlope = -0.5F / (kSharpSigma * kSharpSigma);
  if (block.distance(i) == 255) return 0;
  const float x = block.offsetX(i, resolution);
  const float y = block.offsetY(i, resolution);
  return std::exp(kSlope * (x * x + y * y));
}

/// Best first; ties are broken by the pose, so that the order never depends on the history.
bool better(const RankedPose& a, const RankedPose& b)
{
  if (a.evidence.score != b.evidence.score) return a.evidence.score > b.evidence.score;
  if (a.pose.x != b.pose.x) return a.pose.x < b.pose.x;
  if (a.pose.y != b.pose.y) return a.pose.y < b.pose.y;
  return a.pose.phi < b.pose.phi;
}

/// Keeps the best of each group of poses that are not distinct; at most `count`.
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

/// Of poses that are sorted, best first; 0 where there is none.
double bestScore(const std::vector<RankedPose>& poses)
{
  return poses.empty() ? 0 : poses.front().evidence.score;
}

/// Proposals that were taken, to leave out others so near that one of them is enough to refine.
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

  /// Adds one; at most kQuickKept.
  void add(const PoseProposal& p)
  {
    x_[count_] = p.x;
    y_[count_] = p.y;
    phi_[count_] = wrapToPi(p.phi);
    ++count_;
  }

 private:
  std::array<float, kQuickKept> x_, y_, phi_;
  std::size_t count_ = 0;
};

/// The same scan, with the pull of its returns balanced.
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

/// What the field says of where a scan's beams end.
struct EndSums
{
  float fine = 0, coarse = 0;  ///< likelihoods
  std::uint32_t in_free = 0, specks = 0, unknown = 0;  ///< returns away from any wall
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
  // 1. A first look at every proposal with a few beams.
  std::vector<CoarseScore> looks = coarse_field_->score(scan, proposals);
  poses_scored += looks.size();

  // 2. The best of each place, refined on some of the beams.
  std::vector<RankedPose> poses = refineBest(scan, proposals, std::move(looks));
  // Poses of one place that stopped apart stay rivals until all beams have judged them: which of
  // them wins must not hang on where the proposals happened to lie.
  keepDistinct(poses, kFinalKept, kApartDistance);

  // 3. The best of those, refined on more beams and judged by all of them.
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

  // 4. What may win or be the runner-up is settled on all beams.
  const DenseScan balanced = balancedScan(scan);
  const double contender = std::max(bestScore(poses), bestScore(before)) - kContender;
  for (std::size_t k = 0; k < std::min(kSettled, poses.size()); ++k)
  {
    RankedPose& pose = poses[k];
    if (pose.evidence.score < contender) break;
    settle(scan, balanced, pose);
  }
  poses.insert(poses.end(), before.begin(), before.end());
  keepDistinct(poses, max_ranked);
  return poses;
}

/// Refines a pose on all beams. What all of them say of its place outweighs a small loss of score;
/// the place still ranks by the better of the two.
void DenseVerifier::settle(const DenseScan& scan, const DenseScan& balanced, RankedPose& pose) const
{
  RankedPose settled;
  settled.pose = refine(balanced, pose.pose, kSettleSteps, scan.size());
  settled.evidence = evaluate(scan, settled.pose, kRayBeams);
  // Rays only lower a score: often the ends alone tell that the start is not better.
  const double of_ends = pose.evidence.score + kThroughPenalty * pose.evidence.through_wall;
  if (settled.evidence.score < of_ends)
  {
    pose.evidence = evaluate(scan, pose.pose, kRayBeams);
    if (settled.evidence.score < pose.evidence.score - kSettleLoss) return;
    if (settled.evidence.score < pose.evidence.score) settled.evidence = pose.evidence;
  }
  pose = settled;
}

std::vector<RankedPose> DenseVerifier::refineBest(const DenseScan& scan,
                                                  const std::vector<PoseProposal>& proposals,
                                                  std::vector<CoarseScore> looks) const
{
  const auto worse = [](const CoarseScore& a, const CoarseScore& b)
  { return a.score != b.score ? a.score < b.score : a.index > b.index; };
  // Few are taken before there are enough: a heap sorts no more than those.
  std::make_heap(looks.begin(), looks.end(), worse);
  auto end = looks.end();
  std::vector<TPose2D> places;
  places.reserve(kQuickKept);
  // By distance, not by cells of the map: moving the map must not change which ones are refined.
  TakenPoses taken;
  for (std::size_t k = 0; k < kQuickSorted && end != looks.begin() && places.size() < kQuickKept;
       ++k)
  {
    std::pop_heap(looks.begin(), end, worse);
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

/// Mean of the fine and the coarse likelihood of the first `beams` returns.
double DenseVerifier::likelihood(const DenseScan& scan, const TPose2D& pose,
                                 std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  const EndSums sums = sumsOfEnds(field_, scan, Placement(pose), count);
  return 0.5 * static_cast<double>(sums.fine + sums.coarse) / static_cast<double>(count);
}

/// Sum over the returns.
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
  // A lone return in free space is clutter, and says nothing.
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
