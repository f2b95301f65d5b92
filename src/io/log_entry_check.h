// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/serialization/CSerializable.h>

#include "io/gzip_input.h"

namespace sigloc::detail
{
enum class Soundness
{
  sound,  ///< MRPT can read it
  unsound,  ///< cut off, or with a value that MRPT would crash, hang or take all memory for
  unknown,  ///< of a class, or with one inside, whose layout is not known here
};

/// Judges the next object of a log without consuming it. MRPT's readers believe every count and
/// every class name. This walks the bytes of the classes that sigloc uses, in all versions that
/// MRPT 2.5 reads, and compares each count with the bytes that are there.
Soundness soundnessOfNext(GzipInput& input);

/// Returns the next object of a log, or null where there is none or it is unsound. Exceptions of
/// MRPT's readers pass.
mrpt::serialization::CSerializable::Ptr readLogEntry(GzipInput& input);
}  // namespace sigloc::detail
