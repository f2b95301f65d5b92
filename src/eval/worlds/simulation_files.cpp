// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/worlds/simulation_files.h"

#include <fmt/core.h>
#include <mrpt/core/Clock.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "eval/worlds/motion_model.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using mrpt::serialization::CArchive;
constexpr const char* kNote = "README.md";
constexpr const char* kNoteHead = "# A simulated world\n\nMade by\n\n    ";

mrpt::obs::CObservationBearingRange::Ptr toBearingRange(const std::vector<Feature>& landmarks,
                                                        double time)
{
  auto out = mrpt::obs::CObservationBearingRange::Create();
  out->timestamp = mrpt::Clock::fromDouble(time);
  out->sensorLabel = "LANDMARKS";
  out->fieldOfView_yaw = static_cast<float>(2 * M_PI);
  out->fieldOfView_pitch = 0;
  out->validCovariances = true;
  for (const Feature& landmark : landmarks)
  {
    const double range = std::hypot(landmark.position.x, landmark.position.y);
    const double variance = landmark.position_covariance(0, 0);
    mrpt::obs::CObservationBearingRange::TMeasurement measurement;
    measurement.range = static_cast<float>(range);
    measurement.yaw = static_cast<float>(std::atan2(landmark.position.y, landmark.position.x));
    measurement.pitch = 0;
    measurement.landmarkID = -1;
    measurement.covariance.setZero();
    measurement.covariance(0, 0) = variance;
    measurement.covariance(1, 1) = variance / std::max(1e-6, range * range);
    measurement.covariance(2, 2) = 1e-6;
    out->sensedData.push_back(measurement);
  }
  return out;
}

/// The observations of a step, as MRPT's classes.
mrpt::obs::CSensoryFrame frameOf(const DriveStep& step)
{
  mrpt::obs::CSensoryFrame frame;
  if (step.scan) frame.insert(toRangeScan(*step.scan, step.time));
  if (!step.landmarks.empty()) frame.insert(toBearingRange(step.landmarks, step.time));
  return frame;
}

/// Returns the box around worlds in the frame of the map.
Bounds boundsOf(const std::vector<PlacedWorld>& worlds)
{
  Bounds all{1e12, -1e12, 1e12, -1e12};
  for (const auto& [world, origin] : worlds)
  {
    all.x_min = std::min(all.x_min, origin.x + world.bounds.x_min);
    all.x_max = std::max(all.x_max, origin.x + world.bounds.x_max);
    all.y_min = std::min(all.y_min, origin.y + world.bounds.y_min);
    all.y_max = std::max(all.y_max, origin.y + world.bounds.y_max);
  }
  return all;
}

/// Sets the cells that a robot of no size reaches.
void drawFreeSpace(const PlacedWorld& placed, double resolution,
                   mrpt::maps::COccupancyGridMap2D& grid)
{
  constexpr float kFree = 0.99F;
  const FreeSpace space(placed.world, 0.0, resolution);
  // Free space ends up to a cell before a surface; the cells between are free unless drawn over.
  const auto near_free_space = [&](double x, double y)
  {
    return space.contains({x, y}) || space.contains({x - resolution, y}) ||
           space.contains({x + resolution, y}) || space.contains({x, y - resolution}) ||
           space.contains({x, y + resolution});
  };
  const Bounds b = boundsOf({placed});
  const auto column_of = [&](double x) { return grid.x2idx(static_cast<float>(x)); };
  const auto row_of = [&](double y) { return grid.y2idx(static_cast<float>(y)); };
  for (int row = row_of(b.y_min) - 2; row <= row_of(b.y_max) + 2; ++row)
  {
    for (int column = column_of(b.x_min) - 2; column <= column_of(b.x_max) + 2; ++column)
    {
      const double x = grid.idx2x(column) - placed.origin.x;
      const double y = grid.idx2y(row) - placed.origin.y;
      if (near_free_space(x, y)) grid.setCell(column, row, kFree);
    }
  }
}

/// Sets every cell that a surface runs through.
void drawSurfaces(const PlacedWorld& placed, mrpt::maps::COccupancyGridMap2D& grid)
{
  constexpr float kOccupied = 0.01F;
  const auto& [world, origin] = placed;
  const double stride = 0.25 * static_cast<double>(grid.getResolution());
  const auto mark = [&, o = origin](double x, double y)
  { grid.setPos(static_cast<float>(o.x + x), static_cast<float>(o.y + y), kOccupied); };
  for (const WallSegment& segment : visibleSegments(world))
  {
    const auto along = segment.end - segment.start;
    const int steps = static_cast<int>(std::hypot(along.x, along.y) / stride) + 1;
    for (int i = 0; i <= steps; ++i)
    {
      const auto p = segment.start + along * (static_cast<double>(i) / steps);
      mark(p.x, p.y);
    }
  }
  for (const Disc& disc : world.discs)
  {
    const int steps = static_cast<int>(2 * M_PI * disc.radius / stride) + 1;
    for (int i = 0; i < steps; ++i)
    {
      const double angle = 2 * M_PI * i / steps;
      mark(disc.centre.x + disc.radius * std::cos(angle),
           disc.centre.y + disc.radius * std::sin(angle));
    }
  }
}
}  // namespace

