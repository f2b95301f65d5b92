// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "io/solid/content_reader.h"
#include "io/solid/SolidView.h"

namespace sigloc::detail
{
namespace
{
using Velodyne = mrpt::obs::CObservationVelodyneScan;

constexpr std::uint16_t kWholeTurn = 36000;  // [0.01 deg], of a packet

mrpt::system::TTimeStamp timeIn(ContentReader& in)
{
  return mrpt::Clock::time_point(mrpt::Clock::duration(in.value<std::int64_t>()));
}

/// True for a packet that MRPT converts without a word.
bool isSound(const Velodyne::TVelodyneRawPacket& packet)
{
  return std::all_of(std::begin(packet.blocks), std::end(packet.blocks),
                     [](const auto& block)
                     {
                       const auto header = block.header();
                       return (header == Velodyne::UPPER_BANK || header == Velodyne::LOWER_BANK) &&
                              block.rotation() < kWholeTurn;
                     });
}

void takePackets(ContentReader& in, Velodyne& scan)
{
  constexpr std::size_t kBytes = sizeof(Velodyne::TVelodyneRawPacket);
  const std::size_t count = in.value<std::uint32_t>();
  const std::string_view packets = in.items(count, kBytes);
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto packet = itemOf<Velodyne::TVelodyneRawPacket>(packets, i);
    if (isSound(packet)) scan.scan_packets.push_back(packet);
  }
}

void takeCalibration(ContentReader& in, Velodyne& scan)
{
  using Laser = mrpt::obs::VelodyneCalibration::PerLaserCalib;
  constexpr std::size_t kMostLasers = 64;
  const std::size_t count = in.value<std::uint32_t>();
  if (count > kMostLasers) throw Unusable("damaged");
  const std::string_view lasers = in.items(count, sizeof(Laser));
  scan.calibration.laser_corrections.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    scan.calibration.laser_corrections.push_back(itemOf<Laser>(lasers, i));
}

/// The angles [deg] of a laser's rows above its plane; one of 0 where there is one row.
std::vector<double> rowAngles(std::string_view model, std::size_t rows)
{
  if (rows == 1) return {0};
  const std::string name = model == "VLP-16" ? "VLP16" : model == "HDL-32E" ? "HDL32" : "";
  const auto& lasers =
      mrpt::obs::VelodyneCalibration::LoadDefaultCalibration(name).laser_corrections;
  if (name.empty() || lasers.size() != rows)
    throw Unusable("the angles of its " + std::to_string(rows) + " rows are not known");
  std::vector<double> angles;
  angles.reserve(rows);
  for (const auto& laser : lasers) angles.push_back(laser.verticalCorrection);
  return angles;
}

/// A range image: rows of ranges in units.
struct RangeRows
{
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::string_view units;

  std::uint16_t at(std::size_t row, std::size_t column) const
  {
    return itemOf<std::uint16_t>(units, row * columns + column);
  }
  /// The columns up to the last with a range. MRPT's conversion of a Velodyne makes one for each
  /// range and fills one for each firing.
  std::size_t used() const
  {
    for (std::size_t column = columns; column-- > 0;)
    {
      for (std::size_t row = 0; row < rows; ++row)
      {
        if (at(row, column) != 0) return column + 1;
      }
    }
    return 0;
  }
};

/// Reads a range image of the size that its observation tells. MRPT 2.14 has a byte before it,
/// under the version that 2.5 has without: 0 for an image that follows, else the name of a file
/// does.
RangeRows takeRows(ContentReader& in, std::uint16_t rows, std::uint16_t columns)
{
  const auto size_in = [](ContentReader& reader)
  {
    RangeRows image;
    image.columns = reader.value<std::uint16_t>();
    image.rows = reader.value<std::uint16_t>();
    return image;
  };
  ContentReader ahead = in;
  RangeRows image = size_in(ahead);
  if (image.rows != rows || image.columns != columns)
  {
    if (in.flag()) throw Unusable("its ranges are in another file");
    image = size_in(in);
  }
  else
  {
    in = ahead;
  }
  image.units = in.items(image.rows * image.columns, sizeof(std::uint16_t));
  return image;
}
}  // namespace

