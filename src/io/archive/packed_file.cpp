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
constexpr std::string_view kGzipMagic = "\x1F\x8B";
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

 private:
  int fd_;
  std::uint64_t size_ = 0;
  bool ended_ = false;
  bool failed_ = false;
};

/// Bytes on their way.
class Buffer
{
 public:
  explicit Buffer(unsigned size) : bytes_(new char[size]), size_(size) {}

  /// Fills the buffer, which must be empty, by a reader of (char*, unsigned). Returns false where
  /// there is no more.
  template <class Reader>
  bool refill(Reader&& read)
  {
    from_ = 0;
    filled_ = read(bytes_.get(), size_);
    return filled_ > 0;
  }
  std::string_view rest() const { return {bytes_.get() + from_, filled_ - from_}; }
  void drop(std::size_t count) { from_ += count; }
  unsigned size() const { return size_; }

 private:
  std::unique_ptr<char[]> bytes_;
  unsigned size_;
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
  return first.substr(0, kGzipMagic.size()) == kGzipMagic;
}

/// Small reads are served from a buffer.
class BufferedFile : public PackedFile
{
 public:
  BufferedFile(std::uint64_t file_size, std::uint64_t unpacked_size, const PackedContents& contents,
               unsigned buffer)
      : PackedFile(file_size, unpacked_size, contents), buffer_(buffer)
  {
  }

  unsigned read(char* to, unsigned count) final
  {
    unsigned done = 0;
    while (done < count)
    {
      const unsigned left = count - done;
      if (buffer_.rest().empty() && left >= buffer_.size()) return done + produce(to + done, left);
      const auto refill = [this](char* bytes, unsigned size) { return produce(bytes, size); };
      if (buffer_.rest().empty() && !buffer_.refill(refill)) break;
      const std::size_t here = buffer_.rest().copy(to + done, left);
      buffer_.drop(here);
      done += static_cast<unsigned>(here);
    }
    return done;
  }

 private:
  /// As read(), without the buffer.
  virtual unsigned produce(char* to, unsigned count) = 0;

  Buffer buffer_;
};

class PlainFile final : public BufferedFile
{
 public:
  PlainFile(File file, unsigned buffer)
      : BufferedFile(file.size(), file.size(), {file.size(), file.size(), false}, buffer),
        file_(std::move(file))
  {
  }
  bool broken() const override { return file_.failed(); }
  bool wrong() const override { return false; }
  bool plain() const override { return true; }

 private:
  unsigned produce(char* to, unsigned count) override
  {
    return static_cast<unsigned>(file_.read(to, count));
  }

  File file_;
};

/// A file that a decoder unpacks, piece by piece.
class StreamFile : public BufferedFile
{
 public:
  StreamFile(File&& file, std::uint64_t unpacked_size, const PackedContents& contents,
             unsigned buffer)
      : BufferedFile(file.size(), unpacked_size, contents, buffer),
        file_(std::move(file)),
        packed_(buffer)
  {
  }
  bool broken() const final { return wrong_ || cut_off_; }
  bool wrong() const final { return wrong_; }
  bool plain() const final { return false; }

 protected:
  struct Step
  {
    std::size_t taken = 0;  // bytes of the file
    std::size_t made = 0;  // bytes of the contents
    bool wrong = false;
    bool within_frame = false;
  };

 private:
  virtual Step step(std::string_view in, char* to, unsigned room) = 0;

  unsigned produce(char* to, unsigned count) final
  {
    unsigned done = 0;
    while (done < count && !wrong_)
    {
      const auto refill = [this](char* bytes, unsigned size) { return file_.read(bytes, size); };
      const bool ended = packed_.rest().empty() && !packed_.refill(refill);
      // At the end, what is still in the decoder comes out without more input.
      const unsigned made = ended && !within_frame_ ? 0 : decode(to + done, count - done);
      done += made;
      if (!ended || made > 0) continue;
      cut_off_ = within_frame_ || file_.failed();
      break;
    }
    return done;
  }

  unsigned decode(char* to, unsigned room)
  {
    const Step done = step(packed_.rest(), to, room);
    packed_.drop(done.taken);
    wrong_ = done.wrong;
    within_frame_ = done.within_frame;
    return static_cast<unsigned>(done.made);
  }

  File file_;
  Buffer packed_;
  bool within_frame_ = false;
  bool cut_off_ = false;
  bool wrong_ = false;
};

/// By zlib itself: its gzread passes over what follows the last member and is none.
class GzipFile final : public StreamFile
{
 public:
  GzipFile(File file, std::uint64_t unpacked_size, unsigned buffer)
      : StreamFile(std::move(file), unpacked_size, {0, kMostOfGzip * file.size(), false}, buffer)
  {
    constexpr int kOfGzip = 16;  // its head and checksum, not those of zlib
    ready_ = inflateInit2(&stream_, MAX_WBITS + kOfGzip) == Z_OK;
  }
  ~GzipFile() override { inflateEnd(&stream_); }
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

 private:
  Step step(std::string_view in, char* to, unsigned room) override
  {
    Step done;
    if (!within_member_)
    {
      // Zeros fill the last block of a tape.
      done.taken = std::min(in.find_first_not_of('\0'), in.size());
      if (done.taken == in.size()) return done;
      in.remove_prefix(done.taken);
      // zlib judges by two bytes, and would take a single one for a head that is cut off.
      done.wrong = in.front() != kGzipMagic.front();
      if (done.wrong) return done;
      inflateReset(&stream_);
    }
    // zlib takes what it reads for writable, and writes nothing.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in.data()));
    stream_.avail_in = static_cast<uInt>(in.size());
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = room;
    const int code = ready_ ? inflate(&stream_, Z_NO_FLUSH) : Z_MEM_ERROR;
    done.taken += in.size() - stream_.avail_in;
    done.made = room - stream_.avail_out;
    // Z_BUF_ERROR: there was nothing to take.
    done.wrong = code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR;
    done.within_frame = within_member_ = code != Z_STREAM_END;
    return done;
  }

  z_stream stream_ = {};
  bool ready_ = false;
  bool within_member_ = false;
};

class ZstdFile final : public StreamFile
{
 public:
  ZstdFile(File file, std::uint64_t unpacked_size, unsigned buffer)
      : StreamFile(std::move(file), unpacked_size,
                   walkZstd([&file](std::uint64_t place, std::size_t count)
                            { return file.bytesAt(place, count); }),
                   buffer),
        stream_(ZSTD_createDStream())
  {
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, kMostWindow);
  }

 private:
  Step step(std::string_view in, char* to, unsigned room) override
  {
    ZSTD_inBuffer input{in.data(), in.size(), 0};
    ZSTD_outBuffer output{to, room, 0};
    const std::size_t left = ZSTD_decompressStream(stream_.get(), &output, &input);
    without_output_ = output.pos > 0 ? 0 : without_output_ + input.pos;
    const bool wrong = ZSTD_isError(left) != 0 || without_output_ > kMostWithoutOutput;
    return {input.pos, output.pos, wrong, left != 0};
  }

  struct Free
  {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };

  std::unique_ptr<ZSTD_DStream, Free> stream_;
  std::uint64_t without_output_ = 0;  // bytes read since the last output
};

/// gzip's last field, little-endian, is the size of its contents. Of a file with zeros or a member
/// behind it, that is a guess.
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
  return std::max(size, file.size());
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
