// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/DenseVerifier.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/same_place.h"
#include "matching/dense/BestFirst.h"
#include "matching/dense/CoarseField.h"
#include "matching/dense/TakenPoses.h"
#include "matching/dense/WallCrossings.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
// The cascade, \cite algorithm section 6. Stage 1, where proposals are very many:
constexpr std::size_t kVeryMany = 48000;  // with fewer, thinning takes longer than it saves
constexpr double kRoughCell = 0.4;  // [m] of the raster that thins them
constexpr std::size_t kRoughKept = 8000;  // proposals that are left, ties not counted
// Stage 2, one pose of each neighbourhood:
constexpr std::size_t kFirstBatch = 4;  // places refined first: one of them often explains all
constexpr std::size_t kBatch = 64;  // places refined at a time after that
constexpr std::size_t kMostRefined = 400;  // places; bounds the cost where many poses fit
// Share of the coarse score behind the best refined pose. Places behind it are not refined. It is
// so many times what that pose leaves unexplained, chosen in docs/lab-notes/large-maps.md.
constexpr double kMarginOfUnexplained = 3;
constexpr double kCoarseMargin = 0.2;  // at most
constexpr float kMiddleShare = 0.7F;  // of the weights (6.6) of the best; with less one is dropped
constexpr std::size_t kMiddleBeams = 32;  // returns that refine
constexpr std::size_t kMiddleScored = 48;  // returns that score
constexpr std::size_t kMiddleRays = 16;  // beams tested for passing through walls
constexpr int kMiddleSteps = 4;  // of refinement
// Stage 3, distinct poses:
constexpr std::size_t kFinalKept = 24;  // poses that are refined
constexpr std::size_t kFinalBeams = 64;  // returns that refine
constexpr double kFinalLead =
    0.3;  // below the best score, from which a pose is not refined further
constexpr int kFinalSteps = 2;  // of refinement
constexpr std::size_t kFinalRays = 24;  // beams tested for passing through walls
// Stage 4, final refinement:
constexpr std::size_t kFinallyRefined = 4;  // poses that are refined
constexpr int kLastSteps = 12;  // of refinement on all returns
// All stages:
constexpr double kTie = 0.03;  // of the score behind the best, up to which poses tie
constexpr double kApartDistance = 0.08;  // [m] between distinct poses after stage 2

/// Orders poses, best first. Ties are broken by the pose, so that the order never depends on how
/// the proposals came in.
bool better(const RankedPose& a, const RankedPose& b)
{
  if (a.evidence.score != b.evidence.score) return a.evidence.score > b.evidence.score;
  if (a.pose.x != b.pose.x) return a.pose.x < b.pose.x;
  if (a.pose.y != b.pose.y) return a.pose.y < b.pose.y;
  return a.pose.phi < b.pose.phi;
}

}  // namespace

/// Distinct poses. They are offered best first. The first `count` are kept, and beyond these those
/// that tie with the best, up to `most_tied` in all.
class DistinctPoses
{
 public:
  explicit DistinctPoses(std::size_t count, std::size_t most_tied,
                         double distance = kSamePlaceDistance)
      : count_(count), most_tied_(most_tied), distance_(distance)
  {
  }

  /// Keeps the pose if none like it is kept. Returns false if no later pose will be kept either.
  bool offer(const RankedPose& pose)
  {
    const bool full = kept_.size() >= count_;
    const bool ties = kept_.empty() || pose.evidence.score >= kept_.front().evidence.score - kTie;
    if (full && (!ties || kept_.size() >= most_tied_)) return false;
    const double apart = full ? kSamePlaceDistance : distance_;
    const bool fresh =
        std::all_of(kept_.begin(), kept_.end(),
                    [&](const RankedPose& other)
                    { return !withinReach(pose.pose, other.pose, apart, kSamePlaceAngle); });
    if (fresh) kept_.push_back(pose);
    return true;
  }

  std::vector<RankedPose> take() { return std::move(kept_); }

 private:
  std::size_t count_, most_tied_;
  double distance_;  // [m] between the first `count` poses
  std::vector<RankedPose> kept_;
};

