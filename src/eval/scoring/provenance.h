// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sigloc
{
/// What a report says about how it came to be.
struct Provenance
{
  std::string command;  ///< the whole command line
  std::optional<std::uint64_t> seed = 1;  ///< none: of several runs
  std::vector<std::filesystem::path> data_files;
};

/// Version and commit, command line, seed, machine, compiler and the MD5 of every data file.
/// Throws std::runtime_error ("path: reason") for a file that cannot be read.
nlohmann::ordered_json toJson(const Provenance& provenance);

/// MD5 of a file's bytes in hex digits. Throws std::runtime_error ("path: reason").
std::string fileChecksum(const std::filesystem::path& path);
}  // namespace sigloc
