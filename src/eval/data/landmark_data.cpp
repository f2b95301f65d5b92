// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/landmark_data.h"

#include <fmt/core.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string_view>

#include "geometry/pose_fusion.h"
#include "geometry/symmetric_matrix.h"
#include "io/text_rows.h"
#include "sigloc/features/observe_scans.h"

namespace sigloc
{
namespace
{
using Row = std::vector<double>;

/// The numbers of a line. Throws std::runtime_error "path: line N: reason" for a word that is none
/// and for fewer than `least`.
Row numbersOf(const std::vector<std::string_view>& cells, std::size_t least,
              const std::filesystem::path& path, std::size_t line)
{
  Row row;
  row.reserve(cells.size());
  for (const std::string_view cell : cells)
  {
    const auto number = detail::toNumber(cell);
    if (!number) detail::failAtLine(path, line, detail::quoted(cell) + " is no number");
    row.push_back(*number);
  }
  if (row.size() < least)
  {
    detail::failAtLine(path, line, fmt::format("{} of {} columns", row.size(), least));
  }
  return row;
}

/// Rows of comma-separated numbers; lines that start with '#' are skipped.
std::vector<Row> readCsv(const std::filesystem::path& path, std::size_t columns)
{
  std::vector<Row> rows;
  for (detail::TextLines lines(path); lines.next();)
  {
    const auto cells = detail::words(lines.line());
    if (cells.empty() || lines.line().front() == '#') continue;
    rows.push_back(numbersOf(cells, columns, path, lines.index()));
  }
  if (rows.empty()) throw std::runtime_error(path.string() + ": holds no rows");
  return rows;
}

Feature placeAt(FeatureType type, double x, double y, double xx, double xy, double yy)
{
  Feature feature;
  feature.type = type;
  feature.position = {x, y};
  feature.position_covariance(0, 0) = xx;
  feature.position_covariance(0, 1) = feature.position_covariance(1, 0) = xy;
  feature.position_covariance(1, 1) = yy;
  return feature;
}

/// x, y, phi, Pxx, Pxy, Pxphi, Pyy, Pyphi, Pphiphi.
MotionIncrement motionOf(const Row& row)
{
  return {{row[0], row[1], row[2]}, toMatrix({row[3], row[4], row[5], row[6], row[7], row[8]})};
}

/// The motion of a point at `lever` [m] of a body that moves by `motion`, both in the body's frame.
MotionIncrement motionAt(const mrpt::math::TPoint2D& lever, const MotionIncrement& motion)
{
  const MotionIncrement arm{{lever.x, lever.y, 0}, mrpt::math::CMatrixDouble33()};
  GaussianPose moved = composeWithMotion({motion.mean, motion.covariance}, arm);
  moved.mean.x -= lever.x;
  moved.mean.y -= lever.y;
  return {moved.mean, moved.covariance};
}

/// Marks steps whose truth has a large covariance or jumps against the odometry. There the filter
/// that estimated it was lost.
void doubtTruth(const std::vector<Row>& truth, std::vector<LandmarkStep>& steps)
{
  constexpr double kMostSigma = 0.5;  // [m]
  constexpr double kMostJump = 0.5;  // [m]
  constexpr double kMostTurn = 5 * M_PI / 180;  // [rad]
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const GaussianPose pose{steps[k].truth, motionOf(truth[k]).covariance};
    if (largestPositionSigma(pose) > kMostSigma) steps[k].truth_sure = false;
    if (k == 0) continue;
    const mrpt::math::TPose2D moved = steps[k].truth - steps[k - 1].truth;
    const mrpt::math::TPose2D& driven = steps[k].motion.mean;
    if (std::hypot(moved.x - driven.x, moved.y - driven.y) > kMostJump ||
        std::abs(mrpt::math::wrapToPi(moved.phi - driven.phi)) > kMostTurn)
    {
      steps[k - 1].truth_sure = steps[k].truth_sure = false;
    }
  }
}

/// The relative part of a map's full covariance. It is a straight line, fitted to near and far
/// pairs: the standard deviation of the distance between two features against that distance.
MapErrorModel relativeError(const std::vector<Feature>& map, const std::vector<Row>& covariance)
{
  constexpr double kNear = 40;  // [m], pairs that are seen together
  double n = 0;
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (std::size_t k = 0; k < map.size(); ++k)
  {
    for (std::size_t l = 0; l < k; ++l)
    {
      const auto between = map[l].position - map[k].position;
      const double distance = between.norm();
      if (distance > kNear || distance < 1e-6) continue;
      const double unit[2] = {between.x / distance, between.y / distance};
      double variance = 0;
      for (std::size_t a = 0; a < 2; ++a)
      {
        for (std::size_t b = 0; b < 2; ++b)
        {
          const double relative =
              covariance[2 * k + a][2 * k + b] + covariance[2 * l + a][2 * l + b] -
              covariance[2 * k + a][2 * l + b] - covariance[2 * l + a][2 * k + b];
          variance += unit[a] * unit[b] * relative;
        }
      }
      const double sigma = std::sqrt(std::max(0.0, variance));
      n += 1;
      sx += distance;
      sy += sigma;
      sxx += distance * distance;
      sxy += distance * sigma;
    }
  }
  MapErrorModel error;
  if (n < 2) return error;
  error.relative_slope = std::max(0.0, (n * sxy - sx * sy) / (n * sxx - sx * sx));
  error.relative_constant = std::max(0.01, (sy - error.relative_slope * sx) / n);
  return error;
}
/// The steps of a log of circles: lines `STEP image x y phi covariance[6]`, each followed by the
/// observations of that step, `LANDMARK_C x y quality covariance[3] [identity]`; other lines are
/// ignored.
std::vector<LandmarkStep> readCircles(const std::filesystem::path& path)
{
  std::vector<LandmarkStep> steps;
  for (detail::TextLines lines(path); lines.next();)
  {
    const std::size_t i = lines.index();
    std::vector<std::string_view> cells = detail::words(lines.line());
    if (cells.empty()) continue;
    if (cells[0] == "STEP")
    {
      const auto header = static_cast<std::ptrdiff_t>(std::min<std::size_t>(2, cells.size()));
      cells.erase(cells.begin(), cells.begin() + header);
      const Row row = numbersOf(cells, 9, path, i);
      // Here the covariance is xx, xy, yy, xt, yt, tt.
      steps.emplace_back();
      steps.back().motion = {{row[0], row[1], row[2]},
                             toMatrix({row[3], row[4], row[6], row[5], row[7], row[8]})};
    }
    else if (cells[0] == "LANDMARK_C")
    {
      if (steps.empty()) detail::failAtLine(path, i, "a landmark before the first STEP");
      cells.erase(cells.begin());
      const Row row = numbersOf(cells, 6, path, i);
      steps.back().observed.push_back(
          placeAt(FeatureType::point, row[0], row[1], row[3], row[4], row[5]));
      steps.back().identities.push_back(row.size() > 6 ? static_cast<int>(row[6]) : -1);
    }
  }
  if (steps.empty()) throw std::runtime_error(path.string() + ": holds no STEP");
  return steps;
}
}  // namespace

