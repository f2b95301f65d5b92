// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/archive/zstd_walk.h"

#include <algorithm>
#include <array>

namespace sigloc::detail
{
namespace
{
constexpr std::uint64_t kZstdMagic = 0xFD2FB528;
constexpr std::uint64_t kSkippable = 0x184D2A50;  // and the 15 after it
constexpr std::uint64_t kMostOfBlock = 1U << 17U;  // bytes

enum BlockType : std::uint64_t
{
  raw = 0,
  repeated = 1,  // one byte
  compressed = 2,
};

/// The file ends here. What was walked over before counts.
struct WalkEnded
{
};
/// What comes next is no zstd.
struct WalkDamaged
{
};

/// A file's bytes, front to back. Most of them are passed over unread.
class PackedBytes
{
 public:
  explicit PackedBytes(const BytesAt& bytes_at) : bytes_at_(bytes_at) {}

  /// Returns the next number of so many bytes, little-endian. Throws WalkEnded.
  std::uint64_t number(std::size_t bytes)
  {
    require(bytes);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
    {
      const auto byte = static_cast<unsigned char>(piece_[at_ - from_ + i]);
      value |= std::uint64_t{byte} << (8 * i);
    }
    at_ += bytes;
    return value;
  }

  /// Throws WalkEnded where the file does not have so many.
  void skip(std::uint64_t bytes)
  {
    if (bytes == 0) return;
    at_ += bytes - 1;
    number(1);
  }

  bool atEnd()
  {
    try
    {
      require(1);
      return false;
    }
    catch (const WalkEnded&)
    {
      return true;
    }
  }

 private:
  void require(std::size_t bytes)
  {
    if (at_ + bytes <= from_ + piece_.size()) return;
    constexpr std::size_t kPiece = 1U << 12U;  // bytes
    from_ = at_;
    piece_ = bytes_at_(at_, kPiece);
    if (piece_.size() < bytes) throw WalkEnded();
  }

  const BytesAt& bytes_at_;
  std::string piece_;
  std::uint64_t from_ = 0;  // where the piece begins
  std::uint64_t at_ = 0;
};

/// Adds the blocks of a frame, whose head may tell what they hold.
void walkFrame(PackedBytes& bytes, PackedContents& contents)
{
  const std::uint64_t descriptor = bytes.number(1);
  const bool single_segment = (descriptor >> 5U & 1U) != 0;
  const bool has_checksum = (descriptor >> 2U & 1U) != 0;
  constexpr std::array<std::size_t, 4> kDictionaryBytes = {0, 1, 2, 4};
  bytes.skip((single_segment ? 0 : 1) + kDictionaryBytes[descriptor & 3U]);
  const std::uint64_t size_flag = descriptor >> 6U;
  const std::size_t size_bytes = size_flag == 0 ? (single_segment ? 1 : 0) : 1U << size_flag;
  constexpr std::uint64_t kOfTwoBytes = 256;  // is added to those
  const std::uint64_t told =
      size_bytes == 0 ? 0 : bytes.number(size_bytes) + (size_bytes == 2 ? kOfTwoBytes : 0);

  constexpr std::uint64_t kMostTold = std::uint64_t{1} << 60U;
  if (told > kMostTold) throw WalkDamaged();

  const std::uint64_t before = contents.least;
  std::uint64_t without_output = 0;
  for (bool last = false; !last;)
  {
    const std::uint64_t head = bytes.number(3);
    last = (head & 1U) != 0;
    const std::uint64_t type = head >> 1U & 3U;
    const std::uint64_t size = head >> 3U;
    constexpr std::uint64_t kHeadBytes = 3;
    without_output = size > 0 ? 0 : without_output + kHeadBytes;
    if (type > compressed || size > kMostOfBlock || without_output > kMostWithoutOutput)
      throw WalkDamaged();
    bytes.skip(type == repeated ? 1 : size);
    contents.least += type == compressed ? 0 : size;
    contents.most += type == compressed ? kMostOfBlock : size;
  }
  bytes.skip(has_checksum ? 4 : 0);
  contents.least = std::max(contents.least, before + told);
}
}  // namespace

PackedContents walkZstd(const BytesAt& bytes_at)
{
  PackedBytes bytes(bytes_at);
  PackedContents contents;
  contents.most = 0;
  try
  {
    while (!bytes.atEnd())
    {
      const std::uint64_t magic = bytes.number(4);
      if ((magic & ~std::uint64_t{15}) == kSkippable)
      {
        bytes.skip(bytes.number(4));
        continue;
      }
      if (magic != kZstdMagic) throw WalkDamaged();
      walkFrame(bytes, contents);
    }
  }
  catch (const WalkEnded&)
  {
    contents.cut_off = true;
  }
  catch (const WalkDamaged&)
  {
    contents.most = UINT64_MAX;
  }
  return contents;
}
}  // namespace sigloc::detail
