// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "picture_file.h"

#include <zlib.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "sigloc/bridge/file_output.h"

namespace sigloc
{
namespace
{
constexpr std::size_t kChannels = 3;

std::string bigEndian(std::size_t number)
{
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(number >> shift);
  return bytes;
}

const Bytef* bytesOf(const std::string& text)
{
  return reinterpret_cast<const Bytef*>(text.data());
}

/// A part of a PNG: its length, its type and content, and their checksum.
std::string chunk(const std::string& type, const std::string& content)
{
  const std::string body = type + content;
  return bigEndian(content.size()) + body +
         bigEndian(crc32(0, bytesOf(body), static_cast<uInt>(body.size())));
}

/// The rows from the top, each after a 0 that says that it is stored as it is: among pictures of
/// few colours no other way packs better.
std::string rowsOf(const mrpt::img::CImage& picture)
{
  const bool blue_first = picture.getChannelsOrder() == "BGR";
  std::string rows;
  for (unsigned y = 0; y < picture.getHeight(); ++y)
  {
    rows += '\0';
    for (unsigned x = 0; x < picture.getWidth(); ++x)
    {
      const auto* const colours = picture.ptr<std::uint8_t>(x, y);
      for (std::size_t i = 0; i < kChannels; ++i)
      {
        rows += static_cast<char>(colours[blue_first ? kChannels - 1 - i : i]);
      }
    }
  }
  return rows;
}

std::string packed(const std::string& bytes)
{
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(result.data()), &size, bytesOf(bytes),
                             static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  if (code != Z_OK) throw std::runtime_error("a picture cannot be compressed");
  result.resize(size);
  return result;
}
}  // namespace

void savePicture(const mrpt::img::CImage& picture, const std::filesystem::path& path)
{
  if (picture.isEmpty() || !picture.isColor()) throw std::logic_error("savePicture: no colours");
  const std::string format = {8, 2, 0, 0, 0};  // 8 bits a channel, RGB, not interlaced
  writeFile(path, "\x89PNG\r\n\x1a\n" +
                      chunk("IHDR", bigEndian(picture.getWidth()) + bigEndian(picture.getHeight()) +
                                        format) +
                      chunk("IDAT", packed(rowsOf(picture))) + chunk("IEND", ""));
}
}  // namespace sigloc
