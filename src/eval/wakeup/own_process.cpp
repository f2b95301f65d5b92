// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/wakeup/own_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "sigloc/io/file_output.h"

namespace sigloc::detail
{
namespace
{
static_assert(std::is_trivially_copyable_v<WakeupStep>, "sent as bytes");

struct AnswerHeader
{
  std::size_t start;
  std::size_t kidnapped_at;
  std::size_t steps;
  std::size_t reason;  // length of the message why there is no run, 0: there is one
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

bool sendRun(int out, const Wakeup& run)
{
  const AnswerHeader header{run.start, run.kidnapped_at, run.steps.size(), 0};
  return writeAll(out, &header, sizeof(header)) &&
         writeAll(out, run.steps.data(), run.steps.size() * sizeof(WakeupStep));
}

void sendFailure(int out, const std::string& reason)
{
  const AnswerHeader header{0, 0, 0, reason.size()};
  if (writeAll(out, &header, sizeof(header))) writeAll(out, reason.data(), reason.size());
}

// The worker process. It never returns, so that nothing of the parent is run or flushed twice.
[[noreturn]] void work(int out, const std::function<Wakeup()>& job)
{
  try
  {
    _exit(sendRun(out, job()) ? 0 : 1);
  }
  catch (const std::exception& error)
  {
    sendFailure(out, oneLine(error.what()));
  }
  catch (...)
  {
    // The parent reports that it failed.
  }
  _exit(1);
}

struct Received
{
  Wakeup run;
  std::string failure = "a worker process failed";  // empty: there is a run
};

Received receive(int in)
{
  Received received;
  AnswerHeader header{};
  if (!readAll(in, &header, sizeof(header))) return received;
  std::string reason(header.reason, ' ');
  Wakeup& run = received.run;
  run.start = header.start;
  run.kidnapped_at = header.kidnapped_at;
  run.steps.resize(header.steps);
  const bool whole = readAll(in, reason.data(), reason.size()) &&
                     readAll(in, run.steps.data(), header.steps * sizeof(WakeupStep));
  if (whole) received.failure = reason;
  return received;
}
}  // namespace

Wakeup runInOwnProcess(const std::function<Wakeup()>& job)
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
  Received received = receive(ends[0]);
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  if (!received.failure.empty()) throw std::runtime_error(received.failure);
  return std::move(received.run);
}
}  // namespace sigloc::detail
