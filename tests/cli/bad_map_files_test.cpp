// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every kind of map file that we read with code of our own, spoilt in every way: one line names it,
// and nothing is written.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <zstd.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <sstream>

#include "command_line.h"
#include "office_image.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

constexpr std::uint32_t kHuge = 0xFFFFFFF0U;

/// A file's bytes without gzip.
std::string unpacked(const std::filesystem::path& path)
{
  mrpt::io::CFileGZInputStream file(path.string());
  std::string bytes(1U << 23U, '\0');
  bytes.resize(file.Read(bytes.data(), bytes.size()));
  return bytes;
}

/// The bytes in one frame of zstd.
std::string packed(const std::string& bytes)
{
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

template <class T>
std::string bytesOf(T value)
{
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

/// A text with another in place of the first `old`, which there must be.
std::string with(std::string text, const std::string& old, const std::string& now)
{
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), now);
}

/// MRPT's object with a value at `offset` behind the version of a class.
template <class T>
std::string withValue(std::string bytes, const std::string& name, std::size_t offset, T value)
{
  const std::size_t at = bytes.find(name);
  EXPECT_NE(at, std::string::npos) << name;
  return bytes.replace(at + name.size() + 1 + offset, sizeof(T), bytesOf(value));
}

/// The middles of the office's wall cells [m].
std::vector<mrpt::math::TPoint2D> officePoints()
{
  const OccupancyRaster raster = officeRaster();
  const RasterFrame& frame = raster.frame;
  std::vector<mrpt::math::TPoint2D> points;
  for (std::size_t i = 0; i < raster.cells.size(); ++i)
  {
    if (!isWall(raster.cells[i])) continue;
    const double x = static_cast<double>(i % frame.width) + 0.5;
    const double y = static_cast<double>(i / frame.width) + 0.5;
    points.emplace_back(frame.origin.x + x * frame.resolution,
                        frame.origin.y + y * frame.resolution);
  }
  return points;
}

std::string rowsOf(const std::vector<mrpt::math::TPoint2D>& points)
{
  std::ostringstream rows;
  for (const auto& point : points) rows << point.x << ' ' << point.y << " 0.5\n";
  return rows.str();
}

/// As many rows, none of which is a point.
std::string rowsOfNan(std::size_t count)
{
  std::string rows;
  for (std::size_t i = 0; i < count; ++i) rows += "nan nan nan\n";
  return rows;
}

/// A multi-map with the office's grid or with the points of its walls.
std::string multiMap(bool as_grid)
{
  auto multi = mrpt::maps::CMultiMetricMap::Create();
  if (as_grid)
  {
    mrpt::io::CFileGZInputStream file((kSources / "maps/office.gridmap.gz").string());
    auto archive = mrpt::serialization::archiveFrom(file);
    multi->maps.push_back(std::dynamic_pointer_cast<mrpt::maps::CMetricMap>(archive.ReadObject()));
  }
  else
  {
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (const auto& point : officePoints())
      points->insertPoint(static_cast<float>(point.x), static_cast<float>(point.y), 0);
    multi->maps.push_back(points);
  }
  const TemporaryFolder folder;
  writeObjects(folder / "m", {multi});
  return unpacked(folder / "m");
}

std::string pngOf(const OccupancyRaster& raster)
{
  const TemporaryFolder folder;
  mrpt::img::CImage image(raster.frame.width, raster.frame.height, mrpt::img::CH_GRAY);
  const std::string shades = imageOf(raster);
  const std::size_t head = shades.size() - raster.cells.size();
  for (std::size_t i = 0; i < raster.cells.size(); ++i)
  {
    image.at<std::uint8_t>(static_cast<unsigned>(i % raster.frame.width),
                           static_cast<unsigned>(i / raster.frame.width)) =
        static_cast<std::uint8_t>(shades[head + i]);
  }
  EXPECT_TRUE(image.saveToFile((folder / "m.png").string()));
  return readBytes(folder / "m.png");
}

const std::string kYaml =
    "image: good.pgm\nresolution: 0.05\norigin: [1.5, 2.5, 0.25]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// A file that is sound, and the same with numbers that are none or huge.
