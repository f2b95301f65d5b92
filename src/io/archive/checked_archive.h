// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/serialization/CSerializable.h>

#include <filesystem>
#include <string>

#include "io/archive/gzip_input.h"

namespace sigloc::detail
{
enum class Soundness
{
  sound,  ///< MRPT can read it
  unsound,  ///< cut off, or with a value that MRPT would crash, hang or take all memory for
  unknown,  ///< of a class, or with one inside, whose layout is not known here
};

/// Judges the next object of a log without consuming it, by an ArchiveWalk. `parts` are those that
/// it may play. A sound one of a version that MRPT 2.5 does not read gets the form that it does.
Soundness soundnessOfNext(GzipInput& input, unsigned parts);

/// True for the name of a class that a log is made of, whether it is registered or not.
bool isLogClass(const std::string& name);

/// Returns the next object of a log, or null where there is none or it is unsound. An observation
/// whose layout is not known becomes an UnreadObservation: MRPT never reads it. Exceptions of
/// MRPT's readers pass.
mrpt::serialization::CSerializable::Ptr readLogEntry(GzipInput& input);

/// Fills a simplemap that holds observations whose layout is not known, or objects of versions that
/// MRPT 2.5 does not read. The former become UnreadObservations. Returns false where it is unsound.
/// Exceptions of MRPT's readers pass.
bool takeMixedSimplemap(GzipInput& input, mrpt::maps::CSimpleMap& map);

/// Fills `object` from a file that holds one object of its class.
/// Throws std::runtime_error "path: reason" for a file that is missing, empty, truncated, damaged
/// or holds something else.
void readObjectFile(const std::filesystem::path& path, mrpt::serialization::CSerializable& object);
}  // namespace sigloc::detail
