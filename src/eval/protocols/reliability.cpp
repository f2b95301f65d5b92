// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/reliability.h"

#include <mrpt/math/wrap2pi.h>

#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "eval/data/evaluation_data.h"
#include "eval/data/occupancy_grid.h"
#include "eval/methods/particles/scan_reliability.h"
#include "eval/worlds/robot_simulation.h"
#include "eval/worlds/simulation_files.h"
#include "eval/worlds/world_generators.h"
#include "matching/candidate_probabilities.h"
#include "matching/dense/DenseVerifier.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/matching/SignatureMatcher.h"

namespace sigloc
{
namespace
{
using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;

constexpr double kMapSpacing = 1.2;  // [m] between the mapping scans
constexpr std::size_t kBeams = 180;  // that a tracker scores a pose with
constexpr double kTrackSigma = 0.05;  // [m] of a pose that a tracker predicts
constexpr double kTrackTurnSigma = 0.02;  // [rad]
constexpr int kRefineSteps = 6;
constexpr std::uint64_t kPoseStream = 600;  // of the random numbers, see Random

/// One simulated building with its map, and the queries of scans in it.
class MappedWorld
{
 public:
  MappedWorld(WorldKind kind, std::uint64_t seed)
      : world_(makeWorld(kind, {}, seed)),
        space_(world_, kRobotClearance),
        map_(evaluationMapFromScans(
            simulateMapping(world_, kMapSpacing, kRobotClearance, LaserOptions(), seed))),
        matcher_(map_.features),
        grid_(detail::occupancyGridOf(rasterOf(*map_.features->field()))),
        random_(seed, kPoseStream)
  {
  }

  /// A scan judged at its own pose and at a look-alike; none where there is no look-alike.
  std::optional<std::pair<ReliabilityCase, ReliabilityCase>> ask(double clutter);

 private:
  std::vector<TPose2D> lookAlikes(const ObservedScene& scene, const DenseScan& dense,
                                  const TPose2D& truth) const;
  ReliabilityCase judge(const LaserScan& scan, const DenseScan& dense, const TPose2D& pose,
                        const TPose2D& truth) const;

  World world_;
  FreeSpace space_;
  EvaluationMap map_;
  SignatureMatcher matcher_;
  COccupancyGridMap2D::Ptr grid_;
  Random random_;
};

std::optional<std::pair<ReliabilityCase, ReliabilityCase>> MappedWorld::ask(double clutter)
{
  LaserOptions laser;
  laser.clutter_share = clutter;
  const auto place = space_.randomPlace(random_);
  const TPose2D truth(place.x, place.y, random_.uniform(-M_PI, M_PI));
  const LaserScan scan = LaserSimulator(world_, laser).scan(truth, random_);
  const TPose2D predicted(truth.x + kTrackSigma * random_.normal(),
                          truth.y + kTrackSigma * random_.normal(),
                          mrpt::math::wrapToPi(truth.phi + kTrackTurnSigma * random_.normal()));
  const ObservedScene scene = observeScene({scan});
  const DenseScan dense = makeDenseScan(scene, kBeams);

  const std::vector<TPose2D> look_alikes = lookAlikes(scene, dense, truth);
  if (look_alikes.empty()) return std::nullopt;
  const std::size_t chosen = random_.index(look_alikes.size());
  const TPose2D refined = matcher_.verifier()->refine(dense, predicted, kRefineSteps, dense.size());
  auto right = judge(scan, dense, refined, truth);
  auto wrong = judge(scan, dense, look_alikes[chosen], truth);
  if (!isRight(right.error, {})) return std::nullopt;
  right.right = true;
  right.clutter = wrong.clutter = clutter;
  return std::make_pair(right, wrong);
}

/// The best of all poses that are proposed and wrong. What relocation lists would be too few, for
/// it stops where a pose is clear.
std::vector<TPose2D> MappedWorld::lookAlikes(const ObservedScene& scene, const DenseScan& dense,
                                             const TPose2D& truth) const
{
  constexpr std::size_t kMost = 10;
  const auto is_wrong = [&](const TPose2D& pose)
  { return judgeClaim(errorBetween(pose, truth), {}) == Claim::wrong; };
  std::vector<PoseProposal> wrong;
  for (const TPose2D& pose : matcher_.propose(scene))
  {
    if (!is_wrong(pose)) continue;
    wrong.push_back(
        {static_cast<float>(pose.x), static_cast<float>(pose.y), static_cast<float>(pose.phi)});
  }
  MatchingCounters counters;
  std::vector<TPose2D> poses;
  for (const RankedPose& ranked : matcher_.verifier()->rank(dense, wrong, kMost, counters))
  {
    if (is_wrong(ranked.pose)) poses.push_back(ranked.pose);
  }
  return poses;
}

ReliabilityCase MappedWorld::judge(const LaserScan& scan, const DenseScan& dense,
                                   const TPose2D& pose, const TPose2D& truth) const
{
  const DenseVerifier& verifier = *matcher_.verifier();
  ReliabilityCase judged;
  judged.error = errorBetween(pose, truth);
  judged.signature = reliabilityOf(verifier.evaluate(dense, pose));
  judged.mrpt = scanReliability(
      *grid_, *toRangeScan(scan, 0),
      withCommonError({pose, verifier.covarianceAt(dense, pose)}, map_.features->error()));
  return judged;
}
}  // namespace

ReliabilityReport runReliability(const ReliabilityOptions& options)
{
  if (options.worlds == 0 || options.poses == 0 || options.clutter.empty())
  {
    throw std::invalid_argument("reliability needs worlds, poses and shares of clutter");
  }
  constexpr WorldKind kKinds[] = {WorldKind::office, WorldKind::corridor, WorldKind::hall};
  std::vector<std::vector<ReliabilityCase>> of_world(options.worlds);
  std::atomic<std::size_t> skipped{0};
  runParallel(
      options.worlds, options.threads,
      [&](std::size_t i)
      {
        MappedWorld world(kKinds[i % std::size(kKinds)], options.seed * 1000003U + i);
        for (const double clutter : options.clutter)
        {
          for (std::uint32_t k = 0; k < options.poses; ++k)
          {
            const auto pair = world.ask(clutter);
            if (!pair) ++skipped;
            if (!pair) continue;
            of_world[i].push_back(pair->first);
            of_world[i].push_back(pair->second);
          }
        }
        for (ReliabilityCase& judged : of_world[i]) judged.world = i;
      },
      "worlds", options.progress);
  ReliabilityReport report;
  for (const auto& cases : of_world)
  {
    report.cases.insert(report.cases.end(), cases.begin(), cases.end());
  }
  report.skipped = skipped;
  report.provenance = {options.command, options.seed, {}};
  return report;
}
}  // namespace sigloc
