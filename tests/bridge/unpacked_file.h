// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "io/archive/gzip_input.h"

namespace sigloc::test
{
/// The first bytes of a sound file without their packing.
inline std::string unpacked(const std::filesystem::path& path,
                            std::size_t most = std::size_t{1} << 22U)
{
  detail::GzipInput input(path);
  std::string bytes(most, '\0');
  bytes.resize(input.Read(bytes.data(), bytes.size()));
  EXPECT_FALSE(input.damaged());
  return bytes;
}
}  // namespace sigloc::test
