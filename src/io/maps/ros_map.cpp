// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "io/archive/file_fault.h"
#include "io/archive/gzip_input.h"
#include "io/maps/gray_image.h"
#include "io/maps/map_formats.h"
#include "io/maps/map_source_readers.h"
#include "io/maps/occupancy_grid.h"
#include "io/maps/ros_map_yaml.h"
#include "map/map_values.h"

namespace sigloc::detail
{
namespace
{
constexpr int kWhiteShade = 255;
constexpr double kWhite = kWhiteShade;
constexpr int kUnknownShade = 205;  // with which map savers write what was never seen
constexpr double kHundred = 100;

/// Returns the occupancy [percent] of a pixel by the map server's own rules, or nullopt where it is
/// unknown.
std::optional<double> occupancyOf(double shade, double alpha, const RosMapHeader& header)
{
  if (header.mode == RosMapMode::raw)
  {
    return shade <= kHundred ? std::optional(shade) : std::nullopt;
  }
  // In this mode, the map server takes an alpha channel for a fourth, or second, colour.
  const double occupied = header.negate ? shade / kWhite : 1 - shade / kWhite;
  if (header.mode == RosMapMode::scale && alpha < kWhite) return std::nullopt;
  if (occupied > header.occupied_threshold) return kHundred;
  if (occupied < header.free_threshold) return 0;
  if (header.mode == RosMapMode::trinary) return std::nullopt;
  const double span = header.occupied_threshold - header.free_threshold;
  return span > 0 ? std::rint((occupied - header.free_threshold) / span * kHundred) : kHundred;
}

/// Returns the shade that the map server takes for a pixel's: an alpha counts as a colour of it.
double shadeOf(int shade, int alpha, bool has_alpha, const RosMapHeader& header)
{
  return has_alpha && header.mode == RosMapMode::trinary ? (3.0 * shade + alpha) / 4 : shade;
}

/// The shade of "never seen". In a map that says `negate` the colours of its image are inverted.
int unknownShade(const RosMapHeader& header)
{
  return header.negate ? kWhiteShade - kUnknownShade : kUnknownShade;
}

/// True where the map server would take the shade of "never seen" for free. In the mode scale it
/// may do so above free_thresh, too. No map saver writes this shade for a probability there.
bool takesUnknownForFree(const RosMapHeader& header, bool has_alpha)
{
  if (header.mode == RosMapMode::raw) return false;
  const double shade = shadeOf(unknownShade(header), kWhiteShade, has_alpha, header);
  const auto percent = occupancyOf(shade, kWhite, header);
  return percent && stateOfOccupancy(*percent / kHundred) == CellState::free;
}

CellState stateOfPixel(int shade, int alpha, bool has_alpha, const RosMapHeader& header)
{
  if (shade == unknownShade(header) && alpha == kWhiteShade &&
      takesUnknownForFree(header, has_alpha))
  {
    return CellState::unknown;
  }
  const auto percent = occupancyOf(shadeOf(shade, alpha, has_alpha, header), alpha, header);
  return percent ? stateOfOccupancy(*percent / kHundred) : CellState::unknown;
}

/// Returns what `read` makes of the image that the yaml at `path` names. An error names both files.
template <class Read>
auto ofImage(const RosMapHeader& header, const std::filesystem::path& path, Read&& read)
{
  try
  {
    return read(header.image);
  }
  catch (const std::runtime_error& error)
  {
    fail(path, std::string("its image ") + error.what());
  }
}

/// Returns the header of a ROS map. Throws where the image that it names is not there: the first
/// image beside it is perhaps the one, renamed.
RosMapHeader headerWithImage(const std::filesystem::path& path)
{
  RosMapHeader header = readRosMapHeader(path);
  std::error_code error;
  const auto status = std::filesystem::status(header.image, error);
  if (status.type() != std::filesystem::file_type::not_found) return header;
  std::string hint = didYouMeanFile(header.image);
  for (const std::string& name : namesIn(folderOf(header.image)))
  {
    if (hint.empty() && mapKindOf(name) == MapKind::image) hint = "; did you mean '" + name + "'?";
  }
  if (hint.empty()) hint = "; put it there, or name another in the line 'image:'";
  fail(path, "its image " + header.image.string() + ": no such file" + hint);
}

/// The raster of an image, whose rows come from the top. Memory is taken once a row differs from
/// the first: an image of one shade makes no map, and there are large ones.
class ImageRaster
{
 public:
  explicit ImageRaster(const RosMapHeader& header) : header_(header) {}

  void add(const GrayRow& row)
  {
    if (row.y == 0) begin(row);
    if (cells_.empty())
    {
      if (row.shades == first_.shades && row.alphas == first_.alphas) return;
      takeFirstRows(row.y);
    }
    setStates(row, row.y);
  }

  /// Returns the raster without the turn of its origin. Where all rows are equal and make no map,
  /// its cells are those of one row.
  OccupancyRaster finish()
  {
    const RasterFrame frame{
        {header_.origin.x, header_.origin.y}, header_.resolution, first_.width, first_.height};
    if (cells_.empty())
    {
      OccupancyRaster one_row{frame, std::vector<CellState>(first_.width), {}};
      setStates(first_, one_row.cells.data());
      if (unusableGrid(one_row)) return one_row;
      takeFirstRows(first_.height);
    }
    return {frame, std::move(cells_), {}};
  }

