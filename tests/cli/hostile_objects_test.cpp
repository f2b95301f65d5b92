// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// MRPT's objects with hostile values: grid maps, key frames and logs. Their files are whole.
#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "bridge/room_map.h"
#include "command_line.h"
#include "sigloc/plugin/ObservationSignatures.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using mrpt::serialization::CSerializable;

constexpr std::uint32_t kAll = 0xFFFFFFFFU;

std::string bytesOf(const CSerializable& object)
{
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << object;
  return {static_cast<const char*>(memory.getRawBufferData()),
          static_cast<std::size_t>(memory.getTotalBytesCount())};
}

/// Writes a value over the bytes that lie `offset` behind the nth mention of a class's name.
template <class T>
void put(std::string& bytes, const std::string& name, std::size_t offset, T value,
         std::size_t mention = 1)
{
  std::size_t at = 0;
  for (; mention > 0; --mention) at = bytes.find(name, at) + name.size();
  ASSERT_LE(at + offset + sizeof(T), bytes.size());
  std::memcpy(bytes.data() + at + offset, &value, sizeof(T));
}

/// Puts a value where an object's last one is, before its end mark.
template <class T>
void putBeforeEnd(std::string& bytes, T value)
{
  std::memcpy(&bytes[bytes.size() - 1 - sizeof(T)], &value, sizeof(T));
}

std::string gridBytes()
{
  mrpt::maps::COccupancyGridMap2D grid(-2, 2, -2, 2, 0.05F);
  constexpr int kFirst = 10, kLast = 70;  // cells of a room's walls
  for (int x = kFirst; x <= kLast; ++x)
  {
    for (int y = kFirst; y <= kLast; ++y)
    {
      const bool wall = x == kFirst || x == kLast || y == kFirst || y == kLast;
      grid.setCell(x, y, wall ? 0.05F : 0.95F);
    }
  }
  return bytesOf(grid);
}

std::string simplemapBytes()
{
  mrpt::maps::CSimpleMap map;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(roomScan({0, 0, 0}));
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  map.insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  return bytesOf(map);
}

mrpt::obs::CActionRobotMovement2D drawnMovement()
{
  mrpt::obs::CActionRobotMovement2D movement;
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
  options.modelSelection = mrpt::obs::CActionRobotMovement2D::mmThrun;
  movement.computeFromOdometry({0.1, 0.2, 0.3}, options);
  return movement;
}

template <class Distribution>
mrpt::obs::CActionRobotMovement2D matchedMovement(std::shared_ptr<Distribution> change)
{
  mrpt::obs::CActionRobotMovement2D movement;
  movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
  movement.poseChange = std::move(change);
  return movement;
}

std::string actionBytes(const mrpt::obs::CActionRobotMovement2D& movement)
{
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return bytesOf(actions);
}

std::string signatureBytes()
{
  return bytesOf(ObservationSignatures(*roomScan({0, 0, 0}), FeatureExtractorOptions{}));
}

std::string noReturnBytes()
{
  ObservationSignatures seen(*roomScan({0, 0, 0}), FeatureExtractorOptions{});
  seen.returns.clear();
  return bytesOf(seen);
}

struct HostileObject
{
  const char* name;  // of the file
  std::function<std::string()> sound;
  std::function<void(std::string&)> spoil;
  const char* reason = "truncated or damaged";
};

// Where values lie behind the name of their class: its version comes first, a byte.
constexpr std::size_t kGridWidth = 2, kGridHeight = 6, kGridXMin = 10, kGridXMax = 14,
                      kGridResolution = 26;