LandmarkData readDlr(const std::filesystem::path& folder)
{
  LandmarkData data;
  data.files = {folder / "map.circles", folder / "dlr_ls_poses.csv",
                folder / "dlr_ls_landmarks.csv"};
  data.steps = readCircles(data.files[0]);
  const std::vector<Row> poses = readCsv(data.files[1], 4);
  // Pose k + 1 is the one after step k.
  data.steps.resize(std::min(data.steps.size(), poses.size()));
  for (std::size_t k = 0; k < data.steps.size(); ++k)
  {
    data.steps[k].truth = {poses[k][1], poses[k][2], poses[k][3]};
  }
  constexpr double kFit = 0.069;  // [m], RMS of the map against the observations
  for (const Row& row : readCsv(data.files[2], 3))
  {
    data.map.push_back(
        placeAt(FeatureType::point, row[1], row[2], 0.25 * kFit * kFit, 0, 0.25 * kFit * kFit));
  }
  return data;
}

LandmarkData readVictoriaPark(const std::filesystem::path& folder)
{
  LandmarkData data;
  data.files = {folder / "map_trees.csv", folder / "map_P_290x290.csv", folder / "scans_361_cm.csv",
                folder / "vehicle_ground.csv", folder / "vehicle_motion.csv"};
  constexpr double kSurvey = 0.03;  // [m], of a tree beside its neighbours
  for (const Row& row : readCsv(data.files[0], 5))
  {
    Feature tree =
        placeAt(FeatureType::circle, row[1], row[2], kSurvey * kSurvey, 0, kSurvey * kSurvey);
    // The column called radius holds diameters. For nearby trunks, whose width is measured best, it
    // is 1.9 times half that width.
    tree.size = 0.5 * row[3];
    tree.size_variance = 0.25 * row[4];
    data.map.push_back(tree);
  }
  const std::vector<Row> covariance = readCsv(data.files[1], 2 * data.map.size());
  if (covariance.size() < 2 * data.map.size())
  {
    throw std::runtime_error(fmt::format("{}: {} rows, not two for each of the {} trees",
                                         data.files[1].string(), covariance.size(),
                                         data.map.size()));
  }
  data.map_error = relativeError(data.map, covariance);

  // The motion is that of a point behind the laser, scans and truth are the laser's. The laser's
  // position was found by aligning 800 scans with the ones before; no truth was needed.
  const mrpt::math::TPoint2D laser_from_odometry{2.73, -0.67};  // [m]
  constexpr std::size_t kBeams = 361;
  const std::vector<Row> scans = readCsv(data.files[2], kBeams);
  const std::vector<Row> truth = readCsv(data.files[3], 9);
  const std::vector<Row> motion = readCsv(data.files[4], 9);
  const std::size_t count = std::min({scans.size(), truth.size(), motion.size()});
  for (std::size_t k = 0; k < count; ++k)
  {
    LaserScan scan;
    scan.first_angle = -0.5 * M_PI;
    scan.angle_step = M_PI / 360;
    scan.range_sigma = 0.02;
    scan.max_range = 100;
    for (std::size_t beam = 0; beam < kBeams; ++beam)
    {
      // The log writes 8187 and 8191 for no return. In the open that means free sight. Without it,
      // a trunk has no farther returns on both sides, which distinguish it from part of something
      // larger.
      constexpr double kFreeSight = 80;  // [m]
      const double range = std::min(0.01 * scans[k][beam], kFreeSight);
      scan.ranges.push_back(static_cast<float>(range));
      scan.valid.push_back(range > 0 ? 1 : 0);
    }
    LandmarkStep step;
    step.motion = motionAt(laser_from_odometry, motionOf(motion[k]));
    step.truth = {truth[k][0], truth[k][1], truth[k][2]};
    for (const Feature& feature : observeScene({scan}).features)
    {
      if (feature.type == FeatureType::circle) step.observed.push_back(feature);
    }
    data.steps.push_back(std::move(step));
  }
  doubtTruth(truth, data.steps);
  return data;
}