 private:
  void begin(const GrayRow& row)
  {
    first_ = row;
    for (int shade = 0; shade <= kWhiteShade; ++shade)
    {
      states_[static_cast<std::size_t>(shade)] =
          stateOfPixel(shade, kWhiteShade, !row.alphas.empty(), header_);
    }
  }

  /// The rows before `end` are as the first.
  void takeFirstRows(std::uint32_t end)
  {
    cells_.resize(std::size_t{first_.width} * first_.height);
    for (std::uint32_t y = 0; y < end; ++y) setStates(first_, y);
  }

  /// The image's last row is the map's lowest.
  void setStates(const GrayRow& row, std::uint32_t y)
  {
    setStates(row, &cells_[std::size_t{first_.height - 1 - y} * first_.width]);
  }

  void setStates(const GrayRow& row, CellState* cells) const
  {
    const bool has_alpha = !row.alphas.empty();
    for (std::size_t x = 0; x < row.width; ++x)
    {
      const bool opaque = !has_alpha || row.alphas[x] == kWhiteShade;
      cells[x] = opaque ? states_[row.shades[x]]
                        : stateOfPixel(row.shades[x], row.alphas[x], has_alpha, header_);
    }
  }

  const RosMapHeader& header_;
  GrayRow first_;
  std::array<CellState, kWhiteShade + 1> states_{};  // of opaque pixels, which almost all are
  std::vector<CellState> cells_;
};

OccupancyRaster rasterOfImage(const std::filesystem::path& image, const RosMapHeader& header)
{
  ImageRaster raster(header);
  readGrayImage(image, [&](const GrayRow& row) { raster.add(row); });
  return raster.finish();
}

/// The same turned; `path` is the file to name where it makes no map.
OccupancyRaster placed(OccupancyRaster raster, const RosMapHeader& header,
                       const std::filesystem::path& path)
{
  requireWallAndFree(raster, path);  // else it may be one row, which cannot be turned
  try
  {
    raster = turned(std::move(raster), header.origin.phi);
  }
  catch (const std::invalid_argument& error)
  {
    fail(path, error.what());
  }
  requireWallAndFree(raster, path);
  return raster;
}

/// The header that a map server would be given for an image of this scale.
RosMapHeader headerOfImage(const ReadingOptions& reading)
{
  RosMapHeader header;
  header.resolution = reading.image_resolution;
  header.free_threshold = 0.196;
  header.occupied_threshold = 0.65;
  return header;
}

/// Throws where the scale of an image is not told; its yaml, if there is one, tells it.
void requireResolution(const std::filesystem::path& path, const ReadingOptions& reading)
{
  if (reading.image_resolution > 0)
  {
    if (const auto reason = unusableCells(reading.image_resolution)) fail(path, *reason);
    return;
  }
  std::string hint;
  for (const char* const extension : {".yaml", ".yml"})
  {
    const auto yaml = std::filesystem::path(path).replace_extension(extension);
    std::error_code error;
    if (hint.empty() && std::filesystem::exists(yaml, error))
      hint = "; did you mean '" + yaml.filename().string() + "'?";
  }
  throw std::runtime_error(path.string() +
                           ": an image alone does not tell how many metres a pixel is; give "
                           "--resolution (a node and an ini: image_resolution), or its .yaml file" +
                           hint);
}
}  // namespace

std::filesystem::path imageOfRosMap(const std::filesystem::path& path)
{
  const RosMapHeader header = headerWithImage(path);
  ofImage(header, path, requireFile);
  return header.image;
}

std::string warningOfRosMap(const std::filesystem::path& path)
{
  const RosMapHeader header = headerWithImage(path);
  const int unknown = unknownShade(header);
  bool has_alpha = false;
  bool has_unknown = false;
  ofImage(header, path,
          [&](const std::filesystem::path& image)
          {
            readGrayImage(image,
                          [&](const GrayRow& row)
                          {
                            has_alpha = !row.alphas.empty();
                            has_unknown =
                                has_unknown || std::find(row.shades.begin(), row.shades.end(),
                                                         unknown) != row.shades.end();
                          });
          });
  if (!has_unknown || !takesUnknownForFree(header, has_alpha)) return {};
  const std::string cause = header.mode == RosMapMode::scale ? "mode" : "free_thresh";
  return "its " + cause + " would make free what the image shows as never seen (shade " +
         std::to_string(unknown) + "); it is taken as unknown";
}

OccupancyRaster readRosMap(const std::filesystem::path& path)
{
  const RosMapHeader header = headerWithImage(path);
  const auto read = [&](const std::filesystem::path& image)
  { return rasterOfImage(image, header); };
  return placed(ofImage(header, path, read), header, path);
}

OccupancyRaster readMapImage(const std::filesystem::path& path, const ReadingOptions& reading)
{
  requireResolution(path, reading);
  const RosMapHeader header = headerOfImage(reading);
  return placed(rasterOfImage(path, header), header, path);
}
}  // namespace sigloc::detail
