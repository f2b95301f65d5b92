// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "sigloc/io/map_files.h"
#include "support/golden.h"

using namespace sigloc;

namespace
{
const std::filesystem::path kMaps = "/usr/share/mrpt/datasets";
const std::filesystem::path kGolden =
    std::filesystem::path(SIGLOC_GOLDEN_FOLDER) / "built_maps.csv";

/// How a map was built, and what came of it.
struct Built
{
  std::string options_digest;
  std::string content;
};

/// Coarse, so that another compiler's rounding does not show.
std::string contentOf(const FeatureMap& map)
{
  std::map<FeatureType, int> counts;
  double wall_length = 0;
  double spread = 0;
  mrpt::math::TPoint2D sum;
  std::uint64_t sightings = 0;
  for (const Feature& feature : map.features())
  {
    ++counts[feature.type];
    if (isSegment(feature.type)) wall_length += feature.size;
    sum += feature.position;
    spread += feature.position_covariance(0, 0) + feature.position_covariance(1, 1);
    sightings += feature.sightings;
  }
  return fmt::format("{} {} {} {} {:.1f} {:.0f} {:.0f} {:.3f} {} {}", counts[FeatureType::segment],
                     counts[FeatureType::circle], counts[FeatureType::corner],
                     counts[FeatureType::wall_end], wall_length, sum.x, sum.y, spread, sightings,
                     map.field()->wall_cells);
}

Built build(const std::string& name)
{
  const FeatureMap map = buildMapFromFile(kMaps / name, {}, {});
  return {map.provenance().options_digest, contentOf(map)};
}

std::map<std::string, Built> readGolden()
{
  std::map<std::string, Built> golden;
  std::ifstream in(kGolden);
  std::string line;
  while (std::getline(in, line))
  {
    std::istringstream row(line);
    std::string name;
    Built built;
    std::getline(row, name, ',');
    std::getline(row, built.options_digest, ',');
    std::getline(row, built.content);
    golden[name] = built;
  }
  return golden;
}
}  // namespace

/// Maps that an older program built lie in the users' caches. They are built anew only where their
/// digest is not that of today's program.
TEST(BuildVersion, IsRaisedWithEveryChangeOfWhatIsBuilt)
{
  const std::map<std::string, Built> golden = readGolden();
  std::map<std::string, Built> built;
  for (const std::string name :
       {"localization_demo.simplemap.gz", "uwb_ro-localization_demo_map.gridmap.gz"})
  {
    built[name] = build(name);
    const auto before = golden.find(name);
    if (before == golden.end() || before->second.content == built[name].content) continue;
    ASSERT_NE(before->second.options_digest, built[name].options_digest)
        << name << " is built otherwise: raise kBuildVersion in src/io/maps/map_sources.cpp";
  }
  if (test::writesGolden())
  {
    std::ofstream out(kGolden);
    for (const auto& [name, map] : built)
    {
      out << name << ',' << map.options_digest << ',' << map.content << '\n';
    }
    return;
  }
  ASSERT_EQ(golden.size(), built.size());
  for (const auto& [name, map] : built)
  {
    EXPECT_EQ(golden.at(name).content, map.content)
        << name << ": if that is meant, write it anew: scripts/update_golden maps";
    EXPECT_EQ(golden.at(name).options_digest, map.options_digest)
        << name << ": scripts/update_golden maps";
  }
}
