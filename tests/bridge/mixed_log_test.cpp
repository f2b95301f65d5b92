// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Logs with observations that sigloc does not use between those that it does.
#include "support/mixed_log.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <sys/resource.h>

#include <algorithm>
#include <random>

#include "bridge/log_steps.h"
#include "bridge/rawlog_files.h"
#include "bridge/room_map.h"
#include "bridge/unpacked_file.h"
#include "io/archive/checked_archive.h"
#include "io/archive/UnreadObservation.h"
#include "sigloc/io/RawlogReader.h"
#include "support/golden.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::serialization::CSerializable;

namespace
{
std::vector<CSerializable::Ptr> entriesOf(const std::filesystem::path& path)
{
  detail::GzipInput input(path);
  std::vector<CSerializable::Ptr> entries;
  while (!input.atEnd())
  {
    entries.push_back(detail::readLogEntry(input));
    if (!entries.back()) break;
  }
  return entries;
}

std::vector<RawlogStep> stepsOfWholeLog(const std::filesystem::path& path)
{
  RawlogReader reader(path);
  auto steps = stepsOf(reader);
  EXPECT_FALSE(reader.truncated());
  return steps;
}

/// A scan before, between and after one observation of every class.
std::vector<CSerializable::Ptr> mixedEntries()
{
  std::vector<CSerializable::Ptr> entries = {makeScan(1)};
  double time = 1;
  for (const auto& observation : everyObservation())
  {
    entries.push_back(observation);
    entries.push_back(makeScan(++time));
  }
  return entries;
}
}  // namespace

TEST(MixedLog, EveryClassIsReadOrKeptAsItsBytes)
{
  const TemporaryFolder folder;
  const auto entries = mixedEntries();
  writeObjects(folder / "log", entries);
  const auto found = entriesOf(folder / "log");
  ASSERT_EQ(found.size(), entries.size());
  std::size_t unread = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    ASSERT_NE(found[k], nullptr) << k;
    EXPECT_STREQ(found[k]->GetRuntimeClass()->className, entries[k]->GetRuntimeClass()->className);
    if (std::dynamic_pointer_cast<detail::UnreadObservation>(found[k])) ++unread;
  }
  EXPECT_GE(unread, 18U);
  writeObjects(folder / "again", found);
  EXPECT_EQ(unpacked(folder / "log"), unpacked(folder / "again"));
}

TEST(MixedLog, AFramesObservationsAreSkippedWhereverTheyStand)
{
  const TemporaryFolder folder;
  for (const bool scan_first : {true, false})
  {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    if (scan_first) frame->insert(makeScan(1));
    for (const auto& observation : everyObservation()) frame->insert(observation);
    if (!scan_first) frame->insert(makeScan(1));
    writeObjects(folder / "log", {makeAction({0.1, 0, 0}, mrpt::math::CMatrixDouble33()), frame,
                                  makeAction({0.1, 0, 0}, mrpt::math::CMatrixDouble33()), frame});
    const auto steps = stepsOfWholeLog(folder / "log");
    ASSERT_EQ(steps.size(), 2U) << scan_first;
    EXPECT_EQ(steps[1].frame->size(), frame->size());
    writeObjects(folder / "again", entriesOf(folder / "log"));
    EXPECT_EQ(unpacked(folder / "log"), unpacked(folder / "again"));
  }
}

TEST(MixedLog, GivesTheStepsOfItsScansAlone)
{
  const TemporaryFolder folder;
  const auto entries = mixedEntries();
  writeObjects(folder / "mixed", entries);
  std::vector<CSerializable::Ptr> scans;
  for (std::size_t k = 0; k < entries.size(); k += 2) scans.push_back(entries[k]);
  writeObjects(folder / "scans", scans);
  const auto mixed = stepsOfWholeLog(folder / "mixed");
  const auto alone = stepsOfWholeLog(folder / "scans");
  // MRPT's default scan has no beams, and comes at the time of its making.
  ASSERT_GE(mixed.size(), alone.size());
  for (const RawlogStep& step : alone)
  {
    const auto same = [&](const RawlogStep& other) { return other.time == step.time; };
    EXPECT_TRUE(std::any_of(mixed.begin(), mixed.end(), same)) << step.time;
  }
}

