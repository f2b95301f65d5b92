// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "picture_file.h"

#include <png.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "sigloc/io/file_output.h"

namespace sigloc
{
namespace
{
/// The picture as a PNG, in memory.
std::string encoded(const mrpt::img::CImage& picture)
{
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(picture.getWidth());
  png.height = static_cast<png_uint_32>(picture.getHeight());
  png.format = picture.getChannelsOrder() == "BGR" ? PNG_FORMAT_BGR : PNG_FORMAT_RGB;
  const auto* const pixels = picture.ptrLine<std::uint8_t>(0);
  const auto stride = static_cast<png_int_32>(picture.getRowStride());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, stride, nullptr) == 0)
  {
    throw std::runtime_error(std::string("a picture cannot be encoded: ") + png.message);
  }
  bytes.resize(size);
  return bytes;
}
}  // namespace

void savePicture(const mrpt::img::CImage& picture, const std::filesystem::path& path)
{
  if (picture.isEmpty() || !picture.isColor()) throw std::logic_error("savePicture: no colours");
  writeFile(path, encoded(picture));
}
}  // namespace sigloc
