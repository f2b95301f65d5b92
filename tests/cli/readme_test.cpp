// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
//
// README.md does what it says. Its shell commands are run as they are written, one after the other.
// Their folder has the map and the log of a newcomer, and the ini files of the page.
#include <gtest/gtest.h>

#include <sstream>

#include "command_line.h"
#include "office_image.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;
namespace fs = std::filesystem;

/// The texts of the page's code blocks of one kind.
std::vector<std::string> blocksOf(const std::string& kind)
{
  std::vector<std::string> blocks;
  std::istringstream page(readBytes(kSources / "README.md"));
  bool inside = false;
  for (std::string line; std::getline(page, line);)
  {
    if (!inside && line == "```" + kind)
    {
      inside = true;
      blocks.emplace_back();
    }
    else if (line.rfind("```", 0) == 0)
    {
      inside = false;
    }
    else if (inside)
    {
      blocks.back() += line + "\n";
    }
  }
  return blocks;
}

/// The office's grid as `my_map.yaml` with its image.
void writeRosMap(const TemporaryFolder& folder)
{
  const OccupancyRaster raster = officeRaster();
  writeText(folder / "my_map.pgm", imageOf(raster));
  std::ostringstream yaml;
  yaml << "image: my_map.pgm\nresolution: " << raster.frame.resolution << "\norigin: ["
       << raster.frame.origin.x << ", " << raster.frame.origin.y
       << ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  writeText(folder / "my_map.yaml", yaml.str());
}

/// The walls of the office as `my_points.ply`, one point a cell.
void writePoints(const TemporaryFolder& folder)
{
  const OccupancyRaster raster = officeRaster();
  const RasterFrame& frame = raster.frame;
  std::ostringstream rows;
  std::size_t count = 0;
  for (std::size_t i = 0; i < raster.cells.size(); ++i)
  {
    if (!isWall(raster.cells[i])) continue;
    ++count;
    rows << frame.origin.x + (static_cast<double>(i % frame.width) + 0.5) * frame.resolution << " "
         << frame.origin.y + (static_cast<double>(i / frame.width) + 0.5) * frame.resolution
         << " 0.5\n";
  }
  writeText(folder / "my_points.ply", "ply\nformat ascii 1.0\nelement vertex " +
                                          std::to_string(count) +
                                          "\nproperty float x\nproperty float y\nproperty float z\n"
                                          "end_header\n" +
                                          rows.str());
}

/// Writes the page's code blocks of one kind, which begin with their names: "# my.ini".
void writeFilesOfPage(const TemporaryFolder& folder, const std::string& kind,
                      const std::string& extension)
{
  for (const std::string& block : blocksOf(kind))
  {
    const std::string name = block.substr(2, block.find('\n') - 2);
    ASSERT_EQ(fs::path(name).extension(), extension) << "a file begins with its name: " << block;
    writeText(folder / name, block);
  }
}

TEST(Readme, itsCommandsDoWhatItSays)
{
  const TemporaryFolder folder;
  writeRosMap(folder);
  writePoints(folder);
  fs::copy_file(kSources / "maps/office.simplemap", folder / "my_map.simplemap");
  fs::copy_file(kSources / "rawlogs/office.rawlog", folder / "my_drive.rawlog");
  fs::create_directory(folder / "build");
  fs::create_directory_symlink(fs::path(SIGLOC_BIN_FOLDER).parent_path(), folder / "build/release");
  writeFilesOfPage(folder, "ini", ".ini");
  writeFilesOfPage(folder, "python", ".py");
  // The module is for the system's Python, and another may come first in the path of this machine.
  std::string commands = "set -e\nexport PATH=/usr/bin:$PATH\n";
  for (const std::string& block : blocksOf("sh")) commands += block;
  for (const char* const command :
       {"sigloc-map build", "--resolution", "my_points.ply", "sigloc-map draw", "sigloc-map check",
        "--map", "my.ini", "rawlog-edit", "LD_PRELOAD", "python3"})
  {
    EXPECT_NE(commands.find(command), std::string::npos) << "README.md shows no " << command;
  }
  writeText(folder / "commands.sh", commands);
  const CommandResult result = runShell(folder, "sh commands.sh");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(readBytes(folder / "my_map.png").substr(1, 3), "PNG");
  EXPECT_EQ(readBytes(folder / "check/check.png").substr(1, 3), "PNG");
  EXPECT_EQ(readBytes(folder / "align.png").substr(1, 3), "PNG");
  const auto summary = summaryOf(folder, "answer");
  EXPECT_EQ(summary["final_verdict"], "localized");
  for (const char* const name : {"report.html", "path.tum", "path_unsure.tum", "annotated.rawlog",
                                 "steps.csv", "pictures", "3D", "belief"})
  {
    EXPECT_TRUE(fs::exists(folder / "answer" / name)) << name;
  }
  EXPECT_NE(result.output.find("Overall number of objects"), std::string::npos) << "rawlog-edit";
  EXPECT_NE(result.output.find("\nlocalized [ 4."), std::string::npos) << result.output;
}

// What installs and builds is run by CI itself; here only that it is there.
TEST(Readme, itsScriptsExist)
{
  std::size_t count = 0;
  for (const std::string& block : blocksOf("console"))
  {
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);)
    {
      if (line.rfind("$ ", 0) != 0) continue;
      ++count;
      const std::string program = line.substr(2, line.find(' ', 2) - 2);
      EXPECT_TRUE(fs::exists(kSources / program)) << line;
    }
  }
  EXPECT_GE(count, 3U);
}
}  // namespace
}  // namespace sigloc
