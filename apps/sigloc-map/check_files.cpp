// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "check_files.h"

#include <fmt/format.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>

#include "json_text.h"
#include "sigloc/config/plural.h"
#include "sigloc/io/file_output.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr const char* kOwner = "sigloc-map check";
constexpr std::size_t kWorstTwins = 5;  // printed

/// The value below which a share of sorted values lies; the last for none.
double quantile(const std::vector<double>& sorted, double share)
{
  const auto index = static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1));
  return sorted[index];
}

double medianTime(const MapCheck& check)
{
  std::vector<double> times = check.times_ms;
  std::sort(times.begin(), times.end());
  return quantile(times, 0.5);
}

std::string number(double value, int digits)
{
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "";
}

std::string degrees(double angle)
{
  return fmt::format("{:.1f}", mrpt::RAD2DEG(mrpt::math::wrapToPi(angle)) + 0.0);
}

std::string placesCsv(const MapCheck& check)
{
  std::string csv =
      "x_m,y_m,heading_deg,scans,right,localized,fooled,probability_of_right,drive_m,drive_"
      "failed\n";
  for (const CheckedPlace& place : check.places)
  {
    const bool failed = place.drive && !std::isfinite(*place.drive);
    csv += fmt::format("{:.3f},{:.3f},{},{},{},{},{},{:.4f},{},{}\n", place.pose.x, place.pose.y,
                       degrees(place.pose.phi), place.scans, place.right, place.localized,
                       place.fooled, place.probability, place.drive ? number(*place.drive, 2) : "",
                       place.drive ? (failed ? "1" : "0") : "");
  }
  return csv;
}

std::string twinsCsv(const MapCheck& check)
{
  std::string csv = "twins,a_x_m,a_y_m,a_deg,b_x_m,b_y_m,b_deg,scans,mean_probability\n";
  for (std::size_t k = 0; k < check.twins.size(); ++k)
  {
    const Twins& twins = check.twins[k];
    csv += fmt::format("{},{:.3f},{:.3f},{},{:.3f},{:.3f},{},{},{:.4f}\n", k + 1, twins.a.x,
                       twins.a.y, degrees(twins.a.phi), twins.b.x, twins.b.y, degrees(twins.b.phi),
                       twins.scans, twins.meanProbability());
  }
  return csv;
}

nlohmann::ordered_json numberOrNull(const std::vector<double>& sorted, double share)
{
  if (sorted.empty() || !std::isfinite(quantile(sorted, share))) return nullptr;
  return quantile(sorted, share);
}

nlohmann::ordered_json summaryOf(const MapCheck& check, const std::string& map)
{
  const std::vector<double> drives = check.drives();
  nlohmann::ordered_json json;
  json["program"] = kOwner;
  json["map"] = map;
  json["free_area_m2"] = check.free_area;
  json["reachable_area_m2"] = check.area;
  json["places"] = check.places.size();
  json["recall_at_1"] = check.recall();
  json["localized_share"] = check.localizedShare();
  json["fooled_share"] = check.fooledShare();
  json["places_where_one_scan_is_enough"] = check.enoughShare();
  json["drives"] = drives.size();
  json["drive_m_median"] = numberOrNull(drives, 0.5);
  json["drive_m_90_percent"] = numberOrNull(drives, 0.9);
  json["drives_unsure_at_end"] =
      std::count_if(drives.begin(), drives.end(), [](double d) { return !std::isfinite(d); });
  json["twins"] = check.twins.size();
  json["relocation_ms_median"] = medianTime(check);
  json["laser"] = {{"beams", check.laser.beams},
                   {"max_range_m", check.laser.max_range},
                   {"map_sigma_m", check.laser.map_sigma},
                   {"clutter_share", check.laser.clutter_share}};
  return json;
}

std::string driveText(const std::vector<double>& drives)
{
  if (drives.empty()) return "not needed";
  const auto metres = [&](double share)
  {
    const double value = quantile(drives, share);
    return std::isfinite(value) ? fmt::format("{:.1f} m", value)
                                : fmt::format("more than {:.0f} m", MapCheck::kDrive);
  };
  return fmt::format("{} in the median, {} in 90 % ({})", metres(0.5), metres(0.9),
                     counted(drives.size(), "drive"));
}

