// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <filesystem>

// zlib's handle, so that its header stays out of this one.
struct gzFile_s;

namespace sigloc::detail
{
/// Writes a gz-compressed file that appears under its name only when it is complete: the bytes go
/// to a temporary file beside it, which `commit` renames and the destructor otherwise removes.
class GzipOutput final : public mrpt::io::CStream
{
 public:
  /// Throws std::runtime_error "path: reason" when no file can be made there.
  explicit GzipOutput(const std::filesystem::path& path);
  ~GzipOutput() override;
  GzipOutput(const GzipOutput&) = delete;
  GzipOutput& operator=(const GzipOutput&) = delete;

  /// Throws std::runtime_error "path: reason" when the disk does not take the bytes.
  std::size_t Write(const void* buffer, std::size_t count) override;
  /// Finishes the file. Throws std::runtime_error "path: reason".
  void commit();

  std::size_t Read(void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return position_; }
  std::uint64_t getPosition() const override { return position_; }

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  gzFile_s* file_ = nullptr;
  std::uint64_t position_ = 0;
};
}  // namespace sigloc::detail
