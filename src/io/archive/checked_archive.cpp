// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/checked_archive.h"

#include <mrpt/serialization/CArchive.h>

#include <optional>
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

/// Tells why MRPT must not read a file of one simplemap or grid map. None where it may. None too
/// where the file holds a class whose layout is not known here.
std::optional<std::string> flawOfMapFile(const std::filesystem::path& path)
{
  try
  {
    GzipInput input(path);
    ArchiveWalk(input, ArchiveWalk::Input::consumed)
        .object(only(ArchivePart::simplemap) | only(ArchivePart::grid_map));
  }
  catch (const ArchiveWalk::Unsound& unsound)
  {
    return unsound.what();
  }
  catch (const ArchiveWalk::Unknown&)
  {
    // Left to MRPT.
  }
  return std::nullopt;
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
  if (const auto flaw = flawOfMapFile(path)) fail(path, *flaw);
  try
  {
    auto archive = mrpt::serialization::archiveFrom(input);
    archive.ReadObject(&object);
    // The checksum of a compressed file comes after its last byte.
    input.atEnd();
  }
  catch (const std::exception&)
  {
    fail(path, "truncated or damaged");
  }
  if (input.damaged()) fail(path, "truncated or damaged");
}
}  // namespace sigloc::detail
