// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/checked_archive.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/poses/CPosePDFGaussianInf.h>
#include <mrpt/poses/CPosePDFParticles.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <sys/resource.h>

#include <cstring>
#include <random>

#include "bridge/rawlog_files.h"
#include "bridge/room_map.h"
#include "bridge/unpacked_file.h"
#include "io/archive/ArchiveWalk.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/plugin/ObservationSignatures.h"

using namespace sigloc;
using namespace sigloc::test;
using mrpt::serialization::CSerializable;

namespace
{
template <class Movement>
mrpt::obs::CActionCollection::Ptr actionsOf(const Movement& movement)
{
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(movement);
  return actions;
}

/// One object of each class that sigloc reads, in the forms that MRPT writes them.
std::vector<CSerializable::Ptr> everyEntry()
{
  using Movement = mrpt::obs::CActionRobotMovement2D;
  std::vector<CSerializable::Ptr> entries;
  Movement movement;
  movement.computeFromOdometry({0.1, 0.2, 0.3}, {});
  movement.hasVelocities = true;
  movement.hasEncodersInfo = true;
  entries.push_back(actionsOf(movement));
  Movement::TMotionModelOptions thrun;
  thrun.modelSelection = Movement::mmThrun;
  movement.computeFromOdometry({0.1, 0.2, 0.3}, thrun);
  entries.push_back(actionsOf(movement));
  movement.estimationMethod = Movement::emScan2DMatching;
  movement.poseChange = mrpt::poses::CPosePDFGaussian::Create();
  entries.push_back(actionsOf(movement));
  auto modes = mrpt::poses::CPosePDFSOG::Create();
  modes->resize(3);
  movement.poseChange = modes;
  entries.push_back(actionsOf(movement));
  movement.poseChange = std::make_shared<mrpt::poses::CPosePDFParticles>(7);
  entries.push_back(actionsOf(movement));
  movement.poseChange = mrpt::poses::CPosePDFGaussianInf::Create();
  entries.push_back(actionsOf(movement));
  entries.push_back(actionsOf(mrpt::obs::CActionRobotMovement3D()));
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(roomScan({0, 0, 0}));
  const auto intense = makeScan(2);
  intense->setScanHasIntensity(true);
  frame->insert(intense);
  auto seen = mrpt::obs::CObservationBearingRange::Create();
  seen->sensedData.resize(3);
  for (auto& measured : seen->sensedData) measured.landmarkID = -1;
  frame->insert(seen);
  auto exact = std::make_shared<mrpt::obs::CObservationBearingRange>(*seen);
  exact->validCovariances = true;
  frame->insert(exact);
  frame->insert(mrpt::obs::CObservationRobotPose::Create());
  entries.push_back(frame);
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->hasEncodersInfo = odometry->hasVelocities = true;
  entries.push_back(odometry);
  entries.push_back(mrpt::obs::CObservationComment::Create());
  entries.push_back(
      std::make_shared<ObservationSignatures>(*roomScan({0, 0, 0}), FeatureExtractorOptions{}));
  return entries;
}

std::string plainBytesOf(const std::vector<CSerializable::Ptr>& entries)
{
  const TemporaryFolder folder;
  writeObjects(folder / "log", entries);
  return unpacked(folder / "log");
}

std::vector<detail::Soundness> judged(const std::filesystem::path& path)
{
  detail::GzipInput input(path);
  std::vector<detail::Soundness> found;
  while (!input.atEnd())
  {
    found.push_back(detail::soundnessOfNext(input, detail::kLogEntry));
    if (!detail::readLogEntry(input)) break;
  }
  return found;
}
}  // namespace

TEST(LogEntryCheck, WalksEveryClassExactlyToItsEnd)
{
  const TemporaryFolder folder;
  const auto entries = everyEntry();
  writeObjects(folder / "log", entries);
  const auto found = judged(folder / "log");
  ASSERT_EQ(found.size(), entries.size());
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_EQ(found[k], detail::Soundness::sound) << entries[k]->GetRuntimeClass()->className << k;
  }
}

TEST(LogEntryCheck, FindsTheLogsOfOldAndNewMrptSound)
{
  for (const std::string name :
       {"localization_demo.rawlog", "kf-slam_demo.rawlog", "kf-slam_6D_demo_DA.rawlog",
        "2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"})
  {
    const auto path = kDatasets / name;
    if (!std::filesystem::exists(path)) continue;
    const auto found = judged(path);
    EXPECT_GT(found.size(), 70U) << name;
    for (const auto soundness : found) EXPECT_EQ(soundness, detail::Soundness::sound) << name;
  }
}

// What crashed MRPT's reader: a method that does not exist, which made it expect another object.
TEST(LogEntryCheck, RefusesTheByteThatCrashedTheReader)
{
  const TemporaryFolder folder;
  std::string bytes = plainBytesOf(everyEntry());
  const std::string name = "CActionRobotMovement2D";
  bytes[bytes.find(name) + name.size() + 4] = 1;
  writeText(folder / "log", bytes);
  detail::GzipInput input(folder / "log");
  EXPECT_EQ(detail::soundnessOfNext(input, detail::kLogEntry), detail::Soundness::unsound);
  EXPECT_THROW(RawlogReader(folder / "log"), std::runtime_error);
}

TEST(LogEntryCheck, RefusesCountsThatTheFileHasNoDataFor)
{
  const TemporaryFolder folder;
  const std::string sound = plainBytesOf({makeScan(1)});
  const std::uint32_t beams = 181;
  std::string pattern(sizeof(beams), '\0');
  std::memcpy(pattern.data(), &beams, sizeof(beams));
  const std::size_t at = sound.find(pattern);
  ASSERT_NE(at, std::string::npos);
  for (const std::uint32_t count : {182U, 1000U, 0x00FFFFFFU, 0x7FFFFFFFU, 0xFFFFFFFFU})
  {
    std::string bytes = sound;
    std::memcpy(bytes.data() + at, &count, sizeof(count));
    writeText(folder / "log", bytes);
    detail::GzipInput input(folder / "log");
    EXPECT_EQ(detail::soundnessOfNext(input, detail::kLogEntry), detail::Soundness::unsound)
        << count;
  }
}

// Bytes changed at random, so that the check meets every field. A signal would end this program.
TEST(LogEntryCheck, NoChangedByteHurtsTheReader)
{
  const TemporaryFolder folder;
  const std::string sound = plainBytesOf(everyEntry());
  std::mt19937 random(20120230);
  std::size_t accepted = 0;
  constexpr std::size_t kMutants = 1000;
  for (std::size_t k = 0; k < kMutants; ++k)
  {
    std::string bytes = sound;
    for (std::size_t n = 1 + random() % 3; n > 0; --n)
    {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 3 == 0 ? 0xFF : random());
    }
    writeText(folder / "log", bytes);
    try
    {
      RawlogReader reader(folder / "log");
      while (reader.next())
      {
      }
      if (!reader.truncated()) ++accepted;
    }
    catch (const std::runtime_error&)
    {
      // Refused, with a reason.
    }
  }
  EXPECT_GT(accepted, kMutants / 20) << "or the mutants test nothing but the first bytes";
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 1500000) << "[kB]";
}
