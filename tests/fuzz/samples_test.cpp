// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Good inputs in today's formats, which fuzzing begins with. With SIGLOC_UPDATE_GOLDEN=1 those
// that programs write are put into tests/corpus anew.
#include <gtest/gtest.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimpleMap.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "bridge/rawlog_files.h"
#include "bridge/room_map.h"
#include "bridge/sample_maps.h"
#include "fuzz/good_run.h"
#include "fuzz/scene_bytes.h"
#include "fuzz/small_room.h"
#include "fuzz/targets.h"
#include "io/archive/gzip_input.h"
#include "sigloc/io/map_files.h"
#include "sigloc/localize/LocalizationSetup.h"
#include "sigloc/plugin/ObservationSignatures.h"
#include "support/golden.h"
#include "support/mixed_log.h"

namespace sigloc::fuzz
{
namespace
{
using mrpt::serialization::CSerializable;
using test::TemporaryFolder;

std::string unpacked(const std::filesystem::path& path)
{
  detail::GzipInput input(path);
  std::string bytes(1U << 20U, '\0');
  bytes.resize(input.Read(bytes.data(), bytes.size()));
  return bytes;
}

std::string bytesOf(const std::vector<CSerializable::Ptr>& objects)
{
  const TemporaryFolder folder;
  test::writeObjects(folder / "objects", objects);
  return unpacked(folder / "objects");
}

std::string sigmapBytes()
{
  const TemporaryFolder folder;
  saveSigmap(test::sampleMap(20, 14), folder / "map.sigmap");
  return unpacked(folder / "map.sigmap");
}

mrpt::obs::CObservation2DRangeScan::Ptr shortScan(double time)
{
  auto scan = test::makeScan(time);
  scan->resizeScanAndAssign(31, 2.0F, true);
  return scan;
}

std::string logBytes()
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(shortScan(1));
  frame->insert(mrpt::obs::CObservationIMU::Create());
  return bytesOf({test::makeAction({0.1, 0, 0}, mrpt::math::CMatrixDouble33()), frame,
                  test::makeOdometry(2, {0.2, 0, 0}), shortScan(2)});
}

std::string simplemapBytes()
{
  auto map = mrpt::maps::CSimpleMap::Create();
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(shortScan(1));
  map->insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  map->insert(mrpt::poses::CPose3DPDFGaussian::Create(), frame);
  return bytesOf({map});
}

std::string gridBytes()
{
  auto grid = std::make_shared<mrpt::maps::COccupancyGridMap2D>(0.F, 2.F, 0.F, 1.F, 0.1F);
  for (int x = 0; x < 20; ++x)
  {
    for (int y = 0; y < 10; ++y) grid->setCell(x, y, x % 19 == 0 || y % 9 == 0 ? 0.05F : 0.95F);
  }
  return bytesOf({grid});
}

std::string summaryBytes()
{
  const TemporaryFolder folder;
  writeRelocateReport(goodRun(1), folder / "run");
  return test::readBytes(folder / "run" / "summary.json") + '\0' +
         test::readBytes(folder / "run" / "results.csv");
}

void put(std::string& bytes, double value)
{
  const auto raw = static_cast<std::int16_t>(std::lround(1000 * value));
  char two[sizeof(raw)];
  std::memcpy(two, &raw, sizeof(raw));
  bytes.append(two, sizeof(raw));
}

/// A robot that drives through the small room: what the target `scene` reads.
std::string driveBytes(char map)
{
  std::string bytes(1, map);
  for (const double x : {-3.0, -2.8, -2.6})
  {
    bytes += static_cast<char>(kMotion | kRelocate);
    for (const double value : {0.2, 0.0, 0.0, 0.001, 0.001, 0.001}) put(bytes, value);
    bytes += static_cast<char>(kBeams);
    for (const float range : scanInRoom({x, -1, 0.3}).ranges) put(bytes, range);
  }
  return bytes;
}

struct Sample
{
  const char* target;
  const char* name;
  std::function<std::string()> bytes;
};

std::vector<Sample> samples()
{
  return {
      {"sigmap", "good", sigmapBytes},
      {"signature_map", "good_prepared",
       [] { return bytesOf({std::make_shared<SignatureMap>(test::sampleMap(20, 14))}); }},
      {"signatures", "good",
       []
       {
         return bytesOf({std::make_shared<ObservationSignatures>(*test::roomScan({0, 0, 0}),
                                                                 FeatureExtractorOptions{})});
       }},
      {"rawlog", "good", logBytes},
      {"map_file", "good_simplemap", simplemapBytes},
      {"map_file", "good_gridmap", gridBytes},
      {"summaries", "good", summaryBytes},
      {"scene", "good_drive", [] { return driveBytes('\0'); }},
      {"scene", "good_drive_by_features", [] { return driveBytes('\1'); }},
      {"ini", "good_defaults", defaultOptionSections},
  };
}

Target targetNamed(std::string_view name)
{
  const auto* const found = std::find_if(kTargets.begin(), kTargets.end(),
                                         [&](const auto& target) { return target.name == name; });
  return found->run;
}

TEST(FuzzSamples, AreAccepted)
{
  for (const Sample& sample : samples())
  {
    const std::string bytes = sample.bytes();
    EXPECT_TRUE(targetNamed(sample.target)(bytes)) << sample.target << " " << sample.name;
    if (!test::writesGolden()) continue;
    const auto folder = std::filesystem::path(SIGLOC_CORPUS) / sample.target;
    std::filesystem::create_directories(folder);
    test::writeText(folder / sample.name, bytes);
  }
}
}  // namespace
}  // namespace sigloc::fuzz
