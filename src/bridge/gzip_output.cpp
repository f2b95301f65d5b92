// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "gzip_output.h"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace sigloc::detail
{
namespace
{
// The lowest level of compression: maps are rebuilt often and read more often.
constexpr const char* kMode = "wb1";
constexpr unsigned kBufferBytes = 256U * 1024U;
}  // namespace

GzipOutput::GzipOutput(const std::filesystem::path& path) : path_(path), temporary_(path)
{
  temporary_ += ".part-" + std::to_string(getpid());
  file_ = gzopen(temporary_.c_str(), kMode);
  if (file_ == nullptr) fail();
  gzbuffer(file_, kBufferBytes);
}

GzipOutput::~GzipOutput()
{
  if (file_ != nullptr) gzclose(file_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void GzipOutput::fail() const
{
  const char* reason = errno != 0 ? std::strerror(errno) : "disk full?";
  throw std::runtime_error(path_.string() + ": cannot be written: " + reason);
}

std::size_t GzipOutput::Write(const void* buffer, std::size_t count)
{
  errno = 0;
  const auto* bytes = static_cast<const char*>(buffer);
  for (std::size_t done = 0; done < count;)
  {
    // gzwrite takes at most INT_MAX bytes a call.
    const auto chunk = static_cast<unsigned>(std::min<std::size_t>(count - done, 1U << 30U));
    if (gzwrite(file_, bytes + done, chunk) != static_cast<int>(chunk)) fail();
    done += chunk;
  }
  position_ += count;
  return count;
}

void GzipOutput::commit()
{
  errno = 0;
  if (gzclose(std::exchange(file_, nullptr)) != Z_OK) fail();
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw std::runtime_error(path_.string() + ": cannot be written: " + error.message());
  temporary_.clear();
}

std::size_t GzipOutput::Read(void*, std::size_t)
{
  throw std::logic_error("GzipOutput is for writing only");
}

std::uint64_t GzipOutput::Seek(std::int64_t, TSeekOrigin)
{
  throw std::logic_error("GzipOutput writes front to back only");
}
}  // namespace sigloc::detail