SolidView readVelodyne(std::string_view content, int version)
{
  constexpr int kNewest = 2;
  if (version < 0 || version > kNewest) throw Unusable("of version " + std::to_string(version));
  ContentReader in(content);
  SolidView view;
  view.time = timeIn(in);
  view.label = in.text();
  Velodyne scan;
  scan.minRange = in.value<double>();
  scan.maxRange = in.value<double>();
  view.max_range = scan.maxRange;
  view.robot_from_sensor = in.pose();
  takePackets(in, scan);
  takeCalibration(in, scan);
  const auto take = [&in]
  {
    const std::size_t count = in.value<std::uint32_t>();
    return in.items(count, sizeof(float));
  };
  const std::string_view x = take();
  const std::string_view y = take();
  const std::string_view z = take();
  const std::size_t stored = std::min({x.size(), y.size(), z.size()}) / sizeof(float);
  for (std::size_t i = 0; i < stored; ++i)
    view.points.emplace_back(itemOf<float>(x, i), itemOf<float>(y, i), itemOf<float>(z, i));
  if (!view.points.empty() || scan.scan_packets.empty()) return view;
  scan.generatePointCloud();
  const auto& cloud = scan.point_cloud;
  for (std::size_t i = 0; i < cloud.x.size(); ++i)
    view.points.emplace_back(cloud.x[i], cloud.y[i], cloud.z[i]);
  return view;
}

SolidView readRotatingScan(std::string_view content, int version)
{
  if (version != 0) throw Unusable("of version " + std::to_string(version));
  ContentReader in(content);
  SolidView view;
  view.time = timeIn(in);
  view.label = in.text();
  const auto rows = in.value<std::uint16_t>();
  const auto columns_told = in.value<std::uint16_t>();
  const auto unit = in.value<double>();
  const auto start = in.value<double>();
  const auto span = in.value<double>();
  in.value<double>();
  const std::string_view model = in.text();
  const auto min_range = in.value<double>();
  view.max_range = in.value<double>();
  view.robot_from_sensor = in.pose();
  in.value<std::int64_t>();
  in.flag();
  const RangeRows image = takeRows(in, rows, columns_told);
  if (!(std::abs(start) <= 4 * M_PI && std::abs(span) <= 4 * M_PI && unit > 0))
    throw Unusable("damaged");
  view.planar = image.rows == 1;
  const std::vector<double> angles = rowAngles(model, image.rows);
  const std::size_t columns = view.planar ? image.columns : image.used();
  if (columns < 2) throw Unusable("no range in it");
  // A Velodyne counts clockwise.
  const double turn = view.planar ? 1 : -1;
  for (std::size_t row = 0; row < image.rows; ++row)
  {
    const double up = angles[row] * M_PI / 180;
    for (std::size_t column = 0; column < columns; ++column)
    {
      const double range = unit * image.at(row, column);
      if (!(range > 0 && (view.planar || range >= min_range) && range < view.max_range)) continue;
      const double share = static_cast<double>(column) / static_cast<double>(columns - 1);
      const double azimuth = turn * (start + span * share);
      view.points.emplace_back(static_cast<float>(range * std::cos(up) * std::cos(azimuth)),
                               static_cast<float>(range * std::cos(up) * std::sin(azimuth)),
                               static_cast<float>(range * std::sin(up)));
    }
  }
  return view;
}

SolidView readPointCloud(std::string_view content, int version)
{
  if (version != 0) throw Unusable("of version " + std::to_string(version));
  ContentReader in(content);
  SolidView view;
  view.label = in.text();
  view.time = timeIn(in);
  view.robot_from_sensor = in.pose();
  if (in.value<std::uint8_t>() != 0) throw Unusable("its points are in another file");
  std::string name;
  in.anyObject(name);
  // All of MRPT's maps of points begin alike.
  if (name.find("PointsMap") == std::string::npos) throw Unusable("holds a " + name);
  const std::size_t count = in.value<std::uint32_t>();
  const std::string_view x = in.items(count, sizeof(float));
  const std::string_view y = in.items(count, sizeof(float));
  const std::string_view z = in.items(count, sizeof(float));
  for (std::size_t i = 0; i < count; ++i)
    view.points.emplace_back(itemOf<float>(x, i), itemOf<float>(y, i), itemOf<float>(z, i));
  return view;
}
}  // namespace sigloc::detail
