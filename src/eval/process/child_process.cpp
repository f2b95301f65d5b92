// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/process/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace sigloc::detail
{
namespace
{
constexpr const char* kNothing = "/dev/null";

/// The files that a program starts with; its standard input is empty.
class ChildFiles
{
 public:
  ChildFiles()
  {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, kNothing, O_RDONLY, 0);
  }
  ~ChildFiles() { posix_spawn_file_actions_destroy(&actions_); }
  ChildFiles(const ChildFiles&) = delete;
  ChildFiles& operator=(const ChildFiles&) = delete;

  void printTo(int stream, const char* path)
  {
    posix_spawn_file_actions_addopen(&actions_, stream, path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  void join(int file, int stream) { posix_spawn_file_actions_adddup2(&actions_, file, stream); }

  /// Starts a program of the PATH; nullopt when there is no such program.
  std::optional<pid_t> start(std::string program, std::string argument) const
  {
    std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    const int failed =
        posix_spawnp(&child, program.c_str(), &actions_, nullptr, arguments.data(), environ);
    return failed == 0 ? std::optional(child) : std::nullopt;
  }

 private:
  posix_spawn_file_actions_t actions_{};
};

int statusOf(pid_t child)
{
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

std::string readToEnd(int file)
{
  constexpr std::size_t kChunk = 65536;
  std::string text;
  while (true)
  {
    std::array<char, kChunk> chunk{};
    const ssize_t got = read(file, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return text;
    text.append(chunk.data(), static_cast<std::size_t>(got));
  }
}
}  // namespace

std::optional<int> runProgram(const std::string& program, const std::string& argument,
                              const std::filesystem::path& log)
{
  ChildFiles files;
  files.printTo(STDOUT_FILENO, log.c_str());
  files.join(STDOUT_FILENO, STDERR_FILENO);
  const auto child = files.start(program, argument);
  if (!child) return std::nullopt;
  return statusOf(*child);
}

std::optional<std::string> outputOf(const std::string& program, const std::string& argument)
{
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  ChildFiles files;
  files.join(pipe_ends[1], STDOUT_FILENO);
  files.printTo(STDERR_FILENO, kNothing);
  const auto child = files.start(program, argument);
  close(pipe_ends[1]);
  std::string text = readToEnd(pipe_ends[0]);
  close(pipe_ends[0]);
  if (!child || statusOf(*child) != 0) return std::nullopt;
  return text;
}
}  // namespace sigloc::detail
