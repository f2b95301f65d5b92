// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/process/run_parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace sigloc
{
void runParallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work, const std::string& what,
                 const ShowProgress& progress)
{
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  const auto worker = [&]
  {
    for (std::size_t i = next++; i < count; i = next++)
    {
      try
      {
        work(i);
        const std::lock_guard<std::mutex> lock(mutex);
        ++done;
        if (progress) progress(what, static_cast<double>(done) / static_cast<double>(count));
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> pool;
  for (std::size_t i = 1; i < std::min(threads, count); ++i) pool.emplace_back(worker);
  worker();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}
}  // namespace sigloc