struct Kind
{
  std::string map;  // the file that a program is given
  std::string spoilt_file;  // it, or one that it names
  std::string sound;
  std::vector<std::string> spoilt;
};

Kind kindOf(const std::string& map, const std::string& sound,
            const std::vector<std::string>& spoilt)
{
  return {map, map, sound, spoilt};
}

Kind yamlKind()
{
  return kindOf("bad.yaml", kYaml,
                {with(kYaml, "0.05", "nan"), with(kYaml, "0.05", "1e300"),
                 with(kYaml, "1.5", "nan"), with(kYaml, "2.5", "1e30"), with(kYaml, "0.25", "inf"),
                 with(kYaml, "0.196", "nan"), with(kYaml, "0.65", "1e300")});
}

std::vector<std::string> hugePictures()
{
  return {"P5\n99999999 99999999\n255\n\x01", "P5\n99999999999999999999 1\n255\n\x01",
          "P5\n20000 20000\n255\n\x01", "P2\n2 1\n255\n1 99999999999\n", "P5\nnan nan\n255\n"};
}

Kind pngKind()
{
  const std::string png = pngOf(officeRaster());
  std::string huge = png;
  huge.replace(16, 8, "\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF");  // width and height
  return kindOf("bad.png", png, {huge});
}

Kind plyKind()
{
  const auto points = officePoints();
  const std::string count = std::to_string(points.size());
  const auto ply = [](const std::string& announced, const std::string& rows)
  {
    return "ply\nformat ascii 1.0\nelement vertex " + announced +
           "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + rows;
  };
  const std::string rows = rowsOf(points);
  return kindOf("bad.ply", ply(count, rows),
                {ply(count, rowsOfNan(points.size())), ply("4000000000", rows), ply("nan", rows),
                 ply("1e300", rows), ply(count, "1e30 0 0.5\n" + rows)});
}

Kind pcdKind()
{
  const auto points = officePoints();
  const auto pcd = [](const std::string& announced, const std::string& data)
  {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS " + announced +
           "\nDATA binary\n" + data;
  };
  std::string data;
  std::string of_nan;
  for (const auto& point : points)
  {
    const auto x = static_cast<float>(point.x);
    data += bytesOf(x) + bytesOf(static_cast<float>(point.y)) + bytesOf(0.5F);
    of_nan += bytesOf(x) + bytesOf(kFloatNan) + bytesOf(0.5F);
  }
  const std::string count = std::to_string(points.size());
  return kindOf("bad.pcd", pcd(count, data),
                {pcd(count, of_nan), pcd("4000000000", data), pcd("nan", data),
                 pcd(count, bytesOf(1e30F) + data)});
}

Kind rowsKind()
{
  const std::string rows = rowsOf(officePoints());
  std::string endless = rows;
  std::replace(endless.begin(), endless.end(), '\n', ' ');
  // Its first half is to end within the first two numbers of a row.
  std::string sound = rows;
  const auto half_row = [&]
  {
    const std::string half = sound.substr(0, sound.size() / 2);
    return half.substr(half.rfind('\n') + 1);
  };
  while (half_row().empty() || half_row().find(" 0") != std::string::npos) sound += "#\n";
  return kindOf("bad.txt", sound,
                {"nan nan nan\n" + rows, with(rows, "\n", "\n1 nan 2\n"), rows + "1e30 0 0.5\n",
                 "x y z\n" + rowsOfNan(1000), endless});
}

std::vector<std::string> spoiltGrids(const std::string& bytes)
{
  const std::string name = "COccupancyGridMap2D";
  return {withValue(bytes, name, 1, kHuge),     withValue(bytes, name, 5, kHuge),
          withValue(bytes, name, 9, kFloatNan), withValue(bytes, name, 25, kFloatNan),
          withValue(bytes, name, 9, 1e30F),     withValue(bytes, name, 25, 1e30F)};
}

Kind gridKind()
{
  const std::string grid = multiMap(true);
  return kindOf("bad.metricmap", grid, spoiltGrids(grid));
}

Kind pointsKind()
{
  const std::string name = "CSimplePointsMap";
  const std::string points = multiMap(false);
  const std::size_t count = officePoints().size();
  std::string of_nan = points;
  for (std::size_t i = 0; i < count; ++i)
    of_nan = withValue(std::move(of_nan), name, 4 + 4 * i, kFloatNan);
  return kindOf("bad.metricmap", points,
                {of_nan, withValue(points, name, 0, kHuge), withValue(points, name, 4, 1e30F)});
}

