// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PastScans.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sigloc/matching/weighing.h"

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
    const auto explained = verifier_.explainedReturns(look.scan, pose_);
    return {pose_, logLikelihoodOfScore(verifier_.evaluate(look.scan, pose_).score),
            explained_.look(look.view, explained, -look.travelled), detour};
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

/// As (8.5) would have, as far back as the two ways differ.
PastScans::WaySays PastScans::compareWith(const std::vector<Visit>& rival, const TPose2D& pose,
                                          double cost_of_unexplained,
                                          const DenseVerifier& verifier) const
{
  constexpr WaySays kNothing = {-std::numeric_limits<double>::infinity()};
  const double least = std::log(options_.prune_weight);
  WayBack way(pose, odometry_, verifier);
  RivalEvidence sum;
  for (std::size_t k = 0; k < rival.size(); ++k)
  {
    const Look& look = lookBack(k);
    const Visit own = way.visit(look);
    if (isSamePlace(own.pose, rival[k].pose))
    {
      return sum.told() > kBranches ? WaySays{0, true} : kNothing;
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
    if (sum.told() < least) return kNothing;
  }
  return {sum.told()};
}

void PastScans::weighNewcomers(TrackSet& set, const DenseVerifier& verifier) const
{
  const auto is_new = [](const Track& track) { return track.hypothesis.age == 0; };
  const auto lighter = [&](const Track& a, const Track& b)
  {
    if (is_new(a) != is_new(b)) return is_new(a);
    return a.hypothesis.weight < b.hypothesis.weight;
  };
  if (std::none_of(set.tracks.begin(), set.tracks.end(), is_new)) return;
  const Track parent = *std::max_element(set.tracks.begin(), set.tracks.end(), lighter);
  const TrackedHypothesis& heaviest = parent.hypothesis;
  const std::uint64_t born = step_ - heaviest.age;
  if (heaviest.age == 0 || born < known_since_) return;
  const std::vector<Visit> rival = wayTo(heaviest.pose.mean, born, verifier);
  if (rival.empty()) return;
  for (Track& track : set.tracks)
  {
    if (!is_new(track)) continue;
    const WaySays way =
        compareWith(rival, track.hypothesis.pose.mean, set.costOfUnexplained(), verifier);
    if (way.branched) track.inherit(parent);
    double& weight = track.hypothesis.weight;
    weight = std::max(weight, heaviest.weight * std::exp(std::min(0.0, way.log_odds)));
  }
  set.normaliseTracks();
}
}  // namespace sigloc
