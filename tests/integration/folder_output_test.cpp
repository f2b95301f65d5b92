// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/data/folder_output.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "bridge/rawlog_files.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::writeText;

std::ptrdiff_t entriesOf(const fs::path& folder)
{
  return std::distance(fs::directory_iterator(folder), {});
}

TEST(FolderOutput, isThereAsAWholeOrNotAtAll)
{
  const TemporaryFolder folder;
  const fs::path out = folder / "a/b";
  const auto fail = [&](const fs::path& part)
  {
    writeText(part / "one", "1");
    throw std::runtime_error((part / "two").string() + ": no room");
  };
  EXPECT_EQ(test::messageOf<std::runtime_error>([&] { fillFolder(out, fail); }),
            (out / "two").string() + ": no room");
  EXPECT_EQ(entriesOf(folder.path()), 0);
  fillFolder(out, [](const fs::path& part) { writeText(part / "one", "1"); });
  EXPECT_EQ(entriesOf(out), 1);
  EXPECT_TRUE(fs::exists(out / "one"));
}

TEST(FolderOutput, removesWhatKilledRunsLeft)
{
  const TemporaryFolder folder;
  const fs::path mine = folder / ".part-mine";  // of no run: it has no lock file
  const fs::path dead = folder / ".part-abcdef";
  fs::create_directory(mine);
  // A run that goes on locks its part. A copy of it is like the part that a killed run left.
  fillFolder(folder.path(),
             [&](const fs::path& running)
             {
               fs::copy(running, dead, fs::copy_options::recursive);
               ASSERT_GT(entriesOf(dead), 0);
               fillFolder(folder.path(), [](const fs::path& part) { writeText(part / "a", "1"); });
               EXPECT_FALSE(fs::exists(dead));
               EXPECT_TRUE(fs::exists(running));
               EXPECT_TRUE(fs::exists(mine));
               writeText(running / "b", "2");
             });
  EXPECT_EQ(entriesOf(folder.path()), 3) << "a, b and mine";
}
}  // namespace
}  // namespace sigloc
