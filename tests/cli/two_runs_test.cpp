// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause

// Two runs into one output folder: the second ends at once, the first one's results are whole. Two
// runs of the same input: the same bytes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <optional>
#include <thread>

#include "command_line.h"
#include "runs.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// sigloc-localize at work in the background, in a folder.
class Background
{
 public:
  Background(const TemporaryFolder& folder, const Arguments& arguments)
  {
    const std::string program = std::string(SIGLOC_BIN_FOLDER) + "/sigloc-localize";
    const std::string at = folder.path().string();
    const std::string cache = cacheFor(folder).string();
    std::vector<char*> words = {const_cast<char*>(program.c_str())};
    for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    child_ = fork();
    if (child_ != 0) return;
    const int nothing = open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) dup2(nothing, stream);
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    if (chdir(at.c_str()) == 0) execv(program.c_str(), words.data());
    _exit(127);
  }

  ~Background() { wait(); }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  void signal(int number) const { kill(child_, number); }

  bool running()
  {
    if (!status_)
    {
      int status = 0;
      if (waitpid(child_, &status, WNOHANG) == child_) status_ = status;
    }
    return !status_;
  }

  /// Returns its exit code, 128 for a signal.
  int wait()
  {
    int status = 0;
    if (!status_ && waitpid(child_, &status, 0) == child_) status_ = status;
    return status_ && WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128;
  }

 private:
  pid_t child_ = -1;
  std::optional<int> status_;
};

std::size_t filesBelow(const std::filesystem::path& folder)
{
  std::size_t count = 0;
  std::error_code ignored;
  for (std::filesystem::recursive_directory_iterator entry(folder, ignored), end;
       !ignored && entry != end; entry.increment(ignored))
  {
    ++count;
  }
  return count;
}

/// Writes an ini over part of the office's log. Returns its steps.
int writeIni(const TemporaryFolder& folder, const std::string& name, int offset)
{
  writeText(
      folder / name,
      "[LocalizationExperiment]\nmap_file = " + (kSources / "maps/office.simplemap").string() +
          "\nrawlog_file = " + (kSources / "rawlogs/office.rawlog").string() +
          "\nrawlog_offset = " + std::to_string(offset) + "\n3DSceneFrequency = 50\n");
  return 202 - offset;
}

/// Expects all files of a run with so many steps, and nothing else in the test's folder.
void expectWhole(const TemporaryFolder& folder, int steps)
{
  const auto summary = summaryOf(folder);
  EXPECT_EQ(summary.at("steps"), steps);
  EXPECT_EQ(filesBelow(folder / "out/belief"), static_cast<std::size_t>(2 * steps));
  EXPECT_EQ(countLines(readBytes(folder / "out/steps.csv")), steps + 1);
  EXPECT_GT(filesBelow(folder / "out/pictures"), 0U);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{"a.ini", "b.ini", "out"}));
}

/// Starts a second run when so many files of the first are there. The first is stopped meanwhile,
/// so that it cannot end first. Returns false where it had ended already.
bool meet(std::size_t files)
{
  const TemporaryFolder folder;
  const int steps = writeIni(folder, "a.ini", 100);
  writeIni(folder, "b.ini", 150);
  const std::size_t before = filesBelow(folder.path());
  Background first(folder, {"a.ini", "--quiet", "--out", "out"});
  while (first.running() && filesBelow(folder.path()) < before + files)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  first.signal(SIGSTOP);
  if (!first.running() || std::filesystem::exists(folder / "out/summary.json"))
  {
    first.signal(SIGCONT);
    return false;
  }
  const auto second = run(folder, "sigloc-localize", {"b.ini", "--quiet", "--out", "out"});
  first.signal(SIGCONT);
  EXPECT_EQ(second.exit_code, 1);
  EXPECT_EQ(countLines(second.errors), 1) << second.errors;
  EXPECT_NE(second.errors.find(": another run writes here"), std::string::npos) << second.errors;
  EXPECT_EQ(first.wait(), 0);
  expectWhole(folder, steps);
  return true;
}

// SIGLOC_PAIRS asks for more pairs of runs. Where the machine is busy, the first may end too early.
TEST(TwoRuns, IntoOneFolderTheSecondIsRefusedAndTheFirstIsWhole)
{
  const char* asked = std::getenv("SIGLOC_PAIRS");
  const int pairs = asked != nullptr ? std::atoi(asked) : 3;
  for (int pair = 0; pair < pairs; ++pair)
  {
    // The folder is locked as soon as two are there: itself and what is being written in it.
    const auto files = static_cast<std::size_t>(3 + pair * 190 / pairs);
    int tries = 1;
    while (!meet(files) && tries < 10) ++tries;
    EXPECT_LT(tries, 10) << "pair " << pair;
  }
}

std::map<std::string, std::string> contentsOf(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file()) contents[name] = readBytes(entry.path());
  }
  return contents;
}

TEST(TwoRuns, WriteTheSameBytesButForTheirTimes)
{
  const std::set<std::string> times = {"exec_times.txt", "_SUMMARY.txt", "report.html"};
  for (const std::string tracker : {"gaussians", "particles"})
  {
    const TemporaryFolder folder;
    writeIni(folder, "a.ini", 185);
    writeText(folder / "a.ini", readBytes(folder / "a.ini") + "tracker = " + tracker + "\n");
    for (const std::string out : {"map_into_cache", "one", "two"})
    {
      ASSERT_EQ(run(folder, "sigloc-localize", {"a.ini", "--quiet", "--out", out}).exit_code, 0);
    }
    const auto one = contentsOf(folder / "one");
    const auto two = contentsOf(folder / "two");
    EXPECT_GT(one.size(), 40U);
    EXPECT_EQ(one.size(), two.size());
    for (const auto& [name, bytes] : one)
    {
      const bool same = two.count(name) > 0 && two.at(name) == bytes;
      EXPECT_TRUE(same || times.count(name) > 0) << tracker << ": " << name;
    }
    EXPECT_EQ(countLines(one.at("exec_times.txt")), 202 - 185);
  }
}

TEST(TwoRuns, AfterTheFirstHasEndedTheSecondReplacesIt)
{
  const TemporaryFolder folder;
  writeIni(folder, "a.ini", 150);
  const int steps = writeIni(folder, "b.ini", 180);
  for (const std::string name : {"a.ini", "b.ini"})
  {
    EXPECT_EQ(run(folder, "sigloc-localize", {name, "--quiet", "--out", "out"}).exit_code, 0);
  }
  expectWhole(folder, steps);
}
}  // namespace
}  // namespace sigloc
