// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "own_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <type_traits>

namespace sigloc::detail
{
namespace
{
static_assert(std::is_trivially_copyable_v<TrackStepRecord>, "sent as bytes");

struct Header
{
  std::size_t start;
  std::size_t kidnapped_at;
  std::size_t steps;
};

bool writeAll(int file, const void* data, std::size_t bytes)
{
  const char* at = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t written = write(file, at, bytes);
    if (written <= 0) return false;
    at += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return true;
}

bool readAll(int file, void* data, std::size_t bytes)
{
  char* at = static_cast<char*>(data);
  while (bytes > 0)
  {
    const ssize_t got = read(file, at, bytes);
    if (got <= 0) return false;
    at += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

// The worker: never returns, so that nothing of the parent is run or flushed twice.
[[noreturn]] void work(int out, const std::function<TrackRun()>& job)
{
  try
  {
    const TrackRun run = job();
    const Header header{run.start, run.kidnapped_at, run.steps.size()};
    const bool sent = writeAll(out, &header, sizeof(header)) &&
                      writeAll(out, run.steps.data(), run.steps.size() * sizeof(TrackStepRecord));
    _exit(sent ? 0 : 1);
  }
  catch (...)
  {
    _exit(1);
  }
}
}  // namespace

TrackRun runInOwnProcess(const std::function<TrackRun()>& job)
{
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("cannot open a pipe to a worker process");
  const pid_t child = fork();
  if (child == 0)
  {
    close(ends[0]);
    work(ends[1], job);
  }
  close(ends[1]);
  Header header{};
  TrackRun run;
  bool received = child > 0 && readAll(ends[0], &header, sizeof(header));
  if (received)
  {
    run.start = header.start;
    run.kidnapped_at = header.kidnapped_at;
    run.steps.resize(header.steps);
    received = readAll(ends[0], run.steps.data(), header.steps * sizeof(TrackStepRecord));
  }
  close(ends[0]);
  int status = 0;
  if (child > 0) waitpid(child, &status, 0);
  if (!received || status != 0) throw std::runtime_error("a worker process failed");
  return run;
}
}  // namespace sigloc::detail
