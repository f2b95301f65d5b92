// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/ScanHistory.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "geometry/same_place.h"
#include "matching/candidate_probabilities.h"

namespace sigloc
{
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr std::size_t kMostLooks = 60;
constexpr double kSpacing = 0.5;  // [m] of travel between them
constexpr int kSteps = 3;  // of refinement
constexpr double kWaySigma = 0.1;  // [m] that a addScan may be off the way that odometry tells
constexpr double kWayTurnSigma = 0.05;  // [rad]
constexpr double kBranches = 0.5;  // log-odds for a slip: less may be chance
}  // namespace

/// A robot that goes back the way it came, and at each addScan stands where that fits best.
class ScanHistory::Replay
{
 public:
  Replay(const TPose2D& pose, const TPose2D& odometry, const DenseVerifier& verifier)
      : pose_(pose), odometry_(odometry), verifier_(verifier)
  {
  }

  Visit visit(const Look& addScan)
  {
    const TPose2D told = pose_ + (addScan.odometry - odometry_);
    pose_ = verifier_.refine(addScan.scan, told, kSteps, addScan.scan.size());
    odometry_ = addScan.odometry;
    const double off = std::hypot(pose_.x - told.x, pose_.y - told.y) / kWaySigma;
    const double turned = wrapToPi(pose_.phi - told.phi) / kWayTurnSigma;
    const double detour = std::min(kMaxRelative, 0.5 * (off * off + turned * turned));
    auto explained = verifier_.explainedReturns(addScan.scan, pose_);
    const double unexplained = explained_.addScan(addScan.view, explained, -addScan.travelled);
    return {pose_, logLikelihoodOfScore(verifier_.evaluate(addScan.scan, pose_).score), unexplained,
            detour, std::move(explained)};
  }

 private:
  CellEvidence explained_;
  TPose2D pose_;
  TPose2D odometry_;
  const DenseVerifier& verifier_;
};

void ScanHistory::move(const std::optional<MotionIncrement>& motion)
{
  ++step_;
  if (motion)
  {
    odometry_ = odometry_ + motion->mean;
    return;
  }
  looks_.clear();
  known_since_ = step_;
}

void ScanHistory::remember(const DenseScan& scan, double travelled)
{
  if (step_ < known_since_) return;
  if (!looks_.empty() && travelled < looks_.back().travelled + kSpacing) return;
  looks_.push_back({scan, observedCells(scan, odometry_), odometry_, travelled, step_});
  if (looks_.size() <= kMostLooks) return;
  looks_.pop_front();
  known_since_ = looks_.front().step;
}

/// The looks since a step, the latest first.
std::vector<ScanHistory::Visit> ScanHistory::wayTo(const TPose2D& pose, std::uint64_t since,
                                                   const DenseVerifier& verifier) const
{
  Replay way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  for (auto addScan = looks_.rbegin(); addScan != looks_.rend() && addScan->step >= since;
       ++addScan)
  {
    visits.push_back(way.visit(*addScan));
  }
  return visits;
}

/// As (8.5) would have, as far back as the two ways differ; nothing where nothing speaks for the
/// newcomer.
std::optional<ScanHistory::WaySays> ScanHistory::compareWith(const std::vector<Visit>& rival,
                                                             const TPose2D& pose,
                                                             double cost_of_unexplained,
                                                             const DenseVerifier& verifier) const
{
  const double least = std::log(options_.prune_weight);
  Replay way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  LogLikelihoodDeficit sum;
  for (std::size_t k = 0; k < rival.size(); ++k)
  {
    const Look& addScan = lookBack(k);
    const Visit& own = visits.emplace_back(way.visit(addScan));
    if (samePlace(own.pose, rival[k].pose))
    {
      if (sum.smaller() <= kBranches) return {};
      return WaySays{{}, true, {}};
    }
    // The first addScan counts in full, as the first relocation does.
    const bool is_first = k + 1 == rival.size();
    const double travel =
        is_first ? options_.evidence_distance : addScan.travelled - lookBack(k + 1).travelled;
    const auto bounded = [](double lead) { return std::clamp(lead, -kMaxRelative, kMaxRelative); };
    const double detour = own.detour - rival[k].detour;
    sum.by_score += shareBetweenRivals(addScan.scan, travel, options_) *
                    bounded(own.log_likelihood - rival[k].log_likelihood - detour);
    sum.by_cells += bounded(cost_of_unexplained * (rival[k].unexplained - own.unexplained)) -
                    std::min(1.0, travel / options_.evidence_distance) * detour;
    if (sum.smaller() < least) return {};
  }
  return WaySays{sum, false, rememberedOf(visits)};
}

/// What a track that had come this way would remember; the sums count from now on.
CellEvidence ScanHistory::rememberedOf(const std::vector<Visit>& way) const
{
  CellEvidence explained;
  for (std::size_t k = way.size(); k-- > 0;)
  {
    explained.addScan(lookBack(k).view, way[k].explained, lookBack(k).travelled);
  }
  explained.countAnew();
  return explained;
}

void ScanHistory::weighNewcomers(TrackSet& set, const DenseScan& scan,
                                 const DenseVerifier& verifier, double travelled) const
{
  const auto lighter = [](const Track& a, const Track& b)
  {
    if (a.isNew() != b.isNew()) return a.isNew();
    return a.hypothesis.weight < b.hypothesis.weight;
  };
  if (std::none_of(set.tracks.begin(), set.tracks.end(), std::mem_fn(&Track::isNew))) return;
  const Track& parent = *std::max_element(set.tracks.begin(), set.tracks.end(), lighter);
  const TrackedHypothesis& heaviest = parent.hypothesis;
  const std::uint64_t born = step_ - heaviest.age;
  if (parent.isNew() || born < known_since_) return;
  const std::vector<Visit> rival = wayTo(heaviest.pose.mean, born, verifier);
  if (rival.empty()) return;
  for (Track& track : set.tracks)
  {
    if (!track.isNew()) continue;
    auto way = compareWith(rival, track.hypothesis.pose.mean, set.costOfUnexplained(), verifier);
    if (!way) continue;
    track.deficit = parent.deficit + way->sum;
    if (way->branched)
    {
      track.inherit(parent);
    }
    else
    {
      track.explained = std::move(way->explained);
      set.showTo(track, scan, verifier, travelled);
    }
    double& weight = track.hypothesis.weight;
    weight = std::max(weight, heaviest.weight * std::exp(std::min(0.0, way->sum.smaller())));
  }
  set.normaliseTracks();
}
}  // namespace sigloc