std::string poseText(const TPose2D& pose)
{
  return fmt::format("({:.1f}, {:.1f}, {} deg)", pose.x, pose.y,
                     std::lround(mrpt::RAD2DEG(pose.phi)));
}

bool isOwnSummary(const std::filesystem::path& folder)
{
  std::ifstream in(folder / CheckFiles::kSummary);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  return json.is_object() && json.contains("program") && json["program"] == kOwner;
}
}  // namespace

void checkCheckFolder(const std::filesystem::path& folder,
                      const std::vector<std::filesystem::path>& inputs)
{
  static const std::set<std::string> kNames = {CheckFiles::kPlaces, CheckFiles::kTwins,
                                               CheckFiles::kSummary, CheckFiles::kPicture};
  OutputFolderRule rule;
  rule.writes = [](const std::string& name) { return kNames.count(name) > 0; };
  rule.is_own = isOwnSummary;
  rule.owner = kOwner;
  checkOutputFolder(folder, rule, inputs);
}

void writeCheckFiles(const MapCheck& check, const std::string& map,
                     const std::filesystem::path& folder)
{
  writeFile(folder / CheckFiles::kPlaces, placesCsv(check));
  writeFile(folder / CheckFiles::kTwins, twinsCsv(check));
  writeFile(folder / CheckFiles::kSummary, jsonText(summaryOf(check, map)));
}

std::string checkTable(const MapCheck& check)
{
  std::string table;
  const auto row = [&](const std::string& name, const std::string& text)
  { table += fmt::format("{:<24}{}\n", name, text); };
  row("free space",
      fmt::format("{:.0f} m2, {:.0f} in the largest part where a robot fits; asked at {}",
                  check.free_area, check.area, counted(check.places.size(), "place")));
  row("taken for granted",
      fmt::format("walls {:.2f} m off, {:.0f} % of the beams end on what is not mapped",
                  check.laser.map_sigma, 100 * check.laser.clutter_share));
  row("first pose right", fmt::format("{:.3f} of the scans", check.recall()));
  row("localized", fmt::format("{:.3f} of the scans", check.localizedShare()));
  row("fooled", fmt::format("{:.4f} of the scans: localized at a wrong pose", check.fooledShare()));
  row("one scan is enough", fmt::format("at {:.0f} % of the places", 100 * check.enoughShare()));
  row("elsewhere, driving", driveText(check.drives()));
  row("relocation", fmt::format("{:.2f} ms in the median", medianTime(check)));
  row("twins",
      check.twins.empty() ? "none" : fmt::format("{} pairs; the worst:", check.twins.size()));
  for (std::size_t k = 0; k < std::min(kWorstTwins, check.twins.size()); ++k)
  {
    const Twins& twins = check.twins[k];
    row("", fmt::format("{}. {} and {}: {}", k + 1, poseText(twins.a), poseText(twins.b),
                        counted(twins.scans, "scan")));
  }
  return table;
}

std::vector<TPose2D> readPoses(const std::filesystem::path& file, const PlanarBox& bounds)
{
  constexpr std::uintmax_t kMostBytes = 1U << 24U;  // some 700 000 poses
  const auto refuse = [&](const char* reason)
  { throw std::runtime_error(file.string() + ": " + reason); };
  if (!std::filesystem::exists(file)) refuse("no such file");
  if (!std::filesystem::is_regular_file(file)) refuse("is no regular file");
  if (std::filesystem::file_size(file) > kMostBytes) refuse("holds more than 16 MB of poses");
  std::ifstream in(file);
  if (!in) refuse("cannot be read");
  std::vector<TPose2D> poses;
  std::size_t row = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++row;
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    fields.imbue(std::locale::classic());
    TPose2D pose;
    std::string more;
    if (!(fields >> pose.x >> pose.y >> pose.phi) || fields >> more)
      throw std::runtime_error(fmt::format("{}: row {} is not `x y deg`", file.string(), row));
    const bool outside = pose.x < bounds.x_min || pose.x > bounds.x_max || pose.y < bounds.y_min ||
                         pose.y > bounds.y_max;
    if (outside)
      throw std::runtime_error(fmt::format("{}: row {} is off the map", file.string(), row));
    pose.phi = mrpt::DEG2RAD(pose.phi);
    poses.push_back(pose);
  }
  if (poses.empty()) throw std::runtime_error(file.string() + ": holds no pose");
  return poses;
}
}  // namespace sigloc