Kind zstdKind()
{
  const std::string grid = unpacked(kSources / "maps/office.gridmap.gz");
  std::vector<std::string> spoilt;
  for (const std::string& bytes : spoiltGrids(grid)) spoilt.push_back(packed(bytes));
  // A frame that asks for 2 GB of memory to be unpacked in.
  spoilt.emplace_back(std::string("\x28\xB5\x2F\xFD\x00\xA8\x09\x00\x00", 9) + "x");
  return kindOf("bad.gridmap.zst", packed(grid), spoilt);
}

struct NamedKind
{
  const char* name;
  std::function<Kind()> make;
};

class BadMapFile : public ::testing::TestWithParam<NamedKind>
{
 protected:
  BadMapFile()
  {
    writeText(folder_ / "good.pgm", imageOf(officeRaster()));
    writeText(folder_ / "good.yaml", with(kYaml, "good.pgm", "bad.pgm"));
  }

  CommandResult runWith(const std::string& program, Arguments arguments) const
  {
    if (isMapImage(kind_.map)) arguments.insert(arguments.end(), {"--resolution", "0.05"});
    return run(folder_, program, arguments);
  }

  CommandResult build() const
  {
    return runWith("sigloc-map", {"build", "-i", kind_.map, "-o", "m.sigmap"});
  }

  /// Exit code 1, one line on stderr that names the file, and no file that was not there before.
  void expectRefused(const std::string& what) const
  {
    const auto before = listing(folder_);
    for (const CommandResult& result :
         {build(), runWith("sigloc-localize", {"--map", kind_.map, "--log", kLabLog.string(),
                                               "--out", "new/out", "--quiet"})})
    {
      EXPECT_EQ(result.exit_code, 1) << what;
      EXPECT_EQ(countLines(result.errors), 1) << what << ": " << result.errors;
      EXPECT_NE(result.errors.find(kind_.map + ": "), std::string::npos) << result.errors;
      EXPECT_NE(result.errors.find(kind_.spoilt_file + ": "), std::string::npos) << result.errors;
      EXPECT_EQ(result.output, "") << what;
      EXPECT_EQ(listing(folder_), before) << what;
    }
  }

  TemporaryFolder folder_;
  Kind kind_ = GetParam().make();
};

TEST_P(BadMapFile, isRefused)
{
  writeText(folder_ / "model", kind_.sound);
  const auto path = folder_ / kind_.spoilt_file;
  for (const Damage damage :
       {Damage::missing, Damage::empty, Damage::truncated, Damage::foreign, Damage::random})
  {
    makeBadFile(damage, folder_ / "model", path);
    expectRefused("damage " + std::to_string(static_cast<int>(damage)));
  }
  for (std::size_t i = 0; i < kind_.spoilt.size(); ++i)
  {
    writeText(path, kind_.spoilt[i]);
    expectRefused("spoilt " + std::to_string(i));
  }
}

TEST_P(BadMapFile, isReadWhereItIsSound)
{
  writeText(folder_ / kind_.spoilt_file, kind_.sound);
  const CommandResult result = build();
  EXPECT_EQ(result.exit_code, 0) << result.errors;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMapFile,
    ::testing::Values(
        NamedKind{"yaml", yamlKind},
        NamedKind{"imageOfYaml",
                  []() -> Kind {
                    return {"good.yaml", "bad.pgm", imageOf(officeRaster()), hugePictures()};
                  }},
        NamedKind{"pgm", [] { return kindOf("bad.pgm", imageOf(officeRaster()), hugePictures()); }},
        NamedKind{"png", pngKind}, NamedKind{"ply", plyKind}, NamedKind{"pcd", pcdKind},
        NamedKind{"rows", rowsKind}, NamedKind{"multiMapOfGrid", gridKind},
        NamedKind{"multiMapOfPoints", pointsKind}, NamedKind{"zstd", zstdKind}),
    [](const auto& kind) { return std::string(kind.param.name); });
}  // namespace
}  // namespace sigloc
