// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/maps/gray_image.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <cctype>
#include <csetjmp>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "io/archive/file_fault.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Throws for a picture that is empty or larger than a map may be.
void requireSize(const std::filesystem::path& path, double width, double height)
{
  constexpr double kLongestSide = 1e6;
  const bool usual = std::max(width, height) <= kLongestSide;
  if (usual && width * height >= 1 && width * height <= kMostCells) return;
  fail(path,
       fmt::format("a picture of {:.0f} x {:.0f} pixels, not of 1 to {:g}, at most {:g} a side",
                   width, height, kMostCells, kLongestSide));
}

/// Returns the next number of a PGM's head or text, behind blanks and comments, or -1 for none.
/// One character behind it is consumed.
int nextNumber(std::FILE* file)
{
  constexpr int kMost = 100000000;
  int c = std::fgetc(file);
  while (std::isspace(c) != 0 || c == '#')
  {
    const bool comment = c == '#';
    while (comment && c != '\n' && c != EOF) c = std::fgetc(file);
    c = std::fgetc(file);
  }
  if (std::isdigit(c) == 0) return -1;
  int number = 0;
  for (; std::isdigit(c) != 0 && number <= kMost; c = std::fgetc(file))
  {
    number = 10 * number + (c - '0');
  }
  return number <= kMost ? number : -1;
}

/// Throws for a picture of more data than its file can hold, before memory or time is taken for it.
void requireData(const std::filesystem::path& path, double least)
{
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(path, error));
  if (error || least > size) fail(path, "its picture is cut off");
}

using TakeRow = std::function<void(const GrayRow&)>;

void readPgm(std::FILE* file, bool text, const std::filesystem::path& path, const TakeRow& take)
{
  constexpr int kWhite = 255;
  constexpr int kMostWhite = 65535;
  const int width = nextNumber(file);
  const int height = nextNumber(file);
  const int white = nextNumber(file);
  if (width < 0 || height < 0 || white < 1 || white > kMostWhite) fail(path, "not a PGM picture");
  requireSize(path, width, height);
  // Of a text, a digit and what ends it.
  requireData(path, (text || white > kWhite ? 2.0 : 1.0) * width * height);
  GrayRow row;
  row.width = static_cast<std::uint32_t>(width);
  row.height = static_cast<std::uint32_t>(height);
  row.shades.resize(row.width);
  const auto shade_of = [&](int value)
  {
    // The last number of a text may end with the file.
    if (value < 0 || (!text && std::feof(file) != 0)) fail(path, "its picture is cut off");
    if (value > white) fail(path, "its picture has a pixel whiter than white");
    return static_cast<std::uint8_t>((value * kWhite + white / 2) / white);
  };
  for (; row.y < row.height; ++row.y)
  {
    if (!text && white == kWhite)  // almost every map
    {
      if (std::fread(row.shades.data(), 1, row.width, file) < row.width)
        fail(path, "its picture is cut off");
    }
    else
    {
      for (std::uint8_t& shade : row.shades)
      {
        int value = text ? nextNumber(file) : std::fgetc(file);
        if (!text && white > kWhite && value >= 0) value = 256 * value + std::fgetc(file);
        shade = shade_of(value);
      }
    }
    take(row);
  }
}

/// What libpng calls back; it must not return.
[[noreturn]] void onPngError(png_structp png, png_const_charp)
{
  png_longjmp(png, 1);
}
void onPngWarning(png_structp, png_const_charp) {}

/// libpng's structures for reading.
struct PngReader
{
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, onPngError, onPngWarning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;

  PngReader() = default;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

// The two calls into libpng that may jump back hold no object with a destructor.

/// Reads the head and asks for rows of gray and alpha or of colours and alpha, of one byte each.
bool readPngHead(const PngReader& reader, std::FILE* file)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_init_io(reader.png, file);
  // So that a picture's own limits are asked, not libpng's of a million pixels a side.
  png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_scale_16(reader.png);
  return true;
}

/// Reads all rows of an interlaced picture, of which none is whole before.
bool readPngRows(const PngReader& reader, png_bytepp rows)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

bool readPngRow(const PngReader& reader, png_bytep row, bool last)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_read_row(reader.png, row, nullptr);
  if (last) png_read_end(reader.png, nullptr);
  return true;
}

