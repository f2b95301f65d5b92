// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/io/file_output.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <mrpt/io/CStream.h>
#include <mrpt/serialization/CArchive.h>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sigloc
{
namespace
{
namespace fs = std::filesystem;
constexpr const char* kTemporaryEnding = ".part-";

[[noreturn]] void fail(const std::string& name, int code)
{
  throw std::runtime_error(name + ": cannot be written: " + std::generic_category().message(code));
}

/// The code of the last error, where the system or zlib gives one.
int lastError()
{
  return errno != 0 ? errno : EIO;
}

/// Calls fsync() or syncfs() for a file or folder. Returns the code of the error, 0 for none.
int synced(const fs::path& path, int (*sync)(int))
{
  errno = 0;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return lastError();
  const int code = sync(file) == 0 ? 0 : lastError();
  ::close(file);
  return code == EINVAL ? 0 : code;  // of files that no disk holds
}

/// The temporary file beside a file. The destructor removes it unless it was renamed to the file.
class TemporaryFile
{
 public:
  explicit TemporaryFile(const fs::path& path) : path_(path)
  {
    std::error_code unnameable;
    const bool is_link = fs::is_symlink(path, unnameable) && fs::exists(path, unnameable);
    target_ = is_link ? fs::canonical(path) : path;
    // A device or a pipe would be lost, since the file takes its name.
    const fs::file_status status = fs::status(target_, unnameable);
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
      throw std::runtime_error(path.string() + ": is no regular file, and is not replaced");
    // A name of the greatest length leaves no room for the ending.
    constexpr std::size_t kLongestStem = 200;
    const std::string stem = target_.filename().string().substr(0, kLongestStem);
    temporary_ = target_.parent_path() / fmt::format("{}{}{}", stem, kTemporaryEnding, getpid());
  }
  ~TemporaryFile()
  {
    std::error_code ignored;
    if (!kept_) fs::remove(temporary_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const fs::path& path() const { return temporary_; }

  /// Takes the error, 0 for none, that writing ended with.
  void keepUnless(int error, Durability durability)
  {
    if (error == 0 && durability == Durability::at_once) error = synced(temporary_, fsync);
    if (error != 0) fail(path_.string(), error);
    std::error_code code;
    fs::rename(temporary_, target_, code);
    if (code) fail(path_.string(), code.value());
    kept_ = true;
    // The new name is the folder's content. The file is whole either way, so errors do not count.
    if (durability == Durability::at_once) synced(fs::absolute(target_).parent_path(), fsync);
  }

 private:
  fs::path path_;  // as the user named it
  fs::path target_;
  fs::path temporary_;
  bool kept_ = false;
};

/// Returns the code of the first error, 0 for none.
int writeBytes(int file, std::string_view bytes)
{
  while (!bytes.empty())
  {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return lastError();
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, written)));
  }
  return 0;
}

/// Opens a new file for writing. Returns a negative number where that fails.
int openNew(const fs::path& path)
{
  constexpr mode_t kPermissions = 0666;  // less the user's mask
  errno = 0;
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kPermissions);
}

/// A compressed file. An error is kept until close(). If it were thrown into MRPT's serialization,
/// a call stack would be added to its message. MRPT's own stream loses the errors of closing.
class PackedOutput : public mrpt::io::CStream
{
 public:
  std::size_t Write(const void* buffer, std::size_t count) override
  {
    errno = 0;
    if (error_ == 0) error_ = pack({static_cast<const char*>(buffer), count});
    position_ += count;
    return count;
  }

  /// Returns the code of the first error, 0 for none.
  int close()
  {
    errno = 0;
    const int code = finish();
    if (error_ == 0) error_ = code;
    return error_;
  }

  std::size_t Read(void*, std::size_t) override
  {
    throw std::logic_error("PackedOutput is for writing only");
  }
  std::uint64_t Seek(std::int64_t, TSeekOrigin) override
  {
    throw std::logic_error("PackedOutput writes front to back only");
  }
  std::uint64_t getTotalBytesCount() const override { return position_; }
  std::uint64_t getPosition() const override { return position_; }

 protected:
  /// Both return the code of an error, 0 for none.
  virtual int pack(std::string_view bytes) = 0;
  virtual int finish() = 0;

  int error_ = 0;

 private:
  std::uint64_t position_ = 0;
};

class GzipOutput final : public PackedOutput
{
 public:
  GzipOutput(const fs::path& path, int level)
  {
    errno = 0;
    file_ = gzopen(path.c_str(), fmt::format("wb{}", level).c_str());
    if (file_ == nullptr) error_ = lastError();
    if (file_ != nullptr) gzbuffer(file_, kBufferBytes);
  }
  ~GzipOutput() override { GzipOutput::finish(); }
  GzipOutput(const GzipOutput&) = delete;
  GzipOutput& operator=(const GzipOutput&) = delete;

