// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracks/ScanHistory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/same_place.h"
#include "matching/candidate_probabilities.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kMaxScans = 60;  // that are stored
constexpr double kSpacing = 0.5;  // [m] of travel between stored scans
constexpr int kSteps = 3;  // of refinement at each stored scan
}  // namespace

/// Replays the stored scans backwards along the odometry. At each scan the pose is refined.
class ScanHistory::Replay
{
 public:
  Replay(const TPose2D& pose, const TPose2D& odometry, const DenseVerifier& verifier)
      : pose_(pose), odometry_(odometry), verifier_(verifier)
  {
  }

  Visit visit(const StoredScan& stored)
  {
    const TPose2D predicted = pose_ + (stored.odometry - odometry_);
    pose_ = verifier_.refine(stored.scan, predicted, kSteps, stored.scan.size());
    odometry_ = stored.odometry;
    const DenseEvidence evidence = verifier_.evaluate(stored.scan, pose_);
    auto explained = verifier_.explainedReturns(stored.scan, pose_, evidence.through);
    const double unexplained = explained_.addScan(stored.view, explained, -stored.travelled);
    return {pose_, logLikelihoodOfScore(evidence.score), unexplained, std::move(explained)};
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
  scans_.clear();
  known_since_ = step_;
}

void ScanHistory::remember(const DenseScan& scan, double travelled)
{
  if (step_ < known_since_) return;
  if (!scans_.empty() && travelled < scans_.back().travelled + kSpacing) return;
  scans_.push_back({scan, observedCells(scan, odometry_), odometry_, travelled, step_});
  if (scans_.size() <= kMaxScans) return;
  scans_.pop_front();
  known_since_ = scans_.front().step;
}

/// Returns what a track at `pose` would have seen at the scans since a step, the latest first.
std::vector<ScanHistory::Visit> ScanHistory::replayFrom(const TPose2D& pose, std::uint64_t since,
                                                        const DenseVerifier& verifier) const
{
  Replay way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  for (auto stored = scans_.rbegin(); stored != scans_.rend() && stored->step >= since; ++stored)
  {
    visits.push_back(way.visit(*stored));
  }
  return visits;
}

/// Sums up the two measures of (8.5) backwards as far as the two ways differ, or until they refute
/// the new track. Returns nothing where the ways meet and they do not favour it. Eq. (8.24)
std::optional<ScanHistory::Comparison> ScanHistory::compareWith(const std::vector<Visit>& rival,
                                                                const TPose2D& pose,
                                                                double cost_of_unexplained,
                                                                const DenseVerifier& verifier) const
{
  Replay way(pose, odometry_, verifier);
  std::vector<Visit> visits;
  LogLikelihoodDeficit sum;
  for (std::size_t k = 0; k < rival.size(); ++k)
  {
    const StoredScan& stored = storedScan(k);
    const Visit& own = visits.emplace_back(way.visit(stored));
    if (samePlace(own.pose, rival[k].pose))
    {
      if (sum.smaller() <= 0) return {};
      return Comparison{{}, true, {}};
    }
    // The first scan counts in full, as the first relocation does.
    const bool is_first = k + 1 == rival.size();
    const double travel =
        is_first ? options_.evidence_distance : stored.travelled - storedScan(k + 1).travelled;
    sum.by_score +=
        shareBetweenRivals(travel, options_) * (own.log_likelihood - rival[k].log_likelihood);
    sum.by_cells += cost_of_unexplained * (rival[k].unexplained - own.unexplained);
    if (refutes(sum)) return Comparison{sum, false, {}};
  }
  return Comparison{sum, false, rememberedOf(visits)};
}

bool ScanHistory::refutes(const LogLikelihoodDeficit& sum) const
{
  return sum.smaller() < std::log(options_.prune_weight);
}

/// Returns the cell evidence of a track that had come this way, with its sums set back to 0.
CellEvidence ScanHistory::rememberedOf(const std::vector<Visit>& way) const
{
  CellEvidence explained;
  for (std::size_t k = way.size(); k-- > 0;)
  {
    explained.addScan(storedScan(k).view, way[k].explained, storedScan(k).travelled);
  }
  explained.countAnew();
  return explained;
}

void ScanHistory::weighNewTracksAgainstOlder(TrackSet& set, const DenseScan& scan,
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
  const std::vector<Visit> rival = replayFrom(heaviest.pose.mean, born, verifier);
  if (rival.empty()) return;
  // Only a robot that was carried away can be where it cannot have driven to, and that shows.
  const bool drove = parent.retained(sureLogOdds(options_)) && !set.isSuspicious();
  for (Track& track : set.tracks)
  {
    if (!track.isNew()) continue;
    auto way = compareWith(rival, track.hypothesis.pose.mean, set.costOfUnexplained(), verifier);
    if (!way) continue;
    if (refutes(way->sum))
    {
      if (drove) track.hypothesis.weight = 0;
      continue;
    }
    track.deficit = parent.deficit + way->sum;
    if (way->branched)
    {
      track.inherit(parent);
    }
    else
    {
      track.explained = std::move(way->explained);
      set.addToCellEvidence(track, scan, verifier, travelled);
    }
    double& weight = track.hypothesis.weight;
    weight = std::max(weight, heaviest.weight * std::exp(std::min(0.0, way->sum.smaller())));
  }
  set.normaliseTracks();
}
}  // namespace sigloc