bool startPngRows(const PngReader& reader)
{
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

/// Turns the bytes of a row into its shades, and alphas.
void setPixels(GrayRow& row, const std::uint8_t* bytes, std::size_t channels)
{
  if (channels == 1)
  {
    std::copy_n(bytes, row.width, row.shades.begin());
    return;
  }
  const bool has_alpha = channels % 2 == 0;
  const std::size_t colours = has_alpha ? channels - 1 : channels;
  for (std::size_t x = 0; x < row.width; ++x, bytes += channels)
  {
    std::size_t sum = 0;
    for (std::size_t c = 0; c < colours; ++c) sum += bytes[c];
    row.shades[x] = static_cast<std::uint8_t>((sum + colours / 2) / colours);
    if (has_alpha) row.alphas[x] = bytes[colours];
  }
}

/// Throws for an interlaced picture that is large. Its rows are not whole before the last pass, so
/// that all of it is in memory, beside the map.
void requireInterlacedSize(const std::filesystem::path& path, std::size_t row_bytes,
                           std::size_t height)
{
  constexpr double kMostBytes = 1e8;
  if (static_cast<double>(row_bytes) * static_cast<double>(height) <= kMostBytes) return;
  fail(path,
       fmt::format("an interlaced picture of more than {:.0f} MB; save it without interlacing",
                   kMostBytes / 1e6));
}

void readPng(std::FILE* file, const std::filesystem::path& path, const TakeRow& take)
{
  constexpr unsigned kMostChannels = 4;
  const PngReader reader;
  if (reader.info == nullptr || !readPngHead(reader, file)) fail(path, "not a PNG picture");
  GrayRow row;
  row.width = png_get_image_width(reader.png, reader.info);
  row.height = png_get_image_height(reader.png, reader.info);
  requireSize(path, row.width, row.height);
  constexpr double kBestPacking = 1100;  // no picture gets smaller than by this
  const double row_bits = static_cast<double>(row.width) *
                          png_get_bit_depth(reader.png, reader.info) *
                          png_get_channels(reader.png, reader.info);
  requireData(path, row_bits / 8 * row.height / kBestPacking);
  if (!startPngRows(reader)) fail(path, "its picture is damaged");
  const std::size_t channels = png_get_channels(reader.png, reader.info);
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  if (channels < 1 || channels > kMostChannels || row_bytes != channels * row.width)
  {
    fail(path, "a PNG picture of an unknown kind");
  }
  const bool interlaced = png_get_interlace_type(reader.png, reader.info) != PNG_INTERLACE_NONE;
  if (interlaced) requireInterlacedSize(path, row_bytes, row.height);
  row.shades.resize(row.width);
  if (channels % 2 == 0) row.alphas.resize(row.width);
  std::vector<std::uint8_t> bytes(row_bytes * (interlaced ? row.height : 1));
  if (interlaced)
  {
    std::vector<png_bytep> rows(row.height);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = &bytes[y * row_bytes];
    if (!readPngRows(reader, rows.data())) fail(path, "its picture is cut off or damaged");
  }
  for (; row.y < row.height; ++row.y)
  {
    if (!interlaced && !readPngRow(reader, bytes.data(), row.y + 1 == row.height))
      fail(path, "its picture is cut off or damaged");
    setPixels(row, &bytes[interlaced ? row.y * row_bytes : 0], channels);
    take(row);
  }
}
}  // namespace

void readGrayImage(const std::filesystem::path& path, const TakeRow& take)
{
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail(path, "no such file");
  if (!std::filesystem::is_regular_file(status)) fail(path, "is no regular file");
  const File file(std::fopen(path.c_str(), "rbe"), std::fclose);
  if (!file) fail(path, "cannot be read");
  const int first = std::fgetc(file.get());
  const int second = std::fgetc(file.get());
  if (first == EOF) fail(path, "is empty");
  if (first == 'P' && (second == '2' || second == '5'))
    return readPgm(file.get(), second == '2', path, take);
  if ((first == 0x1f && second == 0x8b) || (first == 0x28 && second == 0xb5))
    fail(path, "is packed; unpack the picture first");
  if (first != 0x89 || second != 'P') fail(path, "is no PGM or PNG picture");
  std::rewind(file.get());
  readPng(file.get(), path, take);
}
}  // namespace sigloc::detail
