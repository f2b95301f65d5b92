// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Files of text: maps, truth, settings, and what sigloc-eval wrote.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "eval/reports/merge.h"
#include "fuzz/good_run.h"
#include "fuzz/small_room.h"
#include "fuzz/targets.h"
#include "io/GroundTruth.h"
#include "io/maps/map_source_readers.h"
#include "io/points/points_raster.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/localize/LocalizationSetup.h"

namespace sigloc::fuzz
{
namespace
{
/// Where a target reads two files, the first ends at the first zero.
std::pair<std::string_view, std::string_view> twoFiles(std::string_view bytes)
{
  const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
  return {bytes.substr(0, zero), bytes.substr(std::min(zero + 1, bytes.size()))};
}
}  // namespace

bool readsRosMap(std::string_view bytes)
{
  const auto [yaml, image] = twoFiles(bytes);
  const auto path = inputFile("map.yaml", yaml);
  inputFile("map.pgm", image);
  return accepts(
      [&]
      {
        const OccupancyRaster raster = detail::readRosMap(path);
        detail::warningOfRosMap(path);
        require(raster.cells.size() == std::size_t{raster.frame.width} * raster.frame.height,
                "a raster without all its cells");
      });
}

bool readsCarmenLog(std::string_view bytes)
{
  const auto path = inputFile("scans.log", bytes);
  const bool map = accepts(
      [&]
      {
        for (const PosedScans& posed : detail::readCarmenMap(path)) observeScene(posed.scans);
      });
  const bool log = accepts(
      [&]
      {
        RawlogReader reader(path);
        while (const auto step = reader.next()) observe(*step);
      });
  return map || log;
}

bool readsLandmarks(std::string_view bytes)
{
  const auto path = inputFile("landmarks.csv", bytes);
  return accepts([&] { require(!detail::readLandmarks(path).features().empty(), "no landmark"); });
}

bool readsPoints(std::string_view bytes)
{
  const auto usable = [](const detail::PointList& points, const std::filesystem::path& path)
  {
    const OccupancyRaster raster = detail::rasterOfPoints(points, {}, path);
    require(raster.cells.size() == std::size_t{raster.frame.width} * raster.frame.height,
            "a raster without all its cells");
  };
  const auto ply = inputFile("points.ply", bytes);
  const auto pcd = inputFile("points.pcd", bytes);
  const auto txt = inputFile("points.txt", bytes);
  return accepts([&] { usable(detail::readPly(ply), ply); }) ||
         accepts([&] { usable(detail::readPcd(pcd), pcd); }) ||
         accepts(
             [&]
             {
               const auto rows = detail::pointRowsOf(txt);
               if (!rows) throw std::runtime_error(txt.string() + ": no points");
               usable(*rows, txt);
             });
}

bool readsGroundTruth(std::string_view bytes)
{
  const auto path = inputFile("truth.txt", bytes);
  return accepts(
      [&]
      {
        const GroundTruth truth = GroundTruth::read(path, {1, 2, 3});
        for (const std::size_t step : {0U, 1U, 7U})
        {
          const auto pose = truth.at(step, static_cast<double>(step));
          require(!pose || (std::isfinite(pose->x) && std::isfinite(pose->phi)), "an odd pose");
        }
      });
}

bool readsSetup(std::string_view bytes)
{
  const auto path = inputFile("settings.ini", bytes);
  LocalizationSetup setup;
  if (!accepts([&] { setup = readOptionSections(path); })) return false;
  accepts([&] { readLocalizationSetup(path); });
  // What is accepted must be usable: three steps, without the work that large numbers ask for.
  constexpr std::uint32_t kMostCandidates = 50;
  setup.matcher.max_candidates = std::min(setup.matcher.max_candidates, kMostCandidates);
  if (setup.matcher.mode == static_cast<std::uint32_t>(GenerationMode::minimal_sets) &&
      !setup.matcher.use_dense_field)
  {
    return true;
  }
  const auto matcher = std::make_shared<const SignatureMatcher>(smallRoom(), setup.matcher);
  HypothesisTracker tracker(matcher, setup.tracker);
  for (const double x : {-3.0, -2.9, -2.8})
  {
    const MotionIncrement motion{{0.1, 0, 0}, {}};
    requireLaws(tracker.step(motion, observeScene({scanInRoom({x, 0, 0.3})}, setup.features)),
                setup.tracker.localized_probability);
  }
  return true;
}

bool readsSummaries(std::string_view bytes)
{
  const auto [summary, rows] = twoFiles(bytes);
  static const std::filesystem::path good = [&]
  {
    const auto folder = inputFile("good/none", {}).parent_path();
    std::filesystem::remove(folder / "none");
    writeRelocateReport(goodRun(2), folder);
    return folder;
  }();
  const auto fuzzed = inputFile("fuzzed/summary.json", summary).parent_path();
  inputFile("fuzzed/results.csv", rows);
  return accepts([&] { mergeRuns({fuzzed, good}, "fuzz"); });
}
}  // namespace sigloc::fuzz