void writeSimpleMap(const std::vector<PosedScans>& scans, const fs::path& path)
{
  constexpr double kPoseSigma = 0.001;  // [m], [rad]
  mrpt::maps::CSimpleMap map;
  double time = kSimulationEpoch;
  for (const PosedScans& key_frame : scans)
  {
    auto pose = mrpt::poses::CPose3DPDFGaussian::Create();
    pose->mean = mrpt::poses::CPose3D(mrpt::poses::CPose2D(key_frame.map_from_robot));
    pose->cov.setIdentity();
    pose->cov *= kPoseSigma * kPoseSigma;
    auto frame = mrpt::obs::CSensoryFrame::Create();
    for (const LaserScan& scan : key_frame.scans) frame->insert(toRangeScan(scan, time));
    map.insert(pose, frame);
    time += 1.0;
  }
  writeObjects(
      path, [&](CArchive& archive) { archive << map; }, Packing::small_gzip);
}

void writeGridMap(const World& world, double resolution, const fs::path& path)
{
  writeGridMap(std::vector<PlacedWorld>{{world, {0, 0}}}, resolution, path);
}

void writeGridMap(const std::vector<PlacedWorld>& worlds, double resolution, const fs::path& path)
{
  if (!(resolution >= 0.005 && resolution <= 1))
  {
    throw std::invalid_argument("the resolution of a grid map must lie in [0.005, 1] m");
  }
  constexpr double kMargin = 0.5;  // [m] of unknown around the worlds
  const Bounds b = boundsOf(worlds);
  mrpt::maps::COccupancyGridMap2D grid;
  grid.setSize(static_cast<float>(b.x_min - kMargin), static_cast<float>(b.x_max + kMargin),
               static_cast<float>(b.y_min - kMargin), static_cast<float>(b.y_max + kMargin),
               static_cast<float>(resolution), 0.5F);
  for (const PlacedWorld& placed : worlds)
  {
    drawFreeSpace(placed, resolution, grid);
    drawSurfaces(placed, grid);
  }
  writeObjects(
      path, [&](CArchive& archive) { archive << grid; }, Packing::small_gzip);
}

void writeRawlog(const std::vector<DriveStep>& steps, const OdometryOptions& odometry,
                 RawlogKind kind, const fs::path& path)
{
  const auto write = [&](CArchive& archive)
  {
    for (const DriveStep& step : steps)
    {
      const auto time = mrpt::Clock::fromDouble(step.time);
      if (kind == RawlogKind::action_frame)
      {
        auto action = odometryAction(step.motion.mean, odometry);
        action.timestamp = time;
        mrpt::obs::CActionCollection actions;
        actions.insert(action);
        archive << actions << frameOf(step);
        continue;
      }
      mrpt::obs::CObservationOdometry reading;
      reading.timestamp = time;
      reading.sensorLabel = "ODOMETRY";
      reading.odometry = mrpt::poses::CPose2D(step.odometry);
      archive << reading;
      for (const auto& observation : frameOf(step)) archive << *observation;
    }
  };
  writeObjects(path, write, Packing::small_gzip);
}

void checkSimulationFolder(const fs::path& folder)
{
  static const std::set<std::string> kNames = {
      "map.simplemap", "map.gridmap.gz",    "map.txt", "drive.rawlog",
      "truth.txt",     "queries.simplemap", kNote};
  const auto writes = [](const std::string& name) { return kNames.count(name) > 0; };
  const auto is_own = [](const fs::path& path)
  {
    std::ifstream note(path / kNote);
    const std::string text{std::istreambuf_iterator<char>(note), {}};
    return text.rfind(kNoteHead, 0) == 0;
  };
  checkOutputFolder(folder, {writes, is_own, "sigloc-simulate"}, {});
}

void writeSimulationNote(const std::string& command, const std::string& files,
                         const fs::path& folder)
{
  writeFile(folder / kNote,
            kNoteHead + command +
                "\n\nwhich gives the same bytes each time. Lengths are in metres, angles in "
                "radians.\n\n" +
                files);
}

void writeTruth(const std::vector<DriveStep>& steps, const fs::path& path)
{
  std::string text;
  for (const DriveStep& step : steps)
  {
    const auto& pose = step.world_from_robot;
    text += fmt::format("{:.3f} {:.6f} {:.6f} {:.6f}\n", step.time, pose.x, pose.y, pose.phi);
  }
  writeFile(path, text);
}

void writeLandmarks(const std::vector<Feature>& landmarks, const fs::path& path)
{
  std::string text;
  for (const Feature& landmark : landmarks)
  {
    text += fmt::format("{:.4f} {:.4f} {:.3f} {:.4f}\n", landmark.position.x, landmark.position.y,
                        landmark.size, std::sqrt(landmark.position_covariance(0, 0)));
  }
  writeFile(path, text);
}
}  // namespace sigloc
