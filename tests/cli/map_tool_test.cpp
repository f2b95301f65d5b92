// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "command_line.h"
#include "picture_pixels.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
using nlohmann::json;

TEST(Commands, mapsOfEveryKindAreDescribedAndDrawn)
{
  const TemporaryFolder folder;
  for (const std::filesystem::path& map :
       {kLabMap, kSources / "maps/office.gridmap.gz", kSources / "maps/office.simplemap"})
  {
    const CommandResult info = run(folder, "sigloc-map", {"info", map.string(), "--json"});
    ASSERT_EQ(info.exit_code, 0) << info.errors;
    EXPECT_EQ(info.errors, "");
    EXPECT_GT(json::parse(info.output)["features"], 10);
    const CommandResult drawn = run(folder, "sigloc-map", {"draw", map.string(), "-o", "map.png"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.errors;
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile((folder / "map.png").string()));
    EXPECT_GT(pixelsLike(picture, mrpt::img::TColor(31, 78, 160)), 500) << "walls";
    const mrpt::img::TColor axes(90, 90, 90);
    EXPECT_GT(pixelsLike(picture, axes), 900) << "axes and scale bar";
  }
}

TEST(Commands, equalMapsAreEqualBytesWhereverTheyAreBuilt)
{
  const TemporaryFolder folder;
  for (const char* const place : {"here", "there"})
  {
    std::filesystem::create_directory(folder / place);
    std::filesystem::copy_file(kLabMap, folder / place / "lab.simplemap.gz");
    const std::string stem = std::string(place) + "/lab";
    ASSERT_EQ(
        run(folder, "sigloc-map",
            {"build", "-i", (folder / (stem + ".simplemap.gz")).string(), "-o", stem + ".sigmap"})
            .exit_code,
        0);
  }
  EXPECT_TRUE(readBytes(folder / "here/lab.sigmap") == readBytes(folder / "there/lab.sigmap"));
}

TEST(Commands, helpExitsZero)
{
  const TemporaryFolder folder;
  for (const char* const program : {"sigloc-map", "sigloc-localize"})
  {
    const CommandResult result = run(folder, program, {"--help"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.output.find("sage"), std::string::npos);
  }
}

TEST(Commands, mapIsBuiltDescribedAndDrawn)
{
  const TemporaryFolder folder;
  const CommandResult built =
      run(folder, "sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"});
  EXPECT_EQ(built.exit_code, 0) << built.errors;
  EXPECT_EQ(built.errors, "");
  const CommandResult info = run(folder, "sigloc-map", {"info", "lab.sigmap", "--json"});
  ASSERT_EQ(info.exit_code, 0) << info.errors;
  const json description = json::parse(info.output);
  EXPECT_GT(description["segments"], 10);
  EXPECT_EQ(description["source"], kLabMap.filename().string());
  const CommandResult drawn = run(folder, "sigloc-map", {"draw", "lab.sigmap", "-o", "lab.png"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.errors;
  EXPECT_EQ(drawn.errors, "");
  EXPECT_EQ(readBytes(folder / "lab.png").substr(1, 3), "PNG");
}
}  // namespace
}  // namespace sigloc
