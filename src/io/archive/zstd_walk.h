// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace sigloc::detail
{
/// Returns up to `count` bytes of a file from a place on.
using BytesAt = std::function<std::string(std::uint64_t place, std::size_t count)>;

/// What is known of the contents of a packed file before it is unpacked.
struct PackedContents
{
  std::uint64_t least = 0;  ///< bytes, unless the file is damaged
  std::uint64_t most = UINT64_MAX;  ///< bytes
  bool cut_off = false;  ///< it ends within a frame
};

/// A hole in a file may be read as blocks of nothing, for ever. So many bytes without output are
/// damage. Frames that are skipped are shorter.
constexpr std::uint64_t kMostWithoutOutput = 1U << 24U;

/// Walks over the heads of all frames and blocks of zstd (RFC 8878, section 3.1) and unpacks none,
/// so a hostile file costs neither memory nor time. Sizes end where the walk meets damage, which
/// unpacking will tell of.
PackedContents walkZstd(const BytesAt& bytes_at);
}  // namespace sigloc::detail
