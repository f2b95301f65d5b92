// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "sigloc/io/RawlogReader.h"

namespace sigloc::test
{
/// What is left of a log.
inline std::vector<RawlogStep> stepsOf(RawlogReader& reader)
{
  std::vector<RawlogStep> steps;
  while (auto step = reader.next()) steps.push_back(std::move(*step));
  return steps;
}

inline std::vector<RawlogStep> stepsOf(const std::filesystem::path& path,
                                       const ReadingOptions& reading = {})
{
  RawlogReader reader(path, reading);
  return stepsOf(reader);
}
}  // namespace sigloc::test
