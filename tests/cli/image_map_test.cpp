// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// An image alone as the map of every program that takes a map.
#include <gtest/gtest.h>

#include "command_line.h"
#include "office_image.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

constexpr const char* kResolution = "0.05";

/// The office's grid as `office.pgm`, and the `office.yaml` that goes with it.
void writeImage(const TemporaryFolder& folder)
{
  writeText(folder / "office.pgm", imageOf(officeRaster()));
  writeText(folder / "office.yaml", "image: office.pgm\nresolution: " + std::string(kResolution) +
                                        "\norigin: [0, 0, 0]\nnegate: 0\n"
                                        "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(ImageMap, withItsResolutionIsTheMapOfItsYaml)
{
  const TemporaryFolder folder;
  writeImage(folder);
  const auto featuresOf = [&](const std::vector<std::string>& arguments)
  {
    const CommandResult result = run(folder, "sigloc-map", arguments);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return result.output.substr(result.output.find("features"));
  };
  EXPECT_EQ(
      featuresOf({"build", "-i", "office.pgm", "-o", "a.sigmap", "--resolution", kResolution}),
      featuresOf({"build", "-i", "office.yaml", "-o", "b.sigmap"}));
  const std::string log = (kSources / "rawlogs/office.rawlog").string();
  const CommandResult drive =
      run(folder, "sigloc-localize",
          {"--map", "office.pgm", "--log", log, "--resolution", kResolution, "--quiet"});
  EXPECT_EQ(drive.exit_code, 0) << drive.errors;
  EXPECT_NE(drive.output.find("at the end              localized"), std::string::npos)
      << drive.output;
}

TEST(ImageMap, withoutItsResolutionIsRefusedByEveryProgram)
{
  const TemporaryFolder folder;
  writeImage(folder);
  std::filesystem::copy_file(folder / "office.pgm", folder / "alone.pgm");
  const std::string log = (kSources / "rawlogs/office.rawlog").string();
  const auto before = listing(folder);
  for (const auto& [program, arguments] : std::vector<std::pair<std::string, Arguments>>{
           {"sigloc-map", {"build", "-i", "office.pgm", "-o", "a.sigmap"}},
           {"sigloc-map", {"draw", "office.pgm", "-o", "a.png"}},
           {"sigloc-map", {"info", "office.pgm"}},
           {"sigloc-map", {"check", "office.pgm", "--out", "checked"}},
           {"sigloc-align", {"office.pgm", "office.yaml", "--picture", "a.png"}},
           {"sigloc-localize", {"--map", "office.pgm", "--log", log, "--out", "out"}},
           {"sigloc-eval",
            {"relocate", "--map", "office.pgm", "--rawlog", log, "--foreign", "--out", "eval"}}})
  {
    const CommandResult result = run(folder, program, arguments);
    EXPECT_EQ(result.exit_code, 1) << program;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
    EXPECT_NE(result.errors.find("give --resolution (a node and an ini: image_resolution), or its "
                                 ".yaml file; did you mean 'office.yaml'"),
              std::string::npos)
        << result.errors;
    EXPECT_EQ(listing(folder), before) << program;
  }
  const CommandResult alone = run(folder, "sigloc-map", {"info", "alone.pgm"});
  EXPECT_EQ(alone.errors.find("did you mean"), std::string::npos) << alone.errors;
  for (const char* const resolution : {"0", "-1", "nan", "20", "coarse"})
  {
    const CommandResult result =
        run(folder, "sigloc-map", {"info", "office.pgm", "--resolution", resolution});
    EXPECT_EQ(result.exit_code, 1) << resolution;
    EXPECT_EQ(countLines(result.errors), 1) << result.errors;
  }
}

TEST(ImageMap, resolutionIsRefusedForMapsThatNeedNone)
{
  const TemporaryFolder folder;
  writeImage(folder);
  const std::string log = (kSources / "rawlogs/office.rawlog").string();
  const auto before = listing(folder);
  for (const std::string& map : {std::string("office.yaml"), kOffice.string()})
  {
    for (auto& [program, arguments] : std::vector<std::pair<std::string, Arguments>>{
             {"sigloc-map", {"build", "-i", map, "-o", "a.sigmap"}},
             {"sigloc-map", {"draw", map, "-o", "a.png"}},
             {"sigloc-map", {"info", map}},
             {"sigloc-map", {"check", map, "--out", "checked"}},
             {"sigloc-align", {map, map, "--picture", "a.png"}},
             {"sigloc-localize", {"--map", map, "--log", log, "--out", "out"}},
             {"sigloc-eval",
              {"relocate", "--map", map, "--rawlog", log, "--foreign", "--out", "eval"}}})
    {
      arguments.insert(arguments.end(), {"--resolution", "0.5"});
      const CommandResult result = run(folder, program, arguments);
      EXPECT_EQ(result.exit_code, 1) << program;
      EXPECT_EQ(result.errors,
                program + ": " + map +
                    ": has its own resolution, or needs none; leave --resolution out\n");
      EXPECT_EQ(result.output, "");
      EXPECT_EQ(listing(folder), before) << program;
    }
  }
}

TEST(PointMap, ofNoUseIsRefusedAndNothingIsWritten)
{
  for (const char* const name : {"bad.ply", "bad.pcd"})
  {
    for (const Damage damage : {Damage::missing, Damage::empty, Damage::foreign, Damage::random})
    {
      const TemporaryFolder folder;
      makeBadFile(damage, kLabMap, folder / name);
      const auto before = listing(folder);
      const CommandResult result =
          run(folder, "sigloc-map", {"build", "-i", name, "-o", "m.sigmap"});
      EXPECT_EQ(result.exit_code, 1);
      EXPECT_EQ(countLines(result.errors), 1) << result.errors;
      EXPECT_NE(result.errors.find(name), std::string::npos) << result.errors;
      EXPECT_EQ(listing(folder), before);
    }
  }
}
}  // namespace
}  // namespace sigloc
