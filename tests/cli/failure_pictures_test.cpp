// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>

#include "command_line.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

std::vector<std::string> relocateInOffice(const std::vector<std::string>& more)
{
  std::vector<std::string> arguments = {
      "relocate",        "--map",     kOffice.string(), "--queries", kOffice.string(),
      "--method",        "signature", "--out",          "out",       "--quiet",
      "--draw-failures", "2",         "--max-queries",  "3"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// How many pixels have the colour that returns are drawn in.
int countReturnPixels(const mrpt::img::CImage& picture)
{
  int count = 0;
  for (unsigned y = 0; y < picture.getHeight(); ++y)
  {
    for (unsigned x = 0; x < picture.getWidth(); ++x)
    {
      const auto* bgr = picture.ptr<std::uint8_t>(x, y);
      if (bgr[2] > 200 && bgr[1] < 60 && bgr[0] < 60) ++count;
    }
  }
  return count;
}

TEST(FailurePictures, ShowTheFirstFailedQueries)
{
  const TemporaryFolder folder;
  // The truth is moved 5 m aside: every answer fails.
  const auto result = run(folder, "sigloc-eval", relocateInOffice({"--map-from-queries", "5,0,0"}));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const auto failures = folder / "out" / "failures";
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(failures))
  {
    names.insert(entry.path().filename().string());
    mrpt::img::CImage picture;
    ASSERT_TRUE(picture.loadFromFile(entry.path().string()));
    EXPECT_GT(picture.getWidth(), 1000U);
    // The scan is drawn twice, at the truth and at the first candidate.
    EXPECT_GT(countReturnPixels(picture), 500) << entry.path();
  }
  EXPECT_EQ(names.size(), 2U);
  EXPECT_EQ(names.count("signature-0.png"), 1U);
}

TEST(FailurePictures, OfAnEarlierRunAreRemoved)
{
  const TemporaryFolder folder;
  const auto failures = folder / "out" / "failures";
  ASSERT_EQ(run(folder, "sigloc-eval", relocateInOffice({})).exit_code, 0);
  std::filesystem::create_directories(failures / "noise-0.1");
  writeText(failures / "signature-99.png", "old");
  writeText(failures / "noise-0.1" / "lattice-office-1-2.png", "old");
  writeText(failures / "mine.png", "not ours");
  const auto result = run(folder, "sigloc-eval", relocateInOffice({"--map-from-queries", "5,0,0"}));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(failures / "signature-99.png"));
  EXPECT_FALSE(std::filesystem::exists(failures / "noise-0.1" / "lattice-office-1-2.png"));
  EXPECT_TRUE(std::filesystem::exists(failures / "signature-0.png"));
  EXPECT_TRUE(std::filesystem::exists(failures / "mine.png"));
}

TEST(FailurePictures, AreNotMadeWhereNothingFails)
{
  const TemporaryFolder folder;
  const auto result = run(folder, "sigloc-eval", relocateInOffice({}));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.md"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "failures"));
}
}  // namespace
}  // namespace sigloc
