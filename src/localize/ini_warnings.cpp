// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "localize/ini_warnings.h"

#include <fmt/core.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "sigloc/config/option_fields.h"

namespace sigloc::detail
{
namespace
{
constexpr const char* kSpaces = " \t\r";

/// The order of keys for MRPT, which takes upper and lower case alike.
struct LessInLowerCase
{
  bool operator()(const std::string& a, const std::string& b) const
  {
    return mrpt::system::lowerCase(a) < mrpt::system::lowerCase(b);
  }
};
using KeySet = std::set<std::string, LessInLowerCase>;

// pf-localization 2.5.8 reads all of them but `tracker`.
const KeySet& readKeys()
{
  static const KeySet kKeys = {
      "3DSceneFollowRobot",
      "3DSceneFrequency",
      "DO_RELIABILITY_ESTIMATE",
      "DO_SCAN_LIKELIHOOD_DEBUG",
      "SAVE_STATS_ONLY",
      "SHOW_PROGRESS_3D_REAL_TIME",
      "SHOW_PROGRESS_3D_REAL_TIME_DELAY_MS",
      "STATS_CONF_INTERVAL",
      "experimentRepetitions",
      "experimentTestConvergenceAtStep",
      "ground_truth_path_file",
      "init_PDF_max_pitch_deg",
      "init_PDF_max_roll_deg",
      "init_PDF_max_x",
      "init_PDF_max_y",
      "init_PDF_max_yaw_deg",
      "init_PDF_max_z",
      "init_PDF_min_pitch_deg",
      "init_PDF_min_roll_deg",
      "init_PDF_min_x",
      "init_PDF_min_y",
      "init_PDF_min_yaw_deg",
      "init_PDF_min_z",
      "init_PDF_mode",
      "initial_odo_phi",
      "initial_odo_x",
      "initial_odo_y",
      "logOutput_dir",
      "map_file",
      "particles_count",
      "rawlog_file",
      "rawlog_offset",
      "tracker",
      "use_3D_poses",
  };
  return kKeys;
}

std::string trimmed(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) + 1 - begin);
}

bool isComment(const std::string& line)
{
  return line.front() == ';' || line.front() == '#' || line.rfind("//", 0) == 0;
}
}  // namespace

bool isExperimentKey(const std::string& key)
{
  return readKeys().count(key) > 0;
}

std::vector<std::string> unreadKeys(const mrpt::config::CConfigFileBase& ini,
                                    const std::string& section)
{
  std::vector<std::string> keys;
  ini.getAllKeys(section, keys);
  keys.erase(std::remove_if(keys.begin(), keys.end(), isExperimentKey), keys.end());
  return keys;
}

std::vector<std::string> warningsOfUnreadKeys(const mrpt::config::CConfigFileBase& ini,
                                              const std::string& section)
{
  const std::vector<std::string> known(readKeys().begin(), readKeys().end());
  const std::string start = "[" + section + "]: nothing reads ";
  std::vector<std::string> warnings;
  std::string others;
  for (const std::string& key : unreadKeys(ini, section))
  {
    const std::string hint = didYouMean(key, known);
    if (!hint.empty()) warnings.push_back(fmt::format("{}'{}'{}", start, key, hint));
    if (hint.empty()) others += (others.empty() ? "'" : ", '") + key + "'";
  }
  if (!others.empty()) warnings.push_back(start + others);
  return warnings;
}

std::string warningOfIgnoredKeys(const mrpt::config::CConfigFileBase& ini,
                                 const std::string& section, bool with_particles)
{
  std::string ignored;
  const auto add = [&](const std::string& name)
  { ignored += (ignored.empty() ? "" : ", ") + name; };
  for (const char* const key : {"DO_RELIABILITY_ESTIMATE", "DO_SCAN_LIKELIHOOD_DEBUG",
                                "SHOW_PROGRESS_3D_REAL_TIME", "use_3D_poses"})
  {
    const std::string value = ini.read_string_first_word(section, key, "false");
    if (value != "false" && value != "no" && value != "0") add(key);
  }
  if (!with_particles && ini.keyExists(section, "particles_count")) add("particles_count");
  for (const char* const name : {"PF_options", "KLD_options"})
  {
    if (ini.sectionExists(name)) add(fmt::format("[{}]", name));
  }
  return ignored.empty() ? "" : "of pf-localization's keys, sigloc does without " + ignored;
}

std::vector<std::string> warningsOfLines(const std::string& text,
                                         const std::vector<std::string>& sections)
{
  std::map<std::pair<std::string, std::string>, int> counts;
  std::istringstream lines(text);
  std::vector<std::string> warnings;
  const auto is_read = [&](const std::string& name)
  { return std::count(sections.begin(), sections.end(), name) > 0; };
  std::string section;
  bool goes_on = false;  // a value over several lines
  int number = 0;
  for (std::string line; std::getline(lines, line);)
  {
    ++number;
    line = trimmed(line);
    if (line.empty()) continue;
    if (std::exchange(goes_on, line.back() == '\\') || isComment(line)) continue;
    const std::size_t equals = line.find('=');
    if (line.front() == '[')
    {
      section = line.substr(1, line.find(']') - 1);
    }
    else if (equals != std::string::npos)
    {
      ++counts[{section, trimmed(line.substr(0, equals))}];
    }
    else if (is_read(section))
    {
      warnings.push_back(
          fmt::format("[{}]: line {} is no `key = value`, and is not read", section, number));
    }
  }
  for (const auto& [key, count] : counts)
  {
    if (count == 1 || !is_read(key.first)) continue;
    warnings.push_back(
        fmt::format("[{}]: '{}' is there {} times, the last counts", key.first, key.second, count));
  }
  return warnings;
}
}  // namespace sigloc::detail
