// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// What a power cut may take: a file has its final name only once a disk holds its bytes, and a
// program ends only once a disk holds the name.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "command_line.h"

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
using namespace sigloc::test;

/// The files and folders that a program has left to the mercy of the disk so far.
struct Unsafe
{
  std::set<fs::path> files;  ///< renamed without their bytes on the disk
  std::set<fs::path> folders;  ///< in which names were changed since they were on the disk
};

bool liesIn(const fs::path& path, const fs::path& folder)
{
  return path == folder || path.string().rfind(folder.string() + "/", 0) == 0;
}

/// What a program did to files, as tests/cli/preloaded wrote it down.
class FileCalls
{
 public:
  /// Of what was done outside `within`, in caches and temporary files, nothing is kept.
  FileCalls(const fs::path& written_down, const fs::path& within) : within_(fs::canonical(within))
  {
    std::ifstream in(written_down);
    for (std::string line; std::getline(in, line);) take(line);
  }

  const Unsafe& unsafe() const { return unsafe_; }
  /// Folders that had their final name before their files were on the disk.
  const std::set<fs::path>& hasty() const { return hasty_; }
  bool named(const fs::path& file) const { return named_.count(file) > 0; }

 private:
  void take(const std::string& line)
  {
    std::istringstream words(line);
    std::string call;
    std::string path;
    std::string target;
    std::getline(words, call, '\t');
    std::getline(words, path, '\t');
    std::getline(words, target, '\t');
    if (!liesIn(path, within_)) return;
    if (call == "fsync")
    {
      synced_.insert(path);
      unsafe_.folders.erase(path);
    }
    else if (call == "syncfs")
    {
      unsafe_ = {};
    }
    else if (call == "mkdir")
    {
      unsafe_.folders.insert(fs::path(path).parent_path());
    }
    else
    {
      rename(path, target);
    }
  }

  void rename(const fs::path& from, const fs::path& to)
  {
    if (fs::is_directory(to))
    {
      for (const fs::path& file : unsafe_.files)
      {
        if (liesIn(file, from)) hasty_.insert(to);
      }
    }
    // A folder that was written whole is moved with the files in it.
    std::set<fs::path> moved;
    for (const fs::path& file : named_)
    {
      if (liesIn(file, from)) moved.insert((to / file.lexically_relative(from)).lexically_normal());
    }
    if (moved.empty() && synced_.count(from) == 0) unsafe_.files.insert(to);
    named_.insert(moved.begin(), moved.end());
    named_.insert(to);
    unsafe_.folders.insert(to.parent_path());
  }

  fs::path within_;
  std::set<fs::path> synced_;
  std::set<fs::path> named_;
  std::set<fs::path> hasty_;
  Unsafe unsafe_;
};

class PowerCut : public ::testing::Test
{
 protected:
  /// Runs a program, and expects that no power cut could have spoilt what it wrote.
  void expectSafe(const std::string& program, const Arguments& arguments)
  {
    const std::set<std::string> before = listing(folder_);
    const TemporaryFolder notes;
    const fs::path calls_file = notes / "calls";
    const CommandResult result =
        runShell(folder_, "LD_PRELOAD=" + quoted(SIGLOC_FILE_CALLS_MODULE) + " SIGLOC_FILE_CALLS=" +
                              quoted(calls_file.string()) + " " + commandLine(program, arguments));
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const FileCalls calls(calls_file, folder_.path());
    EXPECT_EQ(calls.unsafe().files, std::set<fs::path>{}) << program;
    EXPECT_EQ(calls.unsafe().folders, std::set<fs::path>{}) << program;
    EXPECT_EQ(calls.hasty(), std::set<fs::path>{}) << program;
    std::size_t files = 0;
    for (const std::string& path : listing(folder_))
    {
      if (before.count(path) > 0 || !fs::is_regular_file(path)) continue;
      ++files;
      EXPECT_TRUE(calls.named(fs::canonical(path))) << program << " wrote " << path << " in place";
    }
    EXPECT_GT(files, 0U) << program;
  }

  TemporaryFolder folder_;
};

