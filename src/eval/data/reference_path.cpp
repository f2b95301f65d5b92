// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/reference_path.h"

#include <fmt/core.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CICP.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr const char* kHead = "# sigloc-eval reference: time x y phi";

void addPoints(const LaserScan& scan, const TPose2D& frame, mrpt::maps::CSimplePointsMap& points)
{
  const TPose2D frame_from_sensor = frame + scan.robot_from_sensor;
  forEachReturn(scan,
                [&](const mrpt::math::TPoint2D& end)
                {
                  const auto point = frame_from_sensor.composePoint(end);
                  points.insertPoint(static_cast<float>(point.x), static_cast<float>(point.y));
                });
}

mrpt::maps::CSimplePointsMap mapPoints(const std::filesystem::path& path,
                                       const ReadingOptions& reading)
{
  const MapSource source = readMapSource(path, reading);
  const auto* scans = std::get_if<std::vector<PosedScans>>(&source);
  if (!scans) throw std::runtime_error(path.string() + ": holds no scans with poses");
  mrpt::maps::CSimplePointsMap points;
  for (const PosedScans& posed : *scans)
  {
    for (const LaserScan& scan : posed.scans) addPoints(scan, posed.map_from_robot, points);
  }
  return points;
}

std::vector<RawlogStep> readSteps(const std::filesystem::path& path, const ReadingOptions& reading)
{
  std::vector<RawlogStep> steps;
  RawlogReader reader(path, reading);
  while (auto step = reader.next())
  {
    if (step->scans.empty()) continue;
    if (!steps.empty() && !step->motion)
    {
      throw std::runtime_error(path.string() + ": has no odometry to follow");
    }
    steps.push_back(std::move(*step));
  }
  if (reader.truncated())
    throw std::runtime_error(path.string() + ": truncated, its end is missing");
  if (steps.empty()) throw std::runtime_error(path.string() + ": holds no scan");
  return steps;
}

mrpt::slam::CICP alignment()
{
  mrpt::slam::CICP icp;
  icp.options.maxIterations = 200;
  icp.options.thresholdDist = 0.5;  // [m], shrinks as it converges
  icp.options.smallestThresholdDist = 0.05;
  icp.options.thresholdAng = 0.05F;  // [rad]
  icp.options.ALFA = 0.7;
  icp.options.corresponding_points_decimation = 1;
  icp.options.doRANSAC = false;
  return icp;
}
}  // namespace

ReferencePath referencePath(const std::filesystem::path& map, const std::filesystem::path& rawlog,
                            const TPose2D& last, const ReadingOptions& reading)
{
  const mrpt::maps::CSimplePointsMap map_points = mapPoints(map, reading);
  const std::vector<RawlogStep> steps = readSteps(rawlog, reading);
  mrpt::slam::CICP icp = alignment();
  ReferencePath reference;
  reference.poses.resize(steps.size());
  TPose2D guess = last;
  // With less, the scan was aligned outside the mapped area, or at a wrong pose.
  constexpr double kLeastPaired = 0.3;
  for (std::size_t i = steps.size(); i-- > 0;)
  {
    mrpt::maps::CSimplePointsMap seen;
    for (const LaserScan& scan : steps[i].scans) addPoints(scan, {}, seen);
    mrpt::slam::CICP::TReturnInfo info;
    const mrpt::poses::CPosePDFGaussian start{mrpt::poses::CPose2D(guess)};
    const TPose2D found = icp.AlignPDF(&map_points, &seen, start, info)->getMeanVal().asTPose();
    reference.poses[i] = {steps[i].time, found};
    if (info.goodness < kLeastPaired)
    {
      throw std::runtime_error(
          fmt::format("{}: only {:.0f} % of the scan of step {} lie on the map: the last pose is "
                      "wrong, or the way leaves the map",
                      rawlog.string(), 100 * double{info.goodness}, i));
    }
    reference.worst_goodness = std::min(reference.worst_goodness, double{info.goodness});
    // pose(i) = pose(i - 1) + motion(i)
    if (i > 0) guess = found + (TPose2D{} - steps[i].motion->mean);
  }
  return reference;
}

void checkReferenceFile(const std::filesystem::path& path)
{
  std::error_code unnameable;
  if (!std::filesystem::exists(path, unnameable)) return;
  if (std::filesystem::is_directory(path))
    throw std::runtime_error(path.string() + ": is a folder");
  std::string head;
  std::ifstream file(path);
  std::getline(file, head);
  if (head == kHead) return;
  throw std::runtime_error(path.string() +
                           ": exists, and is no reference of an earlier run; not overwritten");
}

void writeReferencePath(const ReferencePath& reference, const std::filesystem::path& path)
{
  std::string text = std::string(kHead) + "\n";
  for (const ReferencePose& pose : reference.poses)
  {
    const TPose2D& p = pose.map_from_robot;
    text += fmt::format("{:.6f} {:.4f} {:.4f} {:.5f}\n", pose.time, p.x, p.y, p.phi);
  }
  writeFile(path, text);
}
}  // namespace sigloc
