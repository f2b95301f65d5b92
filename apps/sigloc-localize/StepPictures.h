// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "contact_sheet.h"
#include "pictures.h"
#include "sigloc/localize/RunWriter.h"

namespace sigloc
{
/// Draws the key steps of a run: the first relocation, the first ambiguous and the first localized
/// step, those where that is lost and found again, and the last one. All of these are on a contact
/// sheet, too. Draws every n-th step as well where the ini says so.
class StepPictures
{
 public:
  /// Throws std::runtime_error when pictures are wanted and off-screen rendering is impossible.
  explicit StepPictures(const LocalizationRun& run);

  /// Takes the run's latest step and draws it if it is one of these.
  void take(const LocalizationRun& run, const RunWriter& writer);

 private:
  std::string keyMoment(const StepRecord& step);
  std::string changeOfVerdict(const StepRecord& step);
  void draw(const LocalizationRun& run, const RunWriter& writer, const std::string& moment);

  std::optional<PictureMaker> pictures_;
  ContactSheet sheet_;
  std::set<std::string> moments_seen_;
  bool was_localized_ = false;
  std::size_t changes_ = 0;  // drawn
  std::vector<mrpt::math::TPose2D> path_;
};
}  // namespace sigloc
