// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "command_line.h"
#include "picture_pixels.h"
#include "runs.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
namespace
{
using namespace sigloc::test;

/// How many pixels of the legend of the lab's last step have a colour.
int legendPixels(const TemporaryFolder& folder, const std::string& step,
                 const mrpt::img::TColor& color)
{
  // The map is wide, so that the overview with its legend is above the close-up.
  constexpr unsigned kFirstRow = 560;
  constexpr unsigned kEndRow = 636;
  mrpt::img::CImage picture;
  EXPECT_TRUE(picture.loadFromFile((folder / ("out/pictures/" + step + ".png")).string()));
  return pixelsLike(picture, color, kFirstRow, kEndRow);
}

CommandResult localizeInLab(const TemporaryFolder& folder, const std::string& keys)
{
  writeConfig(folder, kLabMap.string(), kLabLog.string(), "[sigloc.localize]\n" + keys);
  return localize(folder);
}

TEST(PictureLegend, hasTheColorsBetweenWhichHypothesesAre)
{
  const TemporaryFolder folder;
  ASSERT_EQ(localizeInLab(folder, "").exit_code, 0);
  for (const auto& color : {Palette::kLikely, Palette::kUnlikely})
  {
    EXPECT_GT(legendPixels(folder, "step_00037_end", color), 20);
  }
}

TEST(PictureLegend, hasTheTruthWhereItIsKnown)
{
  const TemporaryFolder folder;
  ASSERT_EQ(localizeInLab(folder,
                          "use_final_truth = true\nfinal_truth_x = 15.90\n"
                          "final_truth_y = -10.01\nfinal_truth_phi_deg = 4.9\n")
                .exit_code,
            0);
  EXPECT_EQ(legendPixels(folder, "step_00002_localized", Palette::kTruth), 0);
  EXPECT_GT(legendPixels(folder, "step_00037_end", Palette::kTruth), 20);
}
}  // namespace
}  // namespace sigloc
