// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "io/archive/zstd_walk.h"

namespace sigloc::detail
{
/// The contents of a file that may be compressed, front to back: by gzip, by zstd, as MRPT does by
/// default since 2.15.7, or not at all.
class PackedFile
{
 public:
  PackedFile(std::uint64_t file_size, std::uint64_t unpacked_size, const PackedContents& contents)
      : file_size_(file_size), unpacked_size_(unpacked_size), contents_(contents)
  {
  }
  virtual ~PackedFile() = default;

  /// Returns the bytes read, fewer than `count` at the end or where the file is broken.
  virtual unsigned read(char* buffer, unsigned count) = 0;
  /// True once the compressed data broke off or failed its check.
  virtual bool broken() const = 0;
  /// True once the compressed data failed its check; false where it merely broke off.
  virtual bool wrong() const = 0;
  /// True for a file that is not compressed.
  virtual bool plain() const = 0;
  /// Bytes of the file as it is.
  std::uint64_t fileSize() const { return file_size_; }
  /// Bytes that the file holds when unpacked; a guess for one that is truncated or does not tell.
  std::uint64_t unpackedSize() const { return unpacked_size_; }
  /// What is known of the contents at once. Of gzip that is little.
  const PackedContents& contents() const { return contents_; }

 private:
  std::uint64_t file_size_;
  std::uint64_t unpacked_size_;
  PackedContents contents_;
};

/// True for bytes that begin a file compressed by gzip or zstd: four or more of them.
bool beginsPacked(std::string_view bytes);

/// Opens a file; null where that fails. It takes a buffer of at most `most_buffer` bytes, which is
/// 4 kB or more.
std::unique_ptr<PackedFile> openPacked(const std::filesystem::path& path, unsigned most_buffer);
}  // namespace sigloc::detail
