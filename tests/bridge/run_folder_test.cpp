// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/run_folder.h"

#include <gtest/gtest.h>

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