std::vector<HostileObject> hostileMapObjects()
{
  using S = std::string;
  const S grid = "COccupancyGridMap2D";
  const S key_frames = "CSimpleMap";
  return {
      {"bits.gridmap", gridBytes, [=](S& b) { put<std::uint8_t>(b, grid, 1, 3); }},
      {"no_cells.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridWidth, 0U); },
       "a raster of 0 x 80 cells"},
      {"all_cells.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridHeight, kAll); },
       "a raster of 80 x 4294967295"},
      {"reach.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridXMax, 1e30F); },
       "a raster of 80 x 80 cells that spans"},
      {"wider.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridXMax, 4000.F); },
       "a raster of 80 x 80 cells that spans"},
      {"nan.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridXMin, kFloatNan); }, "reaches (nan"},
      {"fine.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridResolution, 1e-30F); },
       "cells of 1e-30 m"},
      {"zero.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridResolution, 0.F); },
       "cells of 0 m"},
      {"negative.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridResolution, -0.05F); },
       "cells of -0.05 m"},
      {"resolution_nan.gridmap", gridBytes, [=](S& b) { put(b, grid, kGridResolution, kFloatNan); },
       "cells of nan m"},
      {"weights.gridmap", gridBytes,
       [=](S& b) { put(b, grid, 30 + 80 * 80 + 20 + 58, std::uint32_t{0x7FFFFFFF}); }},
      {"parameters.gridmap", gridBytes, [](S& b) { put(b, "TMapGenericParam", 0, 'X'); }},
      {"frames.simplemap", simplemapBytes, [=](S& b) { put(b, key_frames, 1, kAll); }},
      {"many_frames.simplemap", simplemapBytes, [=](S& b) { put(b, key_frames, 1, 100000000U); }},
      {"one_more.simplemap", simplemapBytes, [=](S& b) { put(b, key_frames, 1, 3U); }},
      {"no_pose.simplemap", simplemapBytes,
       [](S& b) { b.replace(b.find("CPose3DPDFGaussian"), 18, "CObservation2DRang"); }},
      {"scan_for_frame.simplemap", simplemapBytes,
       [](S& b) { b.replace(b.find("CSensoryFrame"), 13, "CPose2D\0\0\0\0\0\0"); }},
      {"observations.simplemap", simplemapBytes, [](S& b) { put(b, "CSensoryFrame", 1, kAll); }},
      {"second_frame.simplemap", simplemapBytes, [](S& b) { put(b, "CSensoryFrame", 1, 7U, 2); }},
      {"end.simplemap", simplemapBytes, [](S& b) { b.back() = '\0'; }},
  };
}

std::vector<HostileObject> hostileLogs()
{
  using S = std::string;
  const auto moved = [] { return actionBytes(drawnMovement()); };
  const auto modes = []
  {
    auto sum = mrpt::poses::CPosePDFSOG::Create();
    sum->resize(3);
    return actionBytes(matchedMovement(sum));
  };
  const auto particles = []
  { return actionBytes(matchedMovement(std::make_shared<mrpt::poses::CPosePDFParticles>(7))); };
  const auto scan = [] { return bytesOf(*makeScan(1)); };
  const S features = "ObservationSignatures";
  return {
      {"actions.rawlog", moved, [](S& b) { put(b, "CActionCollection", 1, kAll); }},
      {"method.rawlog", moved, [](S& b) { put(b, "CActionRobotMovement2D", 1, 1U); }},
      {"no_method.rawlog", moved, [](S& b) { put(b, "CActionRobotMovement2D", 1, 99U); }},
      {"drawn.rawlog", moved,
       [](S& b) { put(b, "CPose2D", 1 + 24 + 1 + 4 + 24, std::uint32_t{0x7FFFFFFF}); }},
      {"pose.rawlog", moved, [](S& b) { b.replace(b.find("CPose2D"), 7, "CPose3D"); }},
      {"modes.rawlog", modes, [](S& b) { put(b, "CPosePDFSOG", 1, kAll); }},
      {"particles.rawlog", particles, [](S& b) { put(b, "CPosePDFParticles", 1, 50000000U); }},
      {"beams.rawlog", scan,
       [](S& b) { put(b, "CPose3D", 1 + 96 + 1, std::uint32_t{0x7FFFFFFF}); }},
      {"two_beams_more.rawlog", scan, [](S& b) { put(b, "CPose3D", 1 + 96 + 1, 183U); }},
      {"mount.rawlog", scan, [](S& b) { b.replace(b.find("CPose3D"), 7, "CPose2D"); }},
      {"label.rawlog", scan,
       [](S& b) { put(b, "CPose3D", 1 + 96 + 1 + 4 + 181 * 5 + 4 + 8 + 4, kAll); }},
      {"no_class.rawlog", scan, [](S& b) { put(b, "CPose3", 0, 'X'); },
       "no usable laser scan in it"},
      {"features.rawlog", signatureBytes, [=](S& b) { put(b, "CPose3D", 1 + 96 + 1, kAll); }},
      {"source.rawlog", signatureBytes, [=](S& b) { put(b, features, 1 + 8, kAll); }},
      {"far_mount.rawlog", signatureBytes, [](S& b) { put(b, "CPose3D", 1, 1e9); }},
      {"size.rawlog", signatureBytes,
       [](S& b) { put(b, "CPose3D", 1 + 96 + 1 + 4 + 4 + 24, -5.0); }},
      {"place.rawlog", signatureBytes,
       [](S& b) { put(b, "CPose3D", 1 + 96 + 1 + 4 + 4, std::nan("")); }},
      {"parent.rawlog", signatureBytes,
       [](S& b) { put(b, "CPose3D", 1 + 96 + 1 + 4 + 4 + 80 + 8, 0x7FFFFFF0); }},
      {"return.rawlog", signatureBytes, [](S& b) { putBeforeEnd(b, std::nanf("")); }},
      {"returns.rawlog", noReturnBytes, [](S& b) { putBeforeEnd(b, kAll); }},
  };
}

/// Runs a program that may use 20 s of processor and 1 GB of address space, libraries included.
CommandResult runBounded(const TemporaryFolder& folder, const std::string& program,
                         const Arguments& arguments)
{
  return runShell(folder, "ulimit -t 20; ulimit -v 1000000; " + commandLine(program, arguments));
}

/// Expects that a program refuses each of the objects in one line, and leaves nothing behind.
template <class ArgumentsOf>
void expectRefusals(const TemporaryFolder& folder, const std::vector<HostileObject>& objects,
                    const std::string& program, ArgumentsOf&& arguments_of)
{
  for (const HostileObject& hostile : objects)
  {
    const std::string name = hostile.name;
    std::string bytes = hostile.sound();
    hostile.spoil(bytes);
    writeText(folder / name, bytes);
    const auto before = listing(folder);
    const CommandResult result = runBounded(folder, program, arguments_of(name));
    EXPECT_EQ(result.exit_code, 1) << name << ": " << result.errors;
    EXPECT_EQ(countLines(result.errors), 1) << name << ": " << result.errors;
    EXPECT_NE(result.errors.find(name + ": " + hostile.reason), std::string::npos) << result.errors;
    EXPECT_EQ(listing(folder), before) << name;
  }
}

TEST(HostileObject, MapsAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  expectRefusals(folder, hostileMapObjects(), "sigloc-map",
                 [](const std::string& name) {
                   return Arguments{"build", "-i", name, "-o", "m.sigmap"};
                 });
}

TEST(HostileObject, LogsAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  writeText(folder / "room.simplemap", simplemapBytes());
  run(folder, "sigloc-map", {"build", "-i", "room.simplemap", "-o", "room.sigmap"});
  expectRefusals(folder, hostileLogs(), "sigloc-localize",
                 [](const std::string& name)
                 { return Arguments{"--map", "room.sigmap", "--log", name, "--out", "o"}; });
}

TEST(HostileObject, TheSameBytesUnspoiltAreRead)
{
  const TemporaryFolder folder;
  writeText(folder / "room.simplemap", simplemapBytes());
  writeText(folder / "room.gridmap", gridBytes());
  for (const std::string name : {"room.simplemap", "room.gridmap"})
  {
    const auto result = runBounded(folder, "sigloc-map", {"info", name});
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.errors;
  }
}
}  // namespace
}  // namespace sigloc
