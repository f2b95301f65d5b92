// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/packed_file.h"

#include <zlib.h>
#include <zstd.h>

#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace sigloc::detail
{
namespace
{
constexpr std::size_t kMostHeader = 18;  // bytes of a zstd frame's header
constexpr std::uint64_t kUsualRatio = 3;  // of logs
constexpr int kMostWindow = 27;  // log2 of the bytes that unpacking zstd may take, as its program

std::string firstBytes(const std::filesystem::path& path)
{
  std::string bytes(kMostHeader, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

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

/// Plain, or compressed by gzip.
class GzipFile final : public PackedFile
{
 public:
  GzipFile(gzFile file, unsigned buffer) : file_(file) { gzbuffer(file_, buffer); }
  ~GzipFile() override { gzclose(file_); }
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  unsigned read(char* buffer, unsigned count) override
  {
    const int got = gzread(file_, buffer, count);
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
  bool plain() const override { return gzdirect(file_) != 0; }

 private:
  gzFile file_;
  bool broken_ = false;
  bool wrong_ = false;
};

class ZstdFile final : public PackedFile
{
 public:
  ZstdFile(const std::filesystem::path& path, unsigned buffer)
      : file_(path, std::ios::binary), packed_(buffer), stream_(ZSTD_createDStream())
  {
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, kMostWindow);
  }

  unsigned read(char* buffer, unsigned count) override
  {
    ZSTD_outBuffer out{buffer, count, 0};
    while (out.pos < out.size && !wrong_)
    {
      if (in_.pos == in_.size && !refill())
      {
        // What is still in the decoder comes out without more input.
        const std::size_t before = out.pos;
        if (within_frame_) step(out);
        if (out.pos > before) continue;
        cut_off_ = within_frame_;
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
  bool refill()
  {
    file_.read(packed_.data(), static_cast<std::streamsize>(packed_.size()));
    in_ = {packed_.data(), static_cast<std::size_t>(file_.gcount()), 0};
    return in_.size > 0;
  }

  void step(ZSTD_outBuffer& out)
  {
    const std::size_t left = ZSTD_decompressStream(stream_.get(), &out, &in_);
    wrong_ = ZSTD_isError(left) != 0;
    within_frame_ = left != 0;
  }

  struct Free
  {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };

  std::ifstream file_;
  std::vector<char> packed_;
  ZSTD_inBuffer in_{nullptr, 0, 0};
  std::unique_ptr<ZSTD_DStream, Free> stream_;
  bool within_frame_ = false;
  bool cut_off_ = false;
  bool wrong_ = false;
};
}  // namespace

bool beginsPacked(std::string_view bytes)
{
  return isZstd(bytes) || isGzip(bytes);
}

std::unique_ptr<PackedFile> openPacked(const std::filesystem::path& path, unsigned buffer)
{
  if (isZstd(firstBytes(path))) return std::make_unique<ZstdFile>(path, buffer);
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return nullptr;
  return std::make_unique<GzipFile>(file, buffer);
}

std::uint64_t unpackedSize(const std::filesystem::path& path, std::uint64_t file_size)
{
  constexpr std::uint64_t kTrailerBytes = 4;  // gzip's last field, little-endian
  const std::string first = firstBytes(path);
  if (isZstd(first))
  {
    const unsigned long long size = ZSTD_getFrameContentSize(first.data(), first.size());
    const bool told = size < ZSTD_CONTENTSIZE_ERROR && !isSkippable(first);
    return told ? size : kUsualRatio * file_size;
  }
  if (!isGzip(first) || file_size < kTrailerBytes) return file_size;
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(kTrailerBytes), std::ios::end);
  std::uint64_t size = 0;
  for (std::uint64_t i = 0; i < kTrailerBytes; ++i)
  {
    size |= static_cast<std::uint64_t>(file.get() & 0xFF) << (8 * i);
  }
  return size;
}
}  // namespace sigloc::detail
