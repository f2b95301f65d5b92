// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "bridge/rawlog_files.h"
#include "sigloc/localize/RunWriter.h"

using namespace sigloc;
using namespace sigloc::test;

TEST(FolderLock, IsHeldByOneAndFreedWithIt)
{
  const TemporaryFolder folder;
  auto first = std::make_unique<detail::FolderLock>(folder / "work");
  EXPECT_THROW(detail::FolderLock(folder / "work"), std::runtime_error);
  EXPECT_THROW(detail::requireNoOtherRun(folder / "work"), std::runtime_error);
  EXPECT_NO_THROW(detail::requireNoOtherRun(folder / "none"));
  first.reset();
  EXPECT_NO_THROW(detail::FolderLock(folder / "work"));
}

TEST(FolderLock, GoesWithARenamedFolder)
{
  const TemporaryFolder folder;
  const detail::FolderLock first(folder / "work");
  std::filesystem::rename(folder / "work", folder / "results");
  EXPECT_NO_THROW(detail::FolderLock(folder / "work"));
  EXPECT_THROW(detail::requireNoOtherRun(folder / "results"), std::runtime_error);
}

TEST(RunWriter, ALinkToNowhereStaysOne)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "nowhere", folder / "out");
  EXPECT_NE(messageOf<std::runtime_error>([&] { RunWriter(folder / "out", {}); }).find("is a link"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "out"));
}

TEST(RunWriter, TheFolderOfAnotherUserIsFilledAndNotReplaced)
{
  constexpr uid_t kNobody = 65534;
  if (geteuid() != 0) GTEST_SKIP() << "only root may give a folder away";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  EXPECT_FALSE(detail::isOfAnotherUser(folder / "out"));
  ASSERT_EQ(chown((folder / "out").c_str(), kNobody, kNobody), 0);
  EXPECT_TRUE(detail::isOfAnotherUser(folder / "out"));
  EXPECT_EQ(RunWriter(folder / "out", {}).workFolder(), folder / "out" / detail::kInnerWork);
}

/// Makes the folder of a run, whose summary was written some seconds after a day.
void makeFinishedRun(const std::filesystem::path& run, int seconds)
{
  std::filesystem::create_directories(run / "belief");
  const std::filesystem::path summary = run / detail::kRunSummaryFile;
  writeText(summary, "{\"steps_to_first_right\": 1, \"confidently_wrong_steps\": 0, \"steps\": " +
                         std::to_string(seconds) + "}");
  const std::filesystem::file_time_type day{};
  std::filesystem::last_write_time(summary, day + std::chrono::seconds(seconds));
}

int stepsToldBy(const std::filesystem::path& run)
{
  const std::string summary = readBytes(run / detail::kRunSummaryFile);
  return std::stoi(summary.substr(summary.rfind(' ')));
}

TEST(RunWriter, AWorkFolderThatIsALinkIsRefused)
{
  const TemporaryFolder folder;
  makeFinishedRun(folder / "kept", 1);
  std::filesystem::create_symlink("kept", folder / "out.partial");
  const std::string message = messageOf<std::runtime_error>([&] { RunWriter(folder / "out", {}); });
  EXPECT_EQ(message, (folder / "out.partial").string() + ": is a link; not overwritten");
  EXPECT_EQ(stepsToldBy(folder / "kept"), 1);
}

TEST(RunWriter, AWholeRunThatHasNotItsNameGetsItWhereItIsNewer)
{
  for (const int work : {1, 3})
  {
    const TemporaryFolder folder;
    makeFinishedRun(folder / "out", 2);
    makeFinishedRun(folder / "out.partial", work);
    RunWriter(folder / "out", {});  // one that fails
    EXPECT_EQ(stepsToldBy(folder / "out"), std::max(2, work));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.partial"));
  }
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  makeFinishedRun(folder / "out.partial", 3);
  RunWriter(folder / "out", {});
  EXPECT_EQ(stepsToldBy(folder / "out"), 3);
}

TEST(RunWriter, WhatMayNotBeWrittenIsNotReplaced)
{
  constexpr uid_t kNobody = 65534;
  const TemporaryFolder folder;
  makeFinishedRun(folder / "out", 1);
  std::filesystem::permissions(folder / "out", std::filesystem::perms(0555));
  const bool is_root = geteuid() == 0;
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  ASSERT_EQ(is_root ? seteuid(kNobody) : 0, 0);
  const std::string message =
      messageOf<std::runtime_error>([&] { detail::requireFinishedRun(folder / "out"); });
  ASSERT_EQ(is_root ? seteuid(0) : 0, 0);
  EXPECT_EQ(message, (folder / "out").string() + ": may not be written; not overwritten");
  std::filesystem::permissions(folder / "out", std::filesystem::perms(0755));
}

TEST(RunWriter, TheSecondIsRefusedAndTheFirstStaysWhole)
{
  const TemporaryFolder folder;
  const RunWriter first(folder / "out", {});
  writeText(first.workFolder() / "belief" / "step_00001.txt", "1\n");
  std::string message;
  try
  {
    const RunWriter second(folder / "out", {});
  }
  catch (const std::runtime_error& error)
  {
    message = error.what();
  }
  EXPECT_NE(message.find("another run writes here"), std::string::npos) << message;
  EXPECT_EQ(readBytes(first.workFolder() / "belief" / "step_00001.txt"), "1\n");
}
