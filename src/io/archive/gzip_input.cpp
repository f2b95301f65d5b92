// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/gzip_input.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string_view>
#include <vector>

#include "io/archive/file_fault.h"
#include "sigloc/config/option_fields.h"

namespace sigloc::detail
{
namespace
{
constexpr unsigned kBufferBytes = 256U * 1024U;
constexpr std::uint64_t kLeastChunk = 4096;

bool isClassNameCharacter(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_:<>, *").find(c) != std::string_view::npos;
}
}  // namespace

std::string extensionOf(const std::filesystem::path& path)
{
  std::filesystem::path name = path.filename();
  while (name.extension() == ".gz" || name.extension() == ".zst") name = name.stem();
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<ObjectHeader> objectHeaderIn(std::string_view bytes)
{
  // Length of the name (with the top bit set in one byte; in the oldest files in four bytes,
  // little-endian), name, version.
  constexpr std::size_t kOldLengthBytes = 4;
  constexpr std::string_view kZeros("\0\0\0", 3);
  if (bytes.size() < kOldLengthBytes) return std::nullopt;
  const auto byte = static_cast<unsigned char>(bytes[0]);
  ObjectHeader header;
  header.old = byte < 0x80U;
  if (header.old && bytes.substr(1, kZeros.size()) != kZeros) return std::nullopt;
  const std::size_t length = byte & 0x7FU;
  const std::size_t start = header.old ? kOldLengthBytes : 1;
  if (length == 0 || length > kLongestClassName || bytes.size() < start + length)
  {
    return std::nullopt;
  }
  header.name = bytes.substr(start, length);
  header.size = start + length;
  const bool spelled = std::all_of(header.name.begin(), header.name.end(), isClassNameCharacter);
  return spelled ? std::optional(header) : std::nullopt;
}

std::vector<std::string> namesIn(const std::filesystem::path& folder)
{
  constexpr std::size_t kMostLooked = 2000;  // a folder may be huge
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
  {
    names.push_back(entry->path().filename().string());
    if (names.size() == kMostLooked) break;
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::filesystem::path folderOf(const std::filesystem::path& path)
{
  return path.has_parent_path() ? path.parent_path() : ".";
}

std::string didYouMeanFile(const std::filesystem::path& path)
{
  return didYouMean(path.filename().string(), namesIn(folderOf(path)));
}

void requireFile(const std::filesystem::path& path)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::none) fail(path, error.message());
  if (!std::filesystem::exists(status)) fail(path, "no such file" + didYouMeanFile(path));
  if (std::filesystem::is_directory(status)) fail(path, "is a folder, not a file");
  // Files are read more than once, and a device may have no end.
  if (!std::filesystem::is_regular_file(status)) fail(path, "is no regular file");
  if (access(path.c_str(), R_OK) != 0) fail(path, "cannot be read");
  if (std::filesystem::file_size(path, error) == 0) fail(path, "is empty");
}

void requireIntact(const std::filesystem::path& path, const UnpackLimits& limits)
{
  GzipInput input(path);
  if (input.isPlain()) return;  // it has no checksum
  input.limitTo(limits, false);
  input.skipToEnd(limits.most);
  if (input.isWrong())
    fail(path, "damaged: its check fails; gzip -dc or zstd -dc unpacks what is left of it");
}

std::string restOf(GzipInput& input, std::uint64_t most)
{
  const auto chunk = static_cast<std::size_t>(
      std::clamp<std::uint64_t>(input.getTotalBytesCount(), kLeastChunk, kBufferBytes));
  std::string bytes;
  for (bool more = true; more && bytes.size() < most;)
  {
    const std::size_t size = bytes.size();
    bytes.resize(size + chunk);
    const std::size_t got = input.Read(bytes.data() + size, chunk);
    bytes.resize(size + got);
    more = got == chunk;
  }
  if (input.damaged()) fail(input.path(), "truncated or damaged");
  return bytes;
}

GzipInput::GzipInput(const std::filesystem::path& path) : path_(path)
{
  requireFile(path);
  file_ = openPacked(path, kBufferBytes);
  if (!file_) fail(path, "cannot be opened");
  constexpr std::size_t kMagic = 4;
  if (beginsPacked(peek(kMagic)))
    fail(path, "is compressed twice; unpack it once, with gunzip or zstd -d");
}

GzipInput::~GzipInput() = default;

void GzipInput::limitTo(const UnpackLimits& limits, bool at_once)
{
  limits_ = limits;
  requireWithin(std::max(unpacked_, file_->contents().least));
  if (at_once && file_->contents().most > allowed()) static_cast<void>(wholeSize());
}

std::uint64_t GzipInput::allowed() const
{
  return std::min(limits_.most, std::max(limits_.always, limits_.ratio * file_->fileSize()));
}

std::optional<std::uint64_t> GzipInput::wholeSize(std::uint64_t enough) const
{
  const auto again = openPacked(path_, kBufferBytes);
  if (!again) fail(path_, "cannot be opened");
  std::vector<char> piece(kBufferBytes);
  std::uint64_t unpacked = 0;
  for (bool more = true; more;)
  {
    const unsigned got = again->read(piece.data(), kBufferBytes);
    unpacked += got;
    requireWithin(unpacked);
    more = got == kBufferBytes && unpacked <= enough;
  }
  if (again->broken()) return std::nullopt;
  return unpacked;
}

void GzipInput::requireWithin(std::uint64_t bytes) const
{
  if (bytes > limits_.most) fail(path_, fmt::format("holds more than {} MB", limits_.most >> 20U));
  if (bytes > std::max(limits_.always, limits_.ratio * file_->fileSize()))
    fail(path_, fmt::format("unpacks to more than {} times its size", limits_.ratio));
}

std::size_t GzipInput::Read(void* buffer, std::size_t count)
{
  // With a count of 0 the buffer may be null, which memcpy() does not allow.
  const std::size_t from_ahead = ahead_.copy(static_cast<char*>(buffer), count, ahead_from_);
  ahead_from_ += from_ahead;
  if (ahead_from_ == ahead_.size())
  {
    ahead_.clear();
    ahead_from_ = 0;
  }
  const std::size_t done =
      from_ahead + readFile(static_cast<char*>(buffer) + from_ahead, count - from_ahead);
  position_ += done;
  return done;
}

/// Reads past what was looked at. Returns the bytes read.
std::size_t GzipInput::readFile(char* buffer, std::size_t count)
{
  std::size_t done = 0;
  while (done < count)
  {
    // zlib takes at most INT_MAX bytes a call.
    const auto chunk = static_cast<unsigned>(std::min<std::size_t>(count - done, 1U << 30U));
    const unsigned got = file_->read(buffer + done, chunk);
    done += got;
    unpacked_ += got;
    requireWithin(unpacked_);
    if (got == chunk) continue;
    damaged_ = damaged_ || file_->broken();
    break;
  }
  return done;
}

std::string_view GzipInput::peek(std::size_t count)
{
  if (ahead_.size() - ahead_from_ < count)
  {
    ahead_.erase(0, ahead_from_);
    ahead_from_ = 0;
  }
  while (ahead_.size() - ahead_from_ < count)
  {
    // In pieces: no more memory is taken than the file has data for.
    const std::size_t size = ahead_.size();
    const std::size_t piece = std::min<std::size_t>(count - size, kBufferBytes);
    ahead_.resize(size + piece);
    const std::size_t got = readFile(ahead_.data() + size, piece);
    ahead_.resize(size + got);
    if (got < piece) break;
  }
  return std::string_view(ahead_).substr(ahead_from_);
}

bool GzipInput::atEnd()
{
  return peek(1).empty();
}

void GzipInput::skipToEnd(std::uint64_t most)
{
  std::vector<char> skipped(kBufferBytes);
  for (std::uint64_t done = 0; done < most; done += skipped.size())
  {
    if (Read(skipped.data(), skipped.size()) < skipped.size()) return;
  }
}

double GzipInput::progress() const
{
  if (file_->unpackedSize() == 0) return 1.0;
  // By unpacked bytes: a small packed file is read into the buffer at once.
  return std::min(1.0, static_cast<double>(position_) / static_cast<double>(file_->unpackedSize()));
}

std::string GzipInput::nextClassName()
{
  const auto header = objectHeaderIn(peek(kLongestObjectHeader));
  return header ? std::string(header->name) : std::string{};
}

void GzipInput::change(std::size_t at, char value)
{
  ahead_.at(ahead_from_ + at) = value;
}

void GzipInput::leaveOut(std::size_t at, std::size_t count)
{
  ahead_.erase(ahead_from_ + at, count);
}

void GzipInput::drop(std::size_t count)
{
  const std::size_t dropped = std::min(count, ahead_.size() - ahead_from_);
  ahead_from_ += dropped;
  position_ += dropped;
}

std::size_t GzipInput::Write(const void*, std::size_t)
{
  throw std::logic_error("GzipInput is for reading only");
}

std::uint64_t GzipInput::Seek(std::int64_t, TSeekOrigin)
{
  throw std::logic_error("GzipInput reads front to back only");
}

}  // namespace sigloc::detail
