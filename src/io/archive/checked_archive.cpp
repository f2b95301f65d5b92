// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/checked_archive.h"

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>
#include <string>

#include "io/archive/ArchiveWalk.h"

namespace sigloc::detail
{
namespace
{
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason)
{
  throw std::runtime_error(path.string() + ": " + reason);
}

/// Judges a file of one simplemap or grid map. Throws ArchiveWalk::Unsound with the reason, if
/// there is one.
Soundness soundnessOfMapFile(const std::filesystem::path& path)
{
  try
  {
    GzipInput input(path);
    ArchiveWalk(input, ArchiveWalk::Input::consumed)
        .object(only(ArchivePart::simplemap) | only(ArchivePart::grid_map));
  }
  catch (const ArchiveWalk::Unknown&)
  {
    return Soundness::unknown;
  }
  return Soundness::sound;
}

/// Fills an object from a file of one. Returns false where MRPT must not read it.
bool take(GzipInput& input, Soundness soundness, mrpt::serialization::CSerializable& object)
{
  if (soundness == Soundness::unknown)
  {
    auto* const simplemap = dynamic_cast<mrpt::maps::CSimpleMap*>(&object);
    return simplemap != nullptr && takeMixedSimplemap(input, *simplemap);
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
    ArchiveWalk(input, ArchiveWalk::Input::kept).object(parts);
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
  requireFile(path);
  requireIntact(path);
  GzipInput input(path);
  const std::string name = input.nextClassName();
  const auto* const expected = object.GetRuntimeClass();
  if (input.damaged()) fail(path, "truncated or damaged");
  if (name.empty()) fail(path, "not an MRPT file");
  if (mrpt::rtti::findRegisteredClass(name) != expected)
  {
    fail(path, "holds a '" + name + "', not a '" + expected->className + "'");
  }
  Soundness soundness = Soundness::sound;
  try
  {
    soundness = soundnessOfMapFile(path);
  }
  catch (const ArchiveWalk::Unsound& unsound)
  {
    fail(path, unsound.what());
  }
  bool whole = false;
  try
  {
    whole = take(input, soundness, object);
    // The checksum of a compressed file comes after its last byte.
    input.atEnd();
  }
  catch (const std::exception&)
  {
    whole = false;
  }
  if (!whole || input.damaged()) fail(path, "truncated or damaged");
}
}  // namespace sigloc::detail
