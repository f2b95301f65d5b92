// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/checked_archive.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/serialization/CArchive.h>

#include <string>

#include "io/archive/ArchiveWalk.h"
#include "io/archive/file_fault.h"

namespace sigloc::detail
{
namespace
{
/// Which reader a file of one simplemap or grid map needs.
enum class MapReader
{
  of_mrpt,
  of_mrpt_once_older,  // of a version that MRPT 2.5 does not read
  own,  // with something inside whose layout is not known
};

/// Judges a file of one simplemap or grid map. Throws ArchiveWalk::Unsound with the reason, if
/// there is one.
MapReader readerOfMapFile(const std::filesystem::path& path)
{
  GzipInput input(path);
  ArchiveWalk walk(input, ArchiveWalk::Input::consumed);
  try
  {
    walk.object(only(ArchivePart::simplemap) | only(ArchivePart::grid_map));
  }
  catch (const ArchiveWalk::Unknown&)
  {
    return MapReader::own;
  }
  return walk.isNewer() ? MapReader::of_mrpt_once_older : MapReader::of_mrpt;
}

/// Fills an object from a file of one. Returns false where MRPT must not read it.
bool take(GzipInput& input, MapReader reader, mrpt::serialization::CSerializable& object)
{
  auto* const simplemap = dynamic_cast<mrpt::maps::CSimpleMap*>(&object);
  if (reader != MapReader::of_mrpt && simplemap != nullptr)
  {
    return takeMixedSimplemap(input, *simplemap);
  }
  if (reader == MapReader::own) return false;
  if (reader == MapReader::of_mrpt_once_older)
  {
    constexpr char kGridMap = 6;  // version 7 differs from it by nothing
    const auto header = objectHeaderIn(input.peek(kLongestObjectHeader));
    if (!header) return false;
    input.change(header->size, kGridMap);
  }
  auto archive = mrpt::serialization::archiveFrom(input);
  archive.ReadObject(&object);
  return true;
}
}  // namespace

Soundness soundnessOfNext(GzipInput& input, unsigned parts)
{
  try
  {
    ArchiveWalk walk(input, ArchiveWalk::Input::kept);
    walk.object(parts);
    walk.makeOlder();
  }
  catch (const ArchiveWalk::Unsound&)
  {
    return Soundness::unsound;
  }
  catch (const ArchiveWalk::Unknown&)
  {
    return Soundness::unknown;
  }
  return Soundness::sound;
}

void readObjectFile(const std::filesystem::path& path, mrpt::serialization::CSerializable& object)
{
  GzipInput input(path);
  const std::string name = input.nextClassName();
  const auto* const expected = object.GetRuntimeClass();
  if (input.damaged()) fail(path, "truncated or damaged");
  if (name.empty()) fail(path, "not an MRPT file");
  if (mrpt::rtti::findRegisteredClass(name) != expected)
  {
    fail(path, "holds a '" + name + "', not a '" + expected->className + "'");
  }
  const bool grid = dynamic_cast<mrpt::maps::COccupancyGridMap2D*>(&object) != nullptr;
  requireIntact(path, grid ? kGridLimits : kUsualLimits);
  MapReader reader = MapReader::of_mrpt;
  try
  {
    reader = readerOfMapFile(path);
  }
  catch (const ArchiveWalk::Unsound& unsound)
  {
    fail(path, unsound.what());
  }
  bool whole = false;
  bool more = false;
  try
  {
    whole = take(input, reader, object);
    // The checksum of a compressed file comes after its last byte.
    more = !input.atEnd();
  }
  catch (const std::exception&)
  {
    whole = false;
  }
  if (!whole || input.damaged()) fail(path, "truncated or damaged");
  if (more) fail(path, "more follows its '" + name + "', and would be lost");
}
}  // namespace sigloc::detail