std::vector<Feature> mapFromSteps(const LandmarkData& data, std::size_t count)
{
  struct Sum
  {
    mrpt::math::TPoint2D position{0, 0};
    Symmetric2 covariance;
    std::uint32_t sightings = 0;
  };
  std::map<int, Sum> sums;
  for (std::size_t k = 0; k < std::min(count, data.steps.size()); ++k)
  {
    const LandmarkStep& step = data.steps[k];
    for (std::size_t o = 0; o < step.identities.size(); ++o)
    {
      if (step.identities[o] < 0) continue;
      const Feature seen = transformed(step.truth, step.observed[o]);
      Sum& sum = sums[step.identities[o]];
      sum.position = sum.position + seen.position;
      sum.covariance.xx += seen.position_covariance(0, 0);
      sum.covariance.xy += seen.position_covariance(0, 1);
      sum.covariance.yy += seen.position_covariance(1, 1);
      ++sum.sightings;
    }
  }
  std::vector<Feature> map;
  for (const auto& [identity, sum] : sums)
  {
    const double share = 1.0 / sum.sightings;
    Feature feature = placeAt(FeatureType::point, sum.position.x * share, sum.position.y * share,
                              sum.covariance.xx * share * share, sum.covariance.xy * share * share,
                              sum.covariance.yy * share * share);
    feature.sightings = sum.sightings;
    map.push_back(feature);
  }
  return map;
}
}  // namespace sigloc