 private:
  static constexpr unsigned kBufferBytes = 256U * 1024U;

  int pack(std::string_view bytes) override
  {
    while (!bytes.empty())
    {
      // gzwrite takes at most INT_MAX bytes a call.
      const std::string_view chunk = bytes.substr(0, 1U << 30U);
      const auto size = static_cast<unsigned>(chunk.size());
      if (gzwrite(file_, chunk.data(), size) != static_cast<int>(size)) return lastError();
      bytes.remove_prefix(chunk.size());
    }
    return 0;
  }

  int finish() override
  {
    const bool closed = file_ == nullptr || gzclose(std::exchange(file_, nullptr)) == Z_OK;
    return closed ? 0 : lastError();
  }

  gzFile file_ = nullptr;
};

class ZstdOutput final : public PackedOutput
{
 public:
  explicit ZstdOutput(const fs::path& path)
      : file_(openNew(path)), packed_(ZSTD_CStreamOutSize(), '\0'), stream_(ZSTD_createCStream())
  {
    if (file_ < 0) error_ = lastError();
    ZSTD_CCtx_setParameter(stream_.get(), ZSTD_c_compressionLevel, 1);
    ZSTD_CCtx_setParameter(stream_.get(), ZSTD_c_checksumFlag, 1);
  }
  ~ZstdOutput() override
  {
    if (file_ >= 0) ::close(file_);
  }
  ZstdOutput(const ZstdOutput&) = delete;
  ZstdOutput& operator=(const ZstdOutput&) = delete;

 private:
  struct Free
  {
    void operator()(ZSTD_CStream* stream) const { ZSTD_freeCStream(stream); }
  };

  int pack(std::string_view bytes) override { return write(bytes, ZSTD_e_continue); }

  int finish() override
  {
    const int code = error_ == 0 ? write({}, ZSTD_e_end) : 0;
    const bool closed = file_ < 0 || ::close(std::exchange(file_, -1)) == 0;
    return code == 0 && !closed ? lastError() : code;
  }

  int write(std::string_view bytes, ZSTD_EndDirective directive)
  {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (std::size_t left = 1; left > 0;)
    {
      ZSTD_outBuffer out{packed_.data(), packed_.size(), 0};
      left = ZSTD_compressStream2(stream_.get(), &out, &in, directive);
      if (ZSTD_isError(left) != 0) return ENOMEM;
      const int code = writeBytes(file_, std::string_view(packed_).substr(0, out.pos));
      if (code != 0) return code;
      // What it holds back comes out at the end.
      if (directive == ZSTD_e_continue) left = in.size - in.pos;
    }
    return 0;
  }

  int file_;
  std::string packed_;
  std::unique_ptr<ZSTD_CStream, Free> stream_;
};

std::unique_ptr<PackedOutput> packedOutput(const fs::path& path, Packing packing)
{
  if (packing == Packing::zstd) return std::make_unique<ZstdOutput>(path);
  constexpr int kQuickest = 1;
  constexpr int kSmallest = 9;
  return std::make_unique<GzipOutput>(path, packing == Packing::small_gzip ? kSmallest : kQuickest);
}
}  // namespace

void writeFile(const fs::path& path, std::string_view bytes, Durability durability)
{
  TemporaryFile temporary(path);
  const int file = openNew(temporary.path());
  if (file < 0) fail(path.string(), lastError());
  const int error = writeBytes(file, bytes);
  const bool closed = ::close(file) == 0;
  temporary.keepUnless(error == 0 && !closed ? lastError() : error, durability);
}

void writeObjects(const fs::path& path,
                  const std::function<void(mrpt::serialization::CArchive&)>& write, Packing packing,
                  Durability durability)
{
  TemporaryFile temporary(path);
  const std::unique_ptr<PackedOutput> output = packedOutput(temporary.path(), packing);
  auto archive = mrpt::serialization::archiveFrom(*output);
  write(archive);
  temporary.keepUnless(output->close(), durability);
}

void syncFolder(const fs::path& folder)
{
  // One call for the whole file system takes a hundredth of the time of one for each file.
  const int error = synced(folder, syncfs);
  if (error != 0) fail(folder.string(), error);
}

std::string withoutTemporaryEnding(const std::string& name)
{
  const std::size_t ending = name.rfind(kTemporaryEnding);
  if (ending == std::string::npos) return name;
  const std::size_t digits = ending + std::string_view(kTemporaryEnding).size();
  const bool numbered =
      digits < name.size() && name.find_first_not_of("0123456789", digits) == std::string::npos;
  return numbered ? name.substr(0, ending) : name;
}
}  // namespace sigloc
