// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/ScanHistory.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

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
constexpr double kWaySigma = 0.1;  // [m] that a look may be off the way that odometry tells
constexpr double kWayTurnSigma = 0.05;  // [rad]
constexpr double kBranches = 0.5;  // log-odds for a slip: less may be chance
}  // namespace

/// A robot that goes back the way it came, and at each look stands where that fits best.
class PastScans::WayBack
{
 public:
  WayBack(const TPose2D& pose, const TPose2D& odometry, const DenseVerifier& verifier)
      : pose_(pose), odometry_(odometry), verifier_(verifier)
  {
  }

  Visit visit(const Look& look)
  {
    const TPose2D told = pose_ + (look.odometry - odometry_);
    pose_ = verifier_.refine(look.scan, told, kSteps, look.scan.size());
    odometry_ = look.odometry;
    const double off = std::hypot(pose_.x - told.x, pose_.y - told.y) / kWaySigma;
    const double turned = wrapToPi(pose_.phi - told.phi) / kWayTurnSigma;
    const double detour = std::min(kMaxRelative, 0.5 * (off * off + turned * turned));
    auto explained = verifier_.explainedReturns(look.scan, pose_);
    const double unexplained = explained_.look(look.view, explained, -look.travelled);
    return {pose_, logLikelihoodOfScore(verifier_.evaluate(look.scan, pose_).score), unexplained,
            detour, std::move(explained)};
  }

 private:
  ExplainedStructure explained_;
  TPose2D pose_;
  TPose2D odometry_;
  const DenseVerifier& verifier_;
};

void PastScans::move(const std::optional<MotionIncrement>& motion)
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

void PastScans::remember(const DenseScan& scan, double travelled)
{
  if (step_ < known_since_) return;
  if (!looks_.empty() && travelled < looks_.back().travelled + kSpacing) return;
  looks_.push_back({scan, viewOf(scan, odometry_), odometry_, travelled, step_});
  if (looks_.size() <= kMostLooks) return;
  looks_.pop_front();
  known_since_ = looks_.front().step;
}

/// The looks since a step, the latest first.
std::vector<PastScans::Visit> PastScans::wayTo(const TPose2D& pose, std::uint64_t since,
                                               const DenseVerifier& verifier) const
{
  WayBack way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  for (auto look = looks_.rbegin(); look != looks_.rend() && look->step >= since; ++look)
  {
    visits.push_back(way.visit(*look));
  }
  return visits;
}

/// As (8.5) would have, as far back as the two ways differ; nothing where nothing speaks for the
/// newcomer.
std::optional<PastScans::WaySays> PastScans::compareWith(const std::vector<Visit>& rival,
                                                         const TPose2D& pose,
                                                         double cost_of_unexplained,
                                                         const DenseVerifier& verifier) const
{
  const double least = std::log(options_.prune_weight);
  WayBack way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  RivalEvidence sum;
  for (std::size_t k = 0; k < rival.size(); ++k)
  {
    const Look& look = lookBack(k);
    const Visit& own = visits.emplace_back(way.visit(look));
    if (isSamePlace(own.pose, rival[k].pose))
    {
      if (sum.told() <= kBranches) return {};
      return WaySays{{}, true, {}};
    }
    // The first look counts in full, as the first relocation does.
    const bool is_first = k + 1 == rival.size();
    const double travel =
        is_first ? options_.evidence_distance : look.travelled - lookBack(k + 1).travelled;
    const auto bounded = [](double lead) { return std::clamp(lead, -kMaxRelative, kMaxRelative); };
    const double detour = own.detour - rival[k].detour;
    sum.by_score += shareBetweenRivals(look.scan, travel, options_) *
                    bounded(own.log_likelihood - rival[k].log_likelihood - detour);
    sum.by_ground += bounded(cost_of_unexplained * (rival[k].unexplained - own.unexplained)) -
                     std::min(1.0, travel / options_.evidence_distance) * detour;
    if (sum.told() < least) return {};
  }
  return WaySays{sum, false, rememberedOf(visits)};
}

/// What a track that had come this way would remember; the sums count from now on.
ExplainedStructure PastScans::rememberedOf(const std::vector<Visit>& way) const
{
  ExplainedStructure explained;
  for (std::size_t k = way.size(); k-- > 0;)
  {
    explained.look(lookBack(k).view, way[k].explained, lookBack(k).travelled);
  }
  explained.countAnew();
  return explained;
}

void PastScans::weighNewcomers(TrackSet& set, const DenseScan& scan, const DenseVerifier& verifier,
                               double travelled) const
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
    track.behind = parent.behind + way->sum;
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
    weight = std::max(weight, heaviest.weight * std::exp(std::min(0.0, way->sum.told())));
  }
  set.normaliseTracks();
}
}  // namespace sigloc
