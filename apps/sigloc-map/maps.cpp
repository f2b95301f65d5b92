// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "arguments.h"
#include "check_command.h"
#include "json_text.h"
#include "picture_file.h"
#include "pictures.h"
#include "progress_line.h"
#include "sigloc/config/plural.h"
#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"
#include "sigloc/localize/LocalizationSetup.h"
#include "warn.h"

namespace
{
using nlohmann::ordered_json;

constexpr const char* kProgram = "sigloc-map";

ordered_json describe(const sigloc::FeatureMap& map, const std::filesystem::path& path)
{
  std::array<std::size_t, sigloc::kFeatureTypes> counts{};
  for (const sigloc::Feature& feature : map.features())
  {
    ++counts.at(sigloc::typeIndex(feature.type));
  }
  ordered_json info;
  info["file"] = path.string();
  info["bytes"] = std::filesystem::file_size(path);
  info["features"] = map.features().size();
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    info[sigloc::kFeatureTraits[i].plural] = counts[i];
  }
  info["lines"] = map.lines().size();
  const sigloc::PlanarBox box = sigloc::boundsOf(map);
  info["bounds_m"] = {box.x_min, box.x_max, box.y_min, box.y_max};
  info[map.field() ? "free_area_m2" : "box_area_m2"] = map.area();
  info["dense_field"] = nullptr;
  if (map.field())
  {
    info["dense_field"] = {{"width", map.field()->frame.width},
                           {"height", map.field()->frame.height},
                           {"resolution_m", map.field()->frame.resolution}};
  }
  info["source"] = map.provenance().source_path;
  info["source_checksum"] = map.provenance().source_checksum;
  return info;
}

/// A map of any kind, with the warnings about it.
sigloc::FeatureMap anyMap(const std::filesystem::path& path, const sigloc::LocalizationSetup& setup)
{
  sigloc::ProgressLine progress;
  sigloc::FeatureMap map = sigloc::buildMapFromFile(
      path, setup.map, setup.features,
      [&](double share) { progress.showBar("building the map", share); }, setup.reading);
  progress.finish();
  sigloc::warn(kProgram, path, sigloc::warningOfMapSource(path));
  sigloc::warn(kProgram, path, sigloc::warningOfMap(map));
  return map;
}

sigloc::LocalizationSetup setupOf(const sigloc::MapArguments& arguments)
{
  sigloc::LocalizationSetup setup;
  setup.reading = arguments.reading.in({arguments.input});
  return setup;
}

/// Throws std::runtime_error where the map would replace its own source, or is not named as one.
/// Programs take a file for what its name says.
void checkBuildOutput(const std::filesystem::path& input, const std::filesystem::path& output,
                      const std::filesystem::path& config)
{
  std::vector<std::filesystem::path> inputs = sigloc::filesOfMapSource(input);
  inputs.push_back(config);
  sigloc::refuseToReplaceInputs(output, inputs);
  if (output.extension() != ".sigmap")
  {
    const bool exists = std::filesystem::exists(output);
    throw std::runtime_error(output.string() + ": a map's name must end in .sigmap" +
                             (exists ? "; not overwritten" : ""));
  }
  sigloc::checkWritableFile(output);
}

void build(const sigloc::MapArguments& arguments)
{
  const auto& [input, output, config] =
      std::tie(arguments.input, arguments.output, arguments.config);
  checkBuildOutput(input, output, config);
  sigloc::LocalizationSetup setup;
  if (!config.empty()) setup = sigloc::readOptionSections(config);
  setup.reading = arguments.reading.in({input}, setup.reading);
  const sigloc::FeatureMap map = anyMap(input, setup);
  sigloc::HeldWarnings(config, setup.warnings).print(kProgram);
  sigloc::saveSigmap(map, output);
  std::cout << output.string() << ": " << map.features().size() << " features\n";
}

/// A value of a description, for people.
std::string textOf(const ordered_json& value)
{
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.2f}", value.get<double>());
  if (value.is_null()) return "none";
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [key, part] : value.items())
  {
    text += (text.empty() ? "" : ", ") + (value.is_object() ? key + " " : "") + textOf(part);
  }
  return text;
}

void info(const sigloc::MapArguments& arguments)
{
  const ordered_json description =
      describe(anyMap(arguments.input, setupOf(arguments)), arguments.input);
  if (arguments.as_json)
  {
    std::cout << sigloc::jsonText(description);
    return;
  }
  for (const auto& [key, value] : description.items())
  {
    // What a file tells of its source may be of any length, with line ends and colours in it.
    std::cout << sigloc::oneLine(key + ": " + textOf(value)) << '\n';
  }
}

/// The map, and its source where that is beside it or in the current folder.
std::vector<std::filesystem::path> filesBehind(const std::filesystem::path& path,
                                               const sigloc::FeatureMap& map)
{
  const std::filesystem::path source = map.provenance().source_path;
  std::vector<std::filesystem::path> files = {path};
  for (const auto& candidate : {path, path.parent_path() / source.filename(), source})
  {
    try
    {
      const auto behind = sigloc::filesOfMapSource(candidate);
      files.insert(files.end(), behind.begin(), behind.end());
    }
    catch (const std::runtime_error&)
    {
      // The source is gone or has changed, so only the map can be used.
    }
  }
  return files;
}

void draw(const sigloc::MapArguments& arguments)
{
  const auto& [path, output] = std::tie(arguments.input, arguments.output);
  if (output.extension() != ".png")
  {
    throw std::runtime_error(output.string() + ": the name of a picture ends in .png");
  }
  sigloc::checkWritableFile(output);
  const sigloc::FeatureMap map = anyMap(path, setupOf(arguments));
  sigloc::refuseToReplaceInputs(output, filesBehind(path, map));
  sigloc::PictureMaker pictures(map);
  const std::string title =
      fmt::format("{}: {}, {} m2", path.filename().string(),
                  sigloc::counted(map.features().size(), "feature"), std::lround(map.area()));
  sigloc::savePicture(pictures.mapPicture({title}), output);
}
}  // namespace

int siglocMap(const sigloc::MapArguments& arguments)
{
  switch (arguments.command)
  {
    case sigloc::MapCommand::build:
      build(arguments);
      break;
    case sigloc::MapCommand::info:
      info(arguments);
      break;
    case sigloc::MapCommand::draw:
      draw(arguments);
      break;
    case sigloc::MapCommand::check:
      sigloc::runCheck(arguments, kProgram);
      break;
  }
  return 0;
}
