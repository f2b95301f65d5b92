// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/provenance.h"

#include <commit.h>  // generated: kCommit
#include <mrpt/system/md5.h>
#include <mrpt/system/os.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

namespace sigloc
{
namespace
{
std::string processorName()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
  {
    const bool model = line.rfind("model name", 0) == 0;
    const std::size_t colon = line.find(": ");
    if (model && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}
}  // namespace

std::string fileChecksum(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw std::runtime_error(path.string() + ": cannot be read");
  return mrpt::system::md5(bytes.data(), bytes.size());
}

nlohmann::ordered_json toJson(const Provenance& provenance)
{
  nlohmann::ordered_json json;
  json["version"] = SIGLOC_VERSION;
  json["commit"] = kCommit;
  json["mrpt"] = mrpt::system::MRPT_getVersion();
  json["command"] = provenance.command;
  if (provenance.seed) json["seed"] = *provenance.seed;
  json["processor"] = processorName();
  json["processors"] = std::thread::hardware_concurrency();
  json["compiler"] = __VERSION__;
  json["data"] = nlohmann::ordered_json::array();
  for (const auto& path : provenance.data_files)
  {
    json["data"].push_back({{"file", path.string()}, {"md5", fileChecksum(path)}});
  }
  return json;
}
}  // namespace sigloc
