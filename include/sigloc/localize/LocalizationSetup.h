// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sigloc/config/option_fields.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/map/map_building.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/tracking/TrackerOptions.h"

namespace sigloc
{
/// Section [sigloc.localize]: how a run is scored and drawn. Truth never reaches the localizer.
struct ReportOptions
{
  double map_from_truth_x = 0;
  double map_from_truth_y = 0;
  double map_from_truth_phi_deg = 0;
  bool use_final_truth = false;
  double final_truth_x = 0;
  double final_truth_y = 0;
  double final_truth_phi_deg = 0;
  bool pictures = true;
  bool beliefs = true;

  template <class V>
  static void visitFields(V&& visit)
  {
    using O = ReportOptions;
    constexpr double kFar = 1e6;
    visit(OptionField{"map_from_truth_x", &O::map_from_truth_x, -kFar, kFar,
                      "[m] frame of the ground truth in the map"});
    visit(OptionField{"map_from_truth_y", &O::map_from_truth_y, -kFar, kFar, "[m]"});
    visit(
        OptionField{"map_from_truth_phi_deg", &O::map_from_truth_phi_deg, -360.0, 360.0, "[deg]"});
    visit(OptionField{"use_final_truth", &O::use_final_truth, false, true,
                      "[-] only the last pose is known: final_truth_*"});
    visit(OptionField{"final_truth_x", &O::final_truth_x, -kFar, kFar,
                      "[m] true pose at the last step, in the map"});
    visit(OptionField{"final_truth_y", &O::final_truth_y, -kFar, kFar, "[m]"});
    visit(OptionField{"final_truth_phi_deg", &O::final_truth_phi_deg, -360.0, 360.0, "[deg]"});
    visit(OptionField{"pictures", &O::pictures, false, true, "[-] write PNG pictures"});
    visit(OptionField{"beliefs", &O::beliefs, false, true, "[-] write belief/, two files a step"});
  }
};

/// All settings of a localization run, from an ini file like that of pf-localization.
struct LocalizationSetup
{
  std::filesystem::path config_file;  ///< the ini; empty: none
  std::filesystem::path map_file;
  std::filesystem::path rawlog_file;
  std::filesystem::path ground_truth_file;  ///< empty: none
  std::filesystem::path output_folder;  ///< empty: nothing is written
  std::uint32_t rawlog_offset = 0;  ///< steps skipped at the start of the log
  std::uint32_t scene_frequency = 0;  ///< a scene and a picture every so many steps; 0: key moments
  bool stats_only = false;  ///< SAVE_STATS_ONLY: no belief files, scenes, samples and pictures
  std::uint32_t repetitions = 1;
  /// The step of the log, counted from 0, at which convergence is tested and the run ends.
  std::optional<std::uint32_t> convergence_test_step;
  double confidence_share = 0.2;  ///< the error quantiles reported: this and one minus it
  mrpt::math::TPose2D initial_odometry;  ///< where dead reckoning starts
  std::vector<std::uint32_t> particle_counts;  ///< with particles, one experiment each; empty: one
  std::optional<PoseRegion> prior;
  bool use_particles = false;  ///< `tracker = particles`: SignatureMonteCarlo2D does the tracking
  MatcherOptions matcher;
  TrackerOptions tracker;
  ParticleOptions particles;
  FeatureExtractorOptions features;
  MapBuildingOptions map;
  ReadingOptions reading;
  ReportOptions report;
  /// About the ini: keys of [LocalizationExperiment] that nothing reads, and keys given repeatedly.
  std::vector<std::string> warnings;

  /// Every file that a run reads. Throws as filesOfMapSource() does.
  std::vector<std::filesystem::path> inputFiles() const;
  /// The pose of the truth's frame in the map [m, rad]; nothing is turned or moved by default.
  mrpt::math::TPose2D mapFromTruth() const;
  /// The true pose after the last step, in the map, where the ini tells it.
  std::optional<mrpt::math::TPose2D> finalTruth() const;
};

/// Reads a pf-localization ini: its section [LocalizationExperiment] and our [sigloc.*] sections.
///
/// Of [LocalizationExperiment] it reads map_file, rawlog_file, rawlog_offset,
/// ground_truth_path_file, logOutput_dir, SAVE_STATS_ONLY, 3DSceneFrequency, experimentRepetitions,
/// experimentTestConvergenceAtStep, STATS_CONF_INTERVAL, initial_odo_* and init_PDF_*. It also
/// reads `tracker`, gaussians or particles; with particles, particles_count too. Other keys of the
/// particle filter and of its window are ignored: one warning names those that are set, others the
/// keys that no program reads.
///
/// A file name is looked up in the ini's folder, then in the current one. logOutput_dir is relative
/// to the current folder. `rawlog` replaces rawlog_file and `map` map_file when given. Throws
/// std::runtime_error naming the ini and the reason: unreadable, no such section, a named file that
/// does not exist, an unknown [sigloc.*] section or key, a bad value.
LocalizationSetup readLocalizationSetup(const std::filesystem::path& ini,
                                        const std::filesystem::path& rawlog = {},
                                        const std::filesystem::path& map = {});

/// Throws std::runtime_error where the names of map and log tell that they are swapped.
void requireMapAndLog(const LocalizationSetup& setup);

/// Returns the text of an ini file, of at most 1 MB. Throws std::runtime_error "path: reason" for
/// any other file; `advice` then ends the reason where there is text or data of another kind.
std::string readIniText(const std::filesystem::path& ini, const std::string& advice = {});

/// Reads only the [sigloc.*] sections of an ini; the same errors.
LocalizationSetup readOptionSections(const std::filesystem::path& ini);

/// Returns all [sigloc.*] sections with their defaults, units and descriptions, as ini text.
std::string defaultOptionSections();

}  // namespace sigloc
