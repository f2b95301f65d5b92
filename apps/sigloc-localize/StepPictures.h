// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pictures.h"
#include "sigloc/localize/RunWriter.h"

namespace sigloc
{
/// Draws the steps of a run worth looking at: the key moments (first relocation, first ambiguous
/// and first localized step, the end) and every so many steps as the ini says.
class StepPictures
{
 public:
  /// Throws std::runtime_error when pictures are wanted and off-screen rendering is impossible.
  explicit StepPictures(const LocalizationRun& run);

  /// Takes the run's last step and draws it if it is worth it.
  void take(const LocalizationRun& run, const RunWriter& writer);

 private:
  std::string keyMoment(const StepRecord& step);
  void draw(const LocalizationRun& run, const RunWriter& writer, const std::string& moment);

  std::optional<PictureMaker> pictures_;
  std::set<std::string> moments_seen_;
  std::vector<mrpt::math::TPose2D> path_;
};
}  // namespace sigloc