namespace
{
void keepDistinct(std::vector<RankedPose>& poses, std::size_t count, std::size_t most_tied)
{
  std::sort(poses.begin(), poses.end(), better);
  DistinctPoses distinct(count, most_tied);
  for (const RankedPose& pose : poses)
  {
    if (!distinct.offer(pose)) break;
  }
  poses = distinct.take();
}

/// Drops the poses at which one has been ranked before. It would end there again.
void dropKnown(const std::vector<RankedPose>& before, std::vector<RankedPose>& poses)
{
  const auto is_known = [&](const RankedPose& pose)
  {
    return std::any_of(before.begin(), before.end(),
                       [&](const RankedPose& other) {
                         return withinReach(pose.pose, other.pose, kApartDistance, kSamePlaceAngle);
                       });
  };
  poses.erase(std::remove_if(poses.begin(), poses.end(), is_known), poses.end());
}

/// Returns the score of the first of sorted poses, or 0 without any.
double bestScore(const std::vector<RankedPose>& poses)
{
  return poses.empty() ? 0 : poses.front().evidence.score;
}

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

}  // namespace

DenseVerifier::DenseVerifier(const DenseField& field, double wall_blur)
    : field_(field), sharp_(wall_blur)
{
  if (field.cells.empty()) throw std::invalid_argument("DenseVerifier: the field has no cells");
  const CoarseField::Standing standing(field);
  coarse_field_ = std::make_unique<CoarseField>(field, standing);
  rough_field_ = std::make_unique<CoarseField>(field, standing, kRoughCell);
  wall_crossings_ = std::make_unique<WallCrossings>(field);
}

DenseVerifier::~DenseVerifier() = default;

std::vector<RankedPose> DenseVerifier::rank(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t max_ranked, MatchingCounters& counters,
                                            std::vector<RankedPose> before) const
{
  if (scan.size() == 0 || proposals.empty()) return before;
  // 1. Score every proposal coarsely with a few returns.
  const bool are_many = proposals.size() > kVeryMany;
  const std::vector<PoseProposal> likely =
      are_many ? rough_field_->best(scan, proposals, kRoughKept) : std::vector<PoseProposal>{};
  const std::vector<PoseProposal>& tried = are_many ? likely : proposals;
  const std::vector<CoarseScore> scores = coarse_field_->score(scan, tried);
  counters.poses_scored += are_many ? proposals.size() : scores.size();

  // 2. Refine the best of each neighbourhood on some of the returns. Neighbouring poses that did
  // not converge stay rivals until all returns have scored them. Which of them wins must not depend
  // on where the proposals were.
  std::vector<Raced> raced = race(scan, tried, scores, before, counters);
  std::vector<RankedPose> poses =
      bestOf(scan, std::move(raced), kMiddleRays,
             DistinctPoses(kFinalKept, kFinalKept + max_ranked, kApartDistance));
  dropKnown(before, poses);
  if (poses.empty()) return before;

  // 3. Refine the best of those on more returns, and score them by all.
  const double promising = std::max(bestScore(poses), bestScore(before)) - kFinalLead;
  std::vector<TPose2D> refined;
  for (const RankedPose& pose : poses)
  {
    if (pose.evidence.score < promising) break;
    refined.push_back(pose.pose);
  }
  refineAll(scan, refined, kFinalSteps, kFinalBeams);
  raced.clear();
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    const TPose2D& pose = k < refined.size() ? refined[k] : poses[k].pose;
    raced.push_back({{pose, evaluateEnds(scan, pose)}, false});
  }
  const std::size_t usual = std::min(kUsuallyRanked, max_ranked);
  poses = bestOf(scan, std::move(raced), kFinalRays, DistinctPoses(usual, max_ranked));

  // 4. Refine those that may win or be the runner-up on all returns, and all that tie. Equal places
  // end at equal poses, so each is scored where it ends, even if it scored better before. Plain
  // weights are those of tracking: a place is then not scored lower than one that is followed.
  const double contender = std::max(bestScore(poses), bestScore(before)) - kContender;
  const double tied = std::max(bestScore(poses), bestScore(before)) - kTie;
  std::vector<TPose2D> settled;
  for (std::size_t k = 0; k < poses.size(); ++k)
  {
    if (poses[k].evidence.score < (k < kFinallyRefined ? contender : tied)) break;
    settled.push_back(poses[k].pose);
  }
  std::vector<TPose2D> plain = settled;
  refineAll(balancedScan(scan), settled, kLastSteps, scan.size());
  refineAll(scan, plain, kLastSteps, scan.size());
  for (std::size_t k = 0; k < settled.size(); ++k)
  {
    poses[k] = std::min(RankedPose{settled[k], evaluate(scan, settled[k])},
                        RankedPose{plain[k], evaluate(scan, plain[k])}, better);
  }
  poses.insert(poses.end(), before.begin(), before.end());
  keepDistinct(poses, usual, max_ranked);
  return poses;
}

