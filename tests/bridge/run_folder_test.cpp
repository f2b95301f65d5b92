// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

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
