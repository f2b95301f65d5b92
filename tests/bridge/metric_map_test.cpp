// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Files of a CMultiMetricMap: the grid is taken, else the points.
#include <gtest/gtest.h>
#include <mrpt/maps/CBeaconMap.h>
#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <variant>

#include "bridge/map_error.h"
#include "bridge/rawlog_files.h"
#include "bridge/unpacked_file.h"
#include "io/archive/gzip_input.h"

using namespace sigloc;
using namespace sigloc::test;

namespace
{
const std::filesystem::path kOfficeGrid =
    std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "../../maps/office.gridmap.gz";

mrpt::maps::COccupancyGridMap2D::Ptr officeGrid()
{
  detail::GzipInput input(kOfficeGrid);
  auto archive = mrpt::serialization::archiveFrom(input);
  return std::dynamic_pointer_cast<mrpt::maps::COccupancyGridMap2D>(archive.ReadObject());
}

template <class Map>
typename Map::Ptr officePoints()
{
  const auto raster = std::get<OccupancyRaster>(readMapSource(kOfficeGrid));
  const RasterFrame& frame = raster.frame;
  auto points = Map::Create();
  for (std::size_t i = 0; i < raster.cells.size(); ++i)
  {
    if (!isWall(raster.cells[i])) continue;
    const double x = static_cast<double>(i % frame.width) + 0.5;
    const double y = static_cast<double>(i / frame.width) + 0.5;
    points->insertPoint(static_cast<float>(frame.origin.x + x * frame.resolution),
                        static_cast<float>(frame.origin.y + y * frame.resolution), 0);
  }
  return points;
}

/// The head of an object of MRPT, and the count that comes behind it.
std::string headOf(const std::string& name, char version, char count)
{
  const char length = static_cast<char>(0x80U | name.size());
  return length + name + version + count + std::string(3, '\0');
}

}  // namespace

TEST(MetricMaps, OfSeveralTheGridIsTaken)
{
  const TemporaryFolder folder;
  auto map = mrpt::maps::CMultiMetricMap::Create();
  map->maps.push_back(officePoints<mrpt::maps::CSimplePointsMap>());
  map->maps.push_back(mrpt::maps::CBeaconMap::Create());
  map->maps.push_back(mrpt::maps::COccupancyGridMap2D::Create());  // nothing is in it
  map->maps.push_back(officeGrid());
  writeObjects(folder / "m.metricmap", {map});
  const auto expected = std::get<OccupancyRaster>(readMapSource(kOfficeGrid));
  for (const char* const name : {"m.metricmap", "m.gridmap"})
  {
    if (!std::filesystem::exists(folder / name))
      std::filesystem::copy_file(folder / "m.metricmap", folder / name);
    const auto found = std::get<OccupancyRaster>(readMapSource(folder / name));
    EXPECT_EQ(found.cells, expected.cells) << name;
    EXPECT_EQ(found.frame.origin, expected.frame.origin);
    EXPECT_EQ(warningOfMapSource(folder / name), "");
  }
}

TEST(MetricMaps, WithoutAGridThePointsAreTaken)
{
  const TemporaryFolder folder;
  auto map = mrpt::maps::CMultiMetricMap::Create();
  map->maps.push_back(mrpt::maps::CBeaconMap::Create());
  map->maps.push_back(officePoints<mrpt::maps::CColouredPointsMap>());
  writeObjects(folder / "multi.metricmap", {map});
  writeObjects(folder / "single.metricmap", {officePoints<mrpt::maps::CSimplePointsMap>()});
  for (const char* const name : {"multi.metricmap", "single.metricmap"})
  {
    const auto raster = std::get<OccupancyRaster>(readMapSource(folder / name));
    EXPECT_GT(std::count(raster.cells.begin(), raster.cells.end(), CellState::solid_wall), 500);
    EXPECT_NE(warningOfMapSource(folder / name).find("no free space"), std::string::npos) << name;
  }
}

