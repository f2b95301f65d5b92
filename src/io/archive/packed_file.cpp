// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/packed_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <utility>

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostHeader = 18;  // bytes of a zstd frame's header
constexpr std::uint64_t kMostOfGzip = 1032;  // times its size: what a byte unpacks to at most
constexpr std::uint64_t kUsualRatio = 3;  // of logs
constexpr int kMostWindow = 27;  // log2 of the bytes that unpacking zstd may take, as its program
constexpr std::uint64_t kLeastBuffer = 4096;

/// An open file. Opened once, it is the same file for all that looks at it.
class File
{
 public:
  explicit File(const std::filesystem::path& path) : fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC))
  {
    struct stat status = {};
    if (fd_ >= 0 && fstat(fd_, &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
  }
  ~File()
  {
    if (fd_ >= 0) close(fd_);
  }
  File(File&& other) noexcept : fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  File& operator=(File&&) = delete;

  bool isOpen() const { return fd_ >= 0; }
  std::uint64_t size() const { return size_; }

  /// Returns the bytes read, fewer than `count` at the end or where reading fails.
  std::size_t read(char* buffer, std::size_t count)
  {
    std::size_t done = 0;
    while (done < count && !ended_)
    {
      const ssize_t got = ::read(fd_, buffer + done, count - done);
      if (got < 0 && errno == EINTR) continue;
      failed_ = got < 0;
      ended_ = got <= 0;
      if (!ended_) done += static_cast<std::size_t>(got);
    }
    return done;
  }
  bool failed() const { return failed_; }

  /// Returns up to `count` bytes from a place on, and leaves the place that read() is at.
  std::string bytesAt(std::uint64_t place, std::size_t count) const
  {
    std::string bytes(count, '\0');
    const ssize_t got = pread(fd_, bytes.data(), count, static_cast<off_t>(place));
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

  /// Gives the descriptor away.
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
  std::uint64_t size_ = 0;
  bool ended_ = false;
  bool failed_ = false;
};

/// Bytes of a file on their way.
class Buffer
{
 public:
  explicit Buffer(unsigned size) : bytes_(new char[size]), size_(size) {}

  /// Fills the buffer, which must be empty. Returns false at the end of the file.
  bool refill(File& file)
  {
    from_ = 0;
    filled_ = file.read(bytes_.get(), size_);
    return filled_ > 0;
  }
  std::string_view rest() const { return {bytes_.get() + from_, filled_ - from_}; }
  void drop(std::size_t count) { from_ += count; }
  std::size_t size() const { return size_; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_;
  std::size_t from_ = 0;
  std::size_t filled_ = 0;
};

/// True for a frame that zstd skips: it holds what its maker notes beside the data.
bool isSkippable(std::string_view first)
{
  return first.size() >= 4 && (first[0] & '\xF0') == '\x50' && first.substr(1, 3) == "\x2A\x4D\x18";
}

bool isZstd(std::string_view first)
{
  return first.substr(0, 4) == "\x28\xB5\x2F\xFD" || isSkippable(first);
}

bool isGzip(std::string_view first)
{
  return first.substr(0, 2) == "\x1F\x8B";
}

class PlainFile final : public PackedFile
{
 public:
  PlainFile(File file, unsigned buffer)
      : PackedFile(file.size(), file.size(), {file.size(), file.size(), false}),
        file_(std::move(file)),
        buffer_(buffer)
  {
  }

  unsigned read(char* to, unsigned count) override
  {
    std::size_t done = 0;
    while (done < count)
    {
      const std::size_t left = count - done;
      if (buffer_.rest().empty() && left >= buffer_.size())
      {
        done += file_.read(to + done, left);
        break;
      }
      if (buffer_.rest().empty() && !buffer_.refill(file_)) break;
      const std::size_t here = buffer_.rest().copy(to + done, left);
      buffer_.drop(here);
      done += here;
    }
    return static_cast<unsigned>(done);
  }
  bool broken() const override { return file_.failed(); }
  bool wrong() const override { return false; }
  bool plain() const override { return true; }

 private:
  File file_;
  Buffer buffer_;
};

class GzipFile final : public PackedFile
{
 public:
  GzipFile(File file, std::uint64_t unpacked_size, unsigned buffer)
      : PackedFile(file.size(), unpacked_size, {0, kMostOfGzip * file.size(), false}),
        file_(gzdopen(file.release(), "rb"))
  {
    gzbuffer(file_, buffer);  // it takes three times this
  }
  ~GzipFile() override { gzclose(file_); }
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  unsigned read(char* to, unsigned count) override
  {
    const int got = gzread(file_, to, count);
    if (got != static_cast<int>(count))
    {
      int code = Z_OK;
      gzerror(file_, &code);
      broken_ = broken_ || got < 0 || (code != Z_OK && code != Z_STREAM_END);
      wrong_ = wrong_ || code == Z_DATA_ERROR;
    }
    return got > 0 ? static_cast<unsigned>(got) : 0;
  }
  bool broken() const override { return broken_; }
  bool wrong() const override { return wrong_; }
  bool plain() const override { return false; }

 private:
  gzFile file_;
  bool broken_ = false;
  bool wrong_ = false;
};

class ZstdFile final : public PackedFile
{
 public:
  ZstdFile(File file, std::uint64_t unpacked_size, unsigned buffer)
      : PackedFile(file.size(), unpacked_size,
                   walkZstd([&file](std::uint64_t place, std::size_t count)
                            { return file.bytesAt(place, count); })),
        file_(std::move(file)),
        buffer_(buffer),
        stream_(ZSTD_createDStream())
  {
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, kMostWindow);
  }

  unsigned read(char* to, unsigned count) override
  {
    ZSTD_outBuffer out{to, count, 0};
    while (out.pos < out.size && !wrong_)
    {
      if (buffer_.rest().empty() && !buffer_.refill(file_))
      {
        // What is still in the decoder comes out without more input.
        const std::size_t before = out.pos;
        if (within_frame_) step(out);
        if (out.pos > before) continue;
        cut_off_ = within_frame_ || file_.failed();
        break;
      }
      step(out);
    }
    return static_cast<unsigned>(out.pos);
  }
  bool broken() const override { return wrong_ || cut_off_; }
  bool wrong() const override { return wrong_; }
  bool plain() const override { return false; }

 private:
  void step(ZSTD_outBuffer& out)
  {
    const std::string_view rest = buffer_.rest();
    ZSTD_inBuffer in{rest.data(), rest.size(), 0};
    const std::size_t before = out.pos;
    const std::size_t left = ZSTD_decompressStream(stream_.get(), &out, &in);
    buffer_.drop(in.pos);
    without_output_ = out.pos > before ? 0 : without_output_ + in.pos;
    wrong_ = ZSTD_isError(left) != 0 || without_output_ > kMostWithoutOutput;
    within_frame_ = left != 0;
  }

  struct Free
  {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };

  File file_;
  Buffer buffer_;
  std::unique_ptr<ZSTD_DStream, Free> stream_;
  std::uint64_t without_output_ = 0;  // bytes read since the last output
  bool within_frame_ = false;
  bool cut_off_ = false;
  bool wrong_ = false;
};

/// gzip's last field, little-endian, is the size of its contents.
std::uint64_t sizeInGzip(const File& file)
{
  constexpr std::uint64_t kTrailerBytes = 4;
  if (file.size() < kTrailerBytes) return file.size();
  const std::string bytes = file.bytesAt(file.size() - kTrailerBytes, kTrailerBytes);
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    size |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return size;
}

std::uint64_t sizeInZstd(const File& file, std::string_view first)
{
  const unsigned long long size = ZSTD_getFrameContentSize(first.data(), first.size());
  const bool told = size < ZSTD_CONTENTSIZE_ERROR && !isSkippable(first);
  return told ? size : kUsualRatio * file.size();
}
}  // namespace

bool beginsPacked(std::string_view bytes)
{
  return isZstd(bytes) || isGzip(bytes);
}

std::unique_ptr<PackedFile> openPacked(const std::filesystem::path& path, unsigned most_buffer)
{
  File file(path);
  if (!file.isOpen()) return nullptr;
  const std::string first = file.bytesAt(0, kMostHeader);
  // Small files are many, and read sooner so.
  const auto buffer =
      static_cast<unsigned>(std::clamp<std::uint64_t>(file.size(), kLeastBuffer, most_buffer));
  if (isZstd(first))
  {
    const std::uint64_t size = sizeInZstd(file, first);
    return std::make_unique<ZstdFile>(std::move(file), size, buffer);
  }
  if (isGzip(first))
  {
    const std::uint64_t size = sizeInGzip(file);
    return std::make_unique<GzipFile>(std::move(file), size, buffer);
  }
  return std::make_unique<PlainFile>(std::move(file), buffer);
}
}  // namespace sigloc::detail
