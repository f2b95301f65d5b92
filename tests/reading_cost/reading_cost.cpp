// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What it costs to read logs so that no byte of them can hurt. Three readers take turns:
//
//     plain    MRPT's own, which a changed byte may end by a signal
//     checked  ours, which checks each object before MRPT reads it
//     helper   MRPT's own in a child process, whose objects come through a pipe
//
// The scans of all three are made LaserScans, and counted.
//
//     reading_cost LOG...
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/io/CPipe.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "io/scan_conversion.h"
#include "sigloc/io/RawlogReader.h"

namespace
{
using mrpt::obs::CObservation2DRangeScan;
using mrpt::serialization::CSerializable;

std::size_t scansIn(const CSerializable::Ptr& object)
{
  std::vector<mrpt::obs::CObservation::Ptr> observations;
  if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    observations.assign(frame->begin(), frame->end());
  if (const auto single = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
    observations.push_back(single);
  std::size_t scans = 0;
  for (const auto& observation : observations)
  {
    const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation);
    if (scan && sigloc::toLaserScan(*scan)) ++scans;
  }
  return scans;
}

/// Calls `use(object)` for all objects of a stream, by MRPT alone.
template <class Use>
void forAllIn(mrpt::io::CStream& stream, const Use& use)
{
  auto archive = mrpt::serialization::archiveFrom(stream);
  try
  {
    while (true) use(archive.ReadObject());
  }
  catch (const std::exception&)
  {
    // MRPT tells the end so.
  }
}

std::size_t readPlain(const std::string& path)
{
  mrpt::io::CFileGZInputStream file(path);
  std::size_t scans = 0;
  forAllIn(file, [&](const CSerializable::Ptr& object) { scans += scansIn(object); });
  return scans;
}

std::size_t readChecked(const std::string& path)
{
  sigloc::RawlogReader reader(path);
  std::size_t scans = 0;
  while (const auto step = reader.next()) scans += step->scans.size();
  return scans;
}

/// The child: sends each object as MRPT writes it, after its size. In pieces, since a call of the
/// system for every number would make a helper slower than it needs to be.
void sendObjects(const std::string& path, mrpt::io::CStream& to)
{
  mrpt::io::CFileGZInputStream file(path);
  forAllIn(file,
           [&](const CSerializable::Ptr& object)
           {
             mrpt::io::CMemoryStream bytes;
             mrpt::serialization::archiveFrom(bytes) << *object;
             const std::uint64_t size = bytes.getTotalBytesCount();
             to.Write(&size, sizeof(size));
             to.Write(bytes.getRawBufferData(), size);
           });
}

std::size_t readByHelper(const std::string& path)
{
  std::unique_ptr<mrpt::io::CPipeReadEndPoint> from_helper;
  std::unique_ptr<mrpt::io::CPipeWriteEndPoint> to_us;
  mrpt::io::CPipe::createPipe(from_helper, to_us);
  const pid_t child = fork();
  if (child == 0)
  {
    from_helper.reset();
    sendObjects(path, *to_us);
    _exit(0);
  }
  to_us.reset();
  std::size_t scans = 0;
  std::uint64_t size = 0;
  std::vector<char> bytes;
  while (from_helper->Read(&size, sizeof(size)) == sizeof(size))
  {
    bytes.resize(size);
    if (from_helper->Read(bytes.data(), size) != size) break;
    mrpt::io::CMemoryStream memory;
    memory.assignMemoryNotOwn(bytes.data(), size);
    scans += scansIn(mrpt::serialization::archiveFrom(memory).ReadObject());
  }
  waitpid(child, nullptr, 0);
  return scans;
}

struct Reader
{
  const char* name;
  std::size_t (*read)(const std::string& path);
};
constexpr std::array<Reader, 3> kReaders = {
    {{"plain", readPlain}, {"checked", readChecked}, {"helper", readByHelper}}};

void compare(const std::string& path)
{
  constexpr int kTurns = 9;
  std::array<std::vector<double>, kReaders.size()> seconds;
  std::array<std::size_t, kReaders.size()> scans{};
  for (int turn = 0; turn < kTurns; ++turn)
  {
    for (std::size_t i = 0; i < kReaders.size(); ++i)
    {
      const auto begin = std::chrono::steady_clock::now();
      scans[i] = kReaders[i].read(path);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      seconds[i].push_back(taken.count());
    }
  }
  std::printf("%s\n", path.c_str());
  for (std::size_t i = 0; i < kReaders.size(); ++i)
  {
    const auto median = [&](std::vector<double> times)
    {
      std::nth_element(times.begin(), times.begin() + kTurns / 2, times.end());
      return times[kTurns / 2];
    };
    std::printf("  %-8s %6zu scans  %.3f s  %.2f of plain\n", kReaders[i].name, scans[i],
                median(seconds[i]), median(seconds[i]) / median(seconds[0]));
  }
}
}  // namespace

int main(int argc, char** argv)
{
  for (int i = 1; i < argc; ++i) compare(argv[i]);
  return argc > 1 ? 0 : 1;
}