TEST(MetricMaps, OthersOfTheKindThatIsReadAreTold)
{
  const TemporaryFolder folder;
  auto grids = mrpt::maps::CMultiMetricMap::Create();
  grids->maps.push_back(officeGrid());
  grids->maps.push_back(officeGrid());
  auto points = mrpt::maps::CMultiMetricMap::Create();
  points->maps.push_back(officePoints<mrpt::maps::CColouredPointsMap>());
  auto elsewhere = mrpt::maps::CSimplePointsMap::Create();
  for (int i = 0; i < 100; ++i) elsewhere->insertPoint(900, 0.05F * static_cast<float>(i), 0);
  points->maps.push_back(elsewhere);
  writeObjects(folder / "grids.metricmap", {grids});
  writeObjects(folder / "behind.metricmap", {officeGrid(), officeGrid()});
  writeObjects(folder / "points.metricmap", {points});
  for (const char* const name : {"grids.metricmap", "behind.metricmap"})
    EXPECT_EQ(warningOfMapSource(folder / name), "only the first of its grid maps is read") << name;
  EXPECT_NE(warningOfMapSource(folder / "points.metricmap")
                .find("; only the first of its maps of points is read"),
            std::string::npos);
  const auto office = std::get<OccupancyRaster>(readMapSource(kOfficeGrid)).frame;
  const auto first = std::get<OccupancyRaster>(readMapSource(folder / "points.metricmap")).frame;
  EXPECT_NEAR(first.origin.x, office.origin.x, 5) << "in the order of the file";
}

// MRPT keeps pictures and descriptors with its landmarks; the places alone are what a user can
// give.
TEST(MetricMaps, LandmarksAreToldAndNotRead)
{
  const TemporaryFolder folder;
  const auto path = folder / "m.metricmap";
  const std::string landmarks = headOf("mrpt::maps::CLandmarksMap", 0, 2) + std::string(90, 'x');
  writeText(path, landmarks);
  EXPECT_EQ(mapErrorOf(path),
            path.string() +
                ": holds a 'mrpt::maps::CLandmarksMap', not a map of a grid or of points; "
                "landmarks are read from a .csv file with a row x,y for each");
  writeText(path, headOf("mrpt::maps::CMultiMetricMap", 12, 1) + landmarks + '\x88');
  EXPECT_EQ(mapErrorOf(path),
            path.string() +
                ": holds neither a grid map with walls and free cells nor a map of points; "
                "landmarks are read from a .csv file with a row x,y for each");
  for (const bool grid : {true, false})
  {
    auto map = mrpt::maps::CMultiMetricMap::Create();
    if (grid) map->maps.push_back(officeGrid());
    map->maps.push_back(officePoints<mrpt::maps::CSimplePointsMap>());
    writeObjects(path, {map});
    const std::string before = warningOfMapSource(path);
    writeText(path, unpacked(path) + landmarks + '\x88');
    EXPECT_EQ(warningOfMapSource(path), before + (grid ? "" : "; ") + "its landmarks are left out");
  }
}

TEST(MetricMaps, OfNoUseAreRefusedInOneLine)
{
  const TemporaryFolder folder;
  const auto path = folder / "m.metricmap";
  const auto expectRefused = [&](const char* reason)
  {
    const std::string message = mapErrorOf(path);
    EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expectRefused("no such file");
  writeText(path, "");
  expectRefused("empty");
  writeText(path, "%PDF-1.4\nnothing\n");
  expectRefused("not an MRPT file");
  writeObjects(path, {makeScan(1)});
  expectRefused("holds a 'mrpt::obs::CObservation2DRangeScan'");
  auto map = mrpt::maps::CMultiMetricMap::Create();
  map->maps.push_back(mrpt::maps::CBeaconMap::Create());
  writeObjects(path, {map});
  expectRefused("neither a grid map");
  map->maps.push_back(officePoints<mrpt::maps::CSimplePointsMap>());
  writeObjects(path, {map});
  std::string bytes = unpacked(path);
  const std::string whole = readBytes(path);
  writeText(path, whole.substr(0, whole.size() / 2));
  EXPECT_FALSE(mapErrorOf(path).empty());
  // With one byte less it ends as the last map in it does, and nothing that is used is missing.
  for (const std::size_t cut : {std::size_t{2}, std::size_t{100}, bytes.size() / 2})
  {
    writeText(path, bytes.substr(0, bytes.size() - cut));
    expectRefused("truncated or damaged");
  }
  // A count of points that is not there.
  const std::size_t head = bytes.find("CSimplePointsMap") + 17;
  for (std::size_t i = head; i < head + 4; ++i) bytes[i] = '\xFF';
  writeText(path, bytes);
  expectRefused("neither a grid map");
}