/// Refines one proposal of each place, best first, until the next can hardly win any more. What a
/// refinement adds to the coarse score is small, so few are refined where the scan tells much.
std::vector<DenseVerifier::Raced> DenseVerifier::race(const DenseScan& scan,
                                                      const std::vector<PoseProposal>& proposals,
                                                      const std::vector<CoarseScore>& scores,
                                                      const std::vector<RankedPose>& before,
                                                      MatchingCounters& counters) const
{
  std::vector<TPose2D> places;
  places.reserve(before.size() + kBatch);
  for (const RankedPose& pose : before) places.push_back(pose.pose);
  std::uint32_t best = coarse_field_->bestScore(scan, places);
  constexpr auto kMargin = static_cast<std::uint32_t>(kCoarseMargin * CoarseScore::kMost);
  BestFirst order(scores, kMargin);

  TakenPoses taken;
  std::vector<Raced> raced;
  float most_weight = 0;
  double best_middle = bestScore(before);
  std::size_t refined = 0;
  const auto can_win = [&]
  {
    const double margin = std::min(kCoarseMargin, kMarginOfUnexplained * (1 - best_middle));
    return !order.empty() &&
           order.bestScore() + static_cast<std::uint32_t>(margin * CoarseScore::kMost) >= best;
  };
  while (refined < kMostRefined && can_win())
  {
    const std::size_t batch = std::min(refined == 0 ? kFirstBatch : kBatch, kMostRefined - refined);
    places.clear();
    while (places.size() < batch && can_win())
    {
      const PoseProposal& p = proposals[order.take()];
      if (taken.holdsNear(p)) continue;
      taken.add(p);
      places.emplace_back(p.x, p.y, p.phi);
    }
    refined += places.size();
    refineAll(scan, places, kMiddleSteps, kMiddleBeams, kMiddleShare, &most_weight);
    best = std::max(best, coarse_field_->bestScore(scan, places));
    for (const TPose2D& place : places)
    {
      Raced next{{place, evaluate(scan, place, kMiddleScored, 0)}, false};
      // Beams through walls only lower a score.
      const double most = next.ranked.evidence.score;
      if (most < best_middle - kFinalLead) continue;
      if (most > best_middle) testRays(scan, kMiddleRays, next);
      if (next.rays_tested) best_middle = std::max(best_middle, next.ranked.evidence.score);
      raced.push_back(next);
    }
  }
  if (can_win()) ++counters.cut_short;
  return raced;
}

void DenseVerifier::testRays(const DenseScan& scan, std::size_t rays, Raced& raced) const
{
  testRays(scan, raced.ranked.pose, rays, raced.ranked.evidence);
  raced.rays_tested = true;
}

/// Returns the best distinct poses, with up to `rays` of their beams tested for passing through
/// walls.
std::vector<RankedPose> DenseVerifier::bestOf(const DenseScan& scan, std::vector<Raced> raced,
                                              std::size_t rays, DistinctPoses distinct) const
{
  // The test only lowers a score. So it is made of those that are best without it, and most poses
  // are never tested.
  const auto after = [](const Raced& a, const Raced& b)
  {
    const bool tie = a.ranked.evidence.score == b.ranked.evidence.score;
    return tie && a.rays_tested != b.rays_tested ? a.rays_tested : better(b.ranked, a.ranked);
  };
  std::make_heap(raced.begin(), raced.end(), after);
  while (!raced.empty())
  {
    std::pop_heap(raced.begin(), raced.end(), after);
    if (raced.back().rays_tested)
    {
      if (!distinct.offer(raced.back().ranked)) break;
      raced.pop_back();
      continue;
    }
    testRays(scan, rays, raced.back());
    std::push_heap(raced.begin(), raced.end(), after);
  }
  return distinct.take();
}
}  // namespace sigloc
