// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CStream.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/packed_file.h"

namespace sigloc::detail
{
constexpr std::size_t kLongestClassName = 120;
constexpr std::size_t kLongestObjectHeader = kLongestClassName + 4;

/// What a file may unpack to: at most `most` bytes, and at most `always` bytes or `ratio` times its
/// size, whichever is more. Files of hostile sizes are refused before memory is taken for them.
struct UnpackLimits
{
  std::uint64_t most = std::uint64_t{1} << 32U;  // bytes
  std::uint64_t always = std::uint64_t{1} << 26U;  // bytes
  std::uint64_t ratio = 50;  // numbers are packed to a third or a tenth
};
constexpr UnpackLimits kUsualLimits;
/// Of a grid map, most cells are alike.
constexpr UnpackLimits kGridLimits{std::uint64_t{1} << 30U, std::uint64_t{1} << 29U};

/// What an MRPT object begins with: the name of its class. Its version follows.
struct ObjectHeader
{
  std::string_view name;
  std::size_t size = 0;  ///< bytes up to the version
  bool old = false;  ///< of the oldest files: a version of four bytes, no flag at the object's end
};

/// Returns the header that the bytes begin with, or nullopt when they begin otherwise.
std::optional<ObjectHeader> objectHeaderIn(std::string_view bytes);

/// Reads a file, compressed by gzip or zstd or plain, front to back. Unlike MRPT's own reader it
/// distinguishes the end of the file from damaged or truncated data.
class GzipInput final : public mrpt::io::CStream
{
 public:
  /// Throws std::runtime_error "path: reason" for a missing, unreadable or empty file or a folder,
  /// and for one that is compressed twice.
  explicit GzipInput(const std::filesystem::path& path);
  ~GzipInput() override;
  GzipInput(const GzipInput&) = delete;
  GzipInput& operator=(const GzipInput&) = delete;

  /// From here on, reading throws std::runtime_error "path: reason" for a file that holds more. Of
  /// a file that is not compressed, or whose zstd tells it, that is known at once.
  /// Of a packed file that may hold more it is found out `at_once`, at the cost of unpacking it.
  void limitTo(const UnpackLimits& limits, bool at_once = true);
  /// Unpacks the file once and keeps nothing, so that memory is taken for none that holds more than
  /// its limits. Returns the bytes that it unpacks to, or nullopt where it is damaged. Of a file
  /// that holds more than `enough` it returns what it has seen by then, which is more.
  std::optional<std::uint64_t> wholeSize(std::uint64_t enough = UINT64_MAX) const;
  /// Returns the bytes read, fewer than `count` at the end or where the file is damaged.
  std::size_t Read(void* buffer, std::size_t count) override;
  /// True when not one more byte can be read.
  bool atEnd();
  /// Reads on until the end, or until `most` bytes more, so that damaged() tells of all of them.
  void skipToEnd(std::uint64_t most);
  /// True when the compressed data broke off or failed its check.
  bool damaged() const { return damaged_; }
  /// What is known before anything is read.
  const PackedContents& contents() const { return file_->contents(); }
  /// True when it failed its check; false where it merely broke off.
  bool isWrong() const { return file_->wrong(); }
  bool isPlain() const { return file_->plain(); }
  /// Returns what comes next without consuming it: `count` bytes or more, fewer at the end. Valid
  /// until the next call.
  std::string_view peek(std::size_t count);
  /// Consumes what was looked at by peek(), `count` bytes of it.
  void drop(std::size_t count);
  /// Change what peek() has shown, from the next byte on: one byte, or leave some out.
  void change(std::size_t at, char value);
  void leaveOut(std::size_t at, std::size_t count);
  /// Share of the file's contents consumed so far, in [0, 1].
  double progress() const;
  /// Returns the class of the MRPT object that comes next without consuming anything, or "" when no
  /// object header follows.
  std::string nextClassName();

  std::size_t Write(const void* buffer, std::size_t count) override;
  std::uint64_t Seek(std::int64_t offset, TSeekOrigin origin) override;
  std::uint64_t getTotalBytesCount() const override { return file_->fileSize(); }
  std::uint64_t getPosition() const override { return position_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::size_t readFile(char* buffer, std::size_t count);
  void requireWithin(std::uint64_t bytes) const;
  std::uint64_t allowed() const;

  std::filesystem::path path_;
  std::unique_ptr<PackedFile> file_;
  std::uint64_t position_ = 0;
  std::uint64_t unpacked_ = 0;  // so far
  UnpackLimits limits_{UINT64_MAX, UINT64_MAX};
  std::string ahead_;  // read from the file ...
  std::size_t ahead_from_ = 0;  // ... and handed out up to here
  bool damaged_ = false;
};

/// Throws std::runtime_error "path: damaged: ..." for a compressed file whose content fails its own
/// check; one that is merely cut off passes. MRPT's readers may crash on objects with wrong
/// bytes in them, so this is called before them. Costs one decompression of the file. Refuses one
/// that unpacks to more than the limits.
void requireIntact(const std::filesystem::path& path, const UnpackLimits& limits = kUsualLimits);

/// Returns the next bytes of a file: `most`, or a few more, or all that are left. Throws
/// std::runtime_error "path: reason" for a file that is damaged.
std::string restOf(GzipInput& input, std::uint64_t most = kUsualLimits.most);

/// Returns "; did you mean '...'?" with the entry of the path's folder whose name is nearest to
/// that of a file that does not exist, or an empty text.
std::string didYouMeanFile(const std::filesystem::path& path);

/// The names in a folder, in order; not all of a huge one, none where it cannot be read.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// The folder that a file is in: "." where its path has none.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Returns a file's extension in lower case, the one before .gz or .zst where the file has
/// both.
std::string extensionOf(const std::filesystem::path& path);

/// Throws std::runtime_error "path: reason" unless the path names a readable, non-empty regular
/// file.
void requireFile(const std::filesystem::path& path);
}  // namespace sigloc::detail
