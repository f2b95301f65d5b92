// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/file_output.h"

#include <gtest/gtest.h>
#include <mrpt/serialization/CArchive.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <random>
#include <utility>

#include "rawlog_files.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using test::messageOf;
using test::readBytes;
using test::TemporaryFolder;

/// While an object exists, no file can grow beyond a given size, as on a full disk.
class SmallFiles
{
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
  {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFiles()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

std::ptrdiff_t entriesOf(const TemporaryFolder& folder)
{
  return std::distance(fs::directory_iterator(folder.path()), {});
}

TEST(FileOutput, replacesNoPipeOrDevice)
{
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder / "link");
  for (const char* const name : {"pipe", "link"})
  {
    EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile(folder / name, "text"); }),
              (folder / name).string() + ": is no regular file, and is not replaced");
    EXPECT_TRUE(fs::is_fifo(folder / "pipe")) << name;
  }
  EXPECT_EQ(entriesOf(folder), 2);
}

TEST(FileOutput, givesAFileItsNameOnceItIsWhole)
{
  const TemporaryFolder folder;
  const fs::path path = folder / "file";
  writeFile(path, "first");
  const SmallFiles limit(1000);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile(path, std::string(2000, 'x')); }),
            path.string() + ": cannot be written: File too large");
  EXPECT_EQ(readBytes(path), "first");
  EXPECT_EQ(entriesOf(folder), 1);
}

TEST(FileOutput, tellsWhyObjectsCannotBeWritten)
{
  // Little enough to be kept in a buffer until the file is closed, and more than that.
  for (const auto& [bytes, packing] :
       {std::pair(20000U, Packing::quick_gzip), std::pair(2000000U, Packing::quick_gzip),
        std::pair(20000U, Packing::zstd), std::pair(2000000U, Packing::zstd)})
  {
    const TemporaryFolder folder;
    const fs::path path = folder / "objects";
    const SmallFiles limit(1000);
    const auto write = [size = bytes](mrpt::serialization::CArchive& archive)
    {
      std::mt19937 generator(1);
      for (std::size_t i = 0; i < size; i += 4) archive << std::uint32_t(generator());
    };
    EXPECT_EQ(messageOf<std::runtime_error>([&, packing = packing]
                                            { writeObjects(path, write, packing); }),
              path.string() + ": cannot be written: File too large");
    EXPECT_EQ(entriesOf(folder), 0);
  }
}

TEST(FileOutput, tellsThatAFolderIsMissing)
{
  const TemporaryFolder folder;
  const fs::path path = folder / "none/file";
  const std::string expected = path.string() + ": cannot be written: No such file or directory";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { writeFile(path, ""); }), expected);
  for (const Packing packing : {Packing::quick_gzip, Packing::zstd})
  {
    EXPECT_EQ(messageOf<std::runtime_error>(
                  [&]
                  {
                    writeObjects(
                        path, [](auto&) {}, packing);
                  }),
              expected);
  }
}

TEST(FileOutput, writesWhereALinkPoints)
{
  const TemporaryFolder folder;
  writeFile(folder / "file", "first");
  fs::create_symlink("file", folder / "link");
  writeFile(folder / "link", "second");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(readBytes(folder / "file"), "second");
}

TEST(FileOutput, takesNamesAsLongAsTheyMayBe)
{
  const TemporaryFolder folder;
  const fs::path path = folder / std::string(255, 'x');
  writeFile(path, "bytes");
  EXPECT_EQ(readBytes(path), "bytes");
}

TEST(FileOutput, knowsTheNamesOfTemporaryFiles)
{
  EXPECT_EQ(withoutTemporaryEnding("steps.csv.part-123"), "steps.csv");
  for (const char* const name : {"steps.csv", "steps.csv.part-", "a.part-1x", ""})
  {
    EXPECT_EQ(withoutTemporaryEnding(name), name);
  }
}

TEST(FileOutput, tellsThatPrintedTextGotLost)
{
  std::ofstream full("/dev/full");
  full << "text";
  EXPECT_EQ(messageOf<std::runtime_error>([&] { finishOutput(full); }),
            "standard output: cannot be written: No space left on device");
}
}  // namespace
}  // namespace sigloc