TEST(MixedLog, ASimplemapsObservationsAreKeptAsTheirBytes)
{
  const TemporaryFolder folder;
  auto map = mrpt::maps::CSimpleMap::Create();
  for (const double x : {0.0, 1.0, 2.0})
  {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(roomScan({x, 0, 0}));
    for (const auto& observation : everyObservation()) frame->insert(observation);
    map->insert(mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0)),
                frame);
  }
  writeObjects(folder / "map", {map});
  mrpt::maps::CSimpleMap found;
  detail::readObjectFile(folder / "map", found);
  ASSERT_EQ(found.size(), 3U);
  writeObjects(folder / "again", {std::make_shared<mrpt::maps::CSimpleMap>(found)});
  EXPECT_EQ(unpacked(folder / "map"), unpacked(folder / "again"));

  // The file cut off, and one key frame more than there is.
  std::string bytes = unpacked(folder / "map");
  writeText(folder / "cut", bytes.substr(0, bytes.size() - 200));
  const std::string name = "CSimpleMap";
  bytes[bytes.find(name) + name.size() + 1] = 4;
  writeText(folder / "count", bytes);
  for (const std::string bad : {"cut", "count"})
  {
    const std::string reason =
        messageOf<std::runtime_error>([&] { detail::readObjectFile(folder / bad, found); });
    EXPECT_EQ(reason, (folder / bad).string() + ": truncated or damaged");
  }
}

TEST(MixedLog, AClassThatNobodyRegisteredIsSkipped)
{
  const TemporaryFolder folder;
  writeObjects(folder / "log", {makeScan(1), mrpt::obs::CObservationIMU::Create(), makeScan(2)});
  std::string bytes = unpacked(folder / "log");
  const std::string name = "CObservationIMU";
  bytes.replace(bytes.find(name), name.size(), "CObservationXYZ");
  writeText(folder / "log", bytes);
  EXPECT_EQ(stepsOfWholeLog(folder / "log").size(), 2U);
}

TEST(MixedLog, AnObservationThatIsCutOffEndsTheLog)
{
  const TemporaryFolder folder;
  writeObjects(folder / "log", {makeScan(1), mrpt::obs::CObservationIMU::Create()});
  const std::string bytes = unpacked(folder / "log");
  writeText(folder / "log", bytes.substr(0, bytes.size() - 5));
  RawlogReader reader(folder / "log");
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.truncated());
}

// MRPT takes memory for what such an observation says that it holds. The peak is 74 MB in a Release
// build. Under the address sanitizer it is 325 MB, because that keeps up to 256 MB of what was
// freed. With ASAN_OPTIONS=quarantine_size_mb=16 it is 138 MB; a test that reads one log takes 129.
TEST(MixedLog, NoChangedByteHurtsTheReader)
{
  const TemporaryFolder folder;
  writeObjects(folder / "log", mixedEntries());
  const std::string sound = unpacked(folder / "log");
  std::mt19937 random(20260128);
  std::size_t whole = 0;
  constexpr std::size_t kMutants = 300;
  for (std::size_t k = 0; k < kMutants; ++k)
  {
    std::string bytes = sound;
    for (std::size_t n = 1 + random() % 3; n > 0; --n)
    {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 3 == 0 ? 0xFF : random());
    }
    writeText(folder / "log", bytes);
    RawlogReader reader(folder / "log");
    while (reader.next())
    {
    }
    if (!reader.truncated()) ++whole;
  }
  EXPECT_GT(whole, kMutants / 20);
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 500000) << "[kB]";
}

// The office's log with one of these observations in each frame, as it was written once. With
// SIGLOC_UPDATE_GOLDEN=1 it is written anew: scripts/mutants is fed with it.
TEST(MixedLog, TheStoredOneGivesTheStepsOfTheOffice)
{
  const std::filesystem::path office = SIGLOC_GOLDEN_FOLDER "/../../rawlogs/office.rawlog";
  const std::filesystem::path stored = SIGLOC_GOLDEN_FOLDER "/mixed.rawlog";
  if (test::writesGolden())
  {
    auto entries = entriesOf(office);
    auto entry = entries.begin();
    for (const auto& observation : everyObservation())
    {
      const auto isFrame = [](const CSerializable::Ptr& object)
      { return std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object) != nullptr; };
      entry = std::find_if(entry, entries.end(), isFrame);
      ASSERT_NE(entry, entries.end());
      observation->timestamp = INVALID_TIMESTAMP;
      std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(*entry++)->insert(observation);
    }
    entries.erase(entry, entries.end());
    writeObjects(stored, entries);
  }
  const auto mixed = stepsOfWholeLog(stored);
  const auto plain = stepsOfWholeLog(office);
  ASSERT_GE(mixed.size(), 30U);
  for (std::size_t k = 0; k < mixed.size(); ++k)
  {
    EXPECT_EQ(mixed[k].time, plain[k].time);
    EXPECT_EQ(mixed[k].scans.front().ranges, plain[k].scans.front().ranges);
  }
}