TEST_F(PowerCut, SparesMapsAndPictures)
{
  expectSafe("sigloc-map", {"build", "-i", kLabMap.string(), "-o", "lab.sigmap"});
  expectSafe("sigloc-map", {"draw", "lab.sigmap", "-o", "lab.png"});
  expectSafe("sigloc-map", {"check", "lab.sigmap", "--out", "check"});
  expectSafe("sigloc-align", {kLabMap.string(), kLabMap.string(), "--poses", "out.CPosePDFSOG"});
}

TEST_F(PowerCut, SparesRunsNewOrOverAnEarlierOne)
{
  const Arguments arguments = {"--map", kLabMap.string(), "--log", kLabLog.string(), "--out",
                               "out",   "--quiet"};
  expectSafe("sigloc-localize", arguments);
  fs::remove(folder_ / "out/steps.csv");
  expectSafe("sigloc-localize", arguments);
}

TEST_F(PowerCut, SparesARunThatIsKilledAsItRemovesAnEarlierOne)
{
  const Arguments arguments = {"--map", kLabMap.string(), "--log", kLabLog.string(), "--out",
                               "out",   "--quiet"};
  ASSERT_EQ(run(folder_, "sigloc-localize", arguments).exit_code, 0);
  const auto files = [&]
  {
    std::set<std::string> all = listing(folder_ / "out");
    all.erase((folder_ / "out/_SUMMARY.txt").string());  // of all repetitions, written after them
    return all;
  };
  const std::set<std::string> whole = files();
  for (const char* const last : {"1", "20", "60"})
  {
    const TemporaryFolder notes;
    const CommandResult killed = runShell(
        folder_, "LD_PRELOAD=" + quoted(SIGLOC_FILE_CALLS_MODULE) +
                     " SIGLOC_FILE_CALLS=" + quoted((notes / "calls").string()) +
                     " SIGLOC_DIE_AT=" + last + " " + commandLine("sigloc-localize", arguments));
    EXPECT_NE(killed.exit_code, 0);
    EXPECT_TRUE(fs::exists(folder_ / "out.partial")) << "not killed in the midst of it";
    EXPECT_TRUE(files() == whole) << last;
  }
  EXPECT_EQ(run(folder_, "sigloc-localize", arguments).exit_code, 0);
  EXPECT_TRUE(files() == whole);
  EXPECT_FALSE(fs::exists(folder_ / "out.partial"));
}

TEST_F(PowerCut, SparesARunThatIsKilledBeforeItHasItsName)
{
  const Arguments arguments = {"--map", kLabMap.string(), "--log", kLabLog.string(), "--out",
                               "out",   "--quiet"};
  ASSERT_EQ(run(folder_, "sigloc-localize", arguments).exit_code, 0);
  for (const char* const time : {"first", "second"})
  {
    const TemporaryFolder notes;
    const std::string calls = quoted((notes / "calls").string());
    EXPECT_NE(runShell(folder_, "LD_PRELOAD=" + quoted(SIGLOC_FILE_CALLS_MODULE) +
                                    " SIGLOC_FILE_CALLS=" + calls + " SIGLOC_NO_EXCHANGE=1 " +
                                    commandLine("sigloc-localize", arguments))
                  .exit_code,
              0);
    EXPECT_FALSE(fs::exists(folder_ / "out")) << time << ": not killed in the midst of it";
    EXPECT_TRUE(fs::exists(folder_ / "out.partial/summary.json")) << time;
    // The second time this is the run that was killed the first time.
    EXPECT_TRUE(fs::exists(folder_ / "out.partial.replaced/summary.json")) << time;
    fs::remove_all(folder_ / "out.partial.replaced");
  }
  ASSERT_EQ(run(folder_, "sigloc-localize", arguments).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/summary.json"));
  EXPECT_FALSE(fs::exists(folder_ / "out.partial"));
}

TEST_F(PowerCut, SparesSimulationsAndReports)
{
  expectSafe("sigloc-simulate",
             {"--world", "corridor", "--seed", "5", "--metres", "5", "--out", "corridor"});
  expectSafe("sigloc-eval",
             {"relocate", "--map", "corridor/map.simplemap", "--rawlog", "corridor/drive.rawlog",
              "--ground-truth", "corridor/truth.txt", "--max-queries", "2", "--method", "signature",
              "--quiet", "--out", "report"});
}
}  // namespace
}  // namespace sigloc
