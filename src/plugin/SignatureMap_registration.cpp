// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// How MRPT creates, configures and stores a SignatureMap.
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <utility>

#include "io/options_archive.h"
#include "plugin/map_builder_archive.h"
#include "plugin/SignatureMap_state.h"
#include "sigloc/io/map_files.h"
#include "sigloc/plugin/SignatureMap.h"

// MRPT 2.5 ignores the namespace and the case when it searches for `SignatureMap_count`. MRPT 2.14
// wants the name without its namespace, letter by letter. A second name would make a second map.
MAP_DEFINITION_REGISTER("sigloc::SignatureMap", sigloc::SignatureMap)
IMPLEMENTS_SERIALIZABLE(SignatureMap, mrpt::maps::CMetricMap, sigloc)

namespace sigloc
{
using mrpt::config::CConfigFileBase;
using mrpt::serialization::CArchive;

namespace
{
// Made when the library is linked, preloaded or opened as a plug-in. It comes after the class's
// identity, which clang, unlike g++, sets up no earlier; so MRPT_INITIALIZER would not do.
[[maybe_unused]] const bool kRegistered = (mrpt::rtti::registerClass(CLASS_ID(SignatureMap)), true);

/// Copies the keys of a section that `wanted` accepts.
template <class Wanted>
mrpt::config::CConfigFileMemory copyOf(const CConfigFileBase& source, const std::string& section,
                                       const Wanted& wanted)
{
  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  mrpt::config::CConfigFileMemory copy;
  for (const std::string& key : keys)
  {
    if (wanted(key)) copy.write(section, key, source.read_string(section, key, ""));
  }
  return copy;
}

bool isBuildingKey(const std::string& key)
{
  const auto keys = optionKeys<MapBuildingOptions>();
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}
}  // namespace

void SignatureMap::TInsertionOptions::loadFromConfigFile(const CConfigFileBase& source,
                                                         const std::string& section)
{
  const auto of_building = copyOf(source, section, isBuildingKey);
  const auto of_extraction =
      copyOf(source, section, [](const std::string& key) { return !isBuildingKey(key); });
  building = loadOptions(of_building, section, building);
  extraction = loadOptions(of_extraction, section, extraction);
}

void SignatureMap::TInsertionOptions::saveToConfigFile(CConfigFileBase& target,
                                                       const std::string& section) const
{
  saveOptions(building, target, section);
  saveOptions(extraction, target, section);
}

void SignatureMap::TLikelihoodOptions::loadFromConfigFile(const CConfigFileBase& source,
                                                          const std::string& section)
{
  points = loadOptions(source, section, points);
}

void SignatureMap::TLikelihoodOptions::saveToConfigFile(CConfigFileBase& target,
                                                        const std::string& section) const
{
  saveOptions(points, target, section);
}

SignatureMap::TMapDefinition::TMapDefinition() = default;

void SignatureMap::TMapDefinition::loadFromConfigFile_map_specific(
    const CConfigFileBase& source, const std::string& section_prefix)
{
  sigmap_file = source.read_string(section_prefix + "_creationOpts", "sigmap_file", sigmap_file);
  insertion_options.loadFromConfigFile(source, section_prefix + "_insertOpts");
  likelihood_options.loadFromConfigFile(source, section_prefix + "_likelihoodOpts");
}

void SignatureMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  out << "sigmap_file = " << sigmap_file << '\n';
  insertion_options.dumpToTextStream(out);
  likelihood_options.dumpToTextStream(out);
}

// A plain pointer, and since MRPT 2.11.3 a shared one.
using CreatedMap = decltype(SignatureMap::internal_CreateFromMapDefinition(
    std::declval<const mrpt::maps::TMetricMapInitializer&>()));

CreatedMap SignatureMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& def)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(def);
  auto map = definition.sigmap_file.empty()
                 ? std::make_unique<SignatureMap>()
                 : std::make_unique<SignatureMap>(loadSigmap(definition.sigmap_file));
  map->insertion_options = definition.insertion_options;
  map->likelihood_options = definition.likelihood_options;
  return CreatedMap(map.release());
}

std::uint8_t SignatureMap::serializeGetVersion() const
{
  return 1;
}

void SignatureMap::serializeTo(CArchive& out) const
{
  out << genericMapParams;
  detail::writeOptions(insertion_options.building, out);
  detail::writeOptions(insertion_options.extraction, out);
  detail::writeOptions(likelihood_options.points, out);
  writeFeatureMap(*prepared_map_, out);
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  out << learnt_->builder.has_value();
  if (learnt_->builder) detail::writeMapBuilder(*learnt_->builder, out);
}

void SignatureMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  // Read into another map, so that this one stays as it was where the archive is bad.
  SignatureMap read;
  in >> read.genericMapParams;
  read.insertion_options.building = detail::readOptions<MapBuildingOptions>(in);
  read.insertion_options.extraction = detail::readOptions<FeatureExtractorOptions>(in);
  read.likelihood_options.points = detail::readOptions<PointLikelihoodOptions>(in);
  read.prepared_map_ = std::make_shared<FeatureMap>(readFeatureMap(in));
  // Version 0 stored the finished map alone.
  const bool has_builder = version >= 1 && detail::readFlag(in);
  if (has_builder) read.learnt_->builder = detail::readMapBuilder(in, read.baseMap());
  *this = read;
}
}  // namespace sigloc
