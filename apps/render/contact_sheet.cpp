// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "contact_sheet.h"

#include <algorithm>

namespace sigloc
{
namespace
{
constexpr unsigned kWidth = 900;  // [pixels] of a picture on the sheet
constexpr unsigned kGap = 10;
constexpr std::size_t kColumns = 2;
}  // namespace

void ContactSheet::add(const mrpt::img::CImage& picture)
{
  const auto height = static_cast<unsigned>(kWidth * picture.getHeight() / picture.getWidth());
  mrpt::img::CImage small;
  picture.scaleImage(small, kWidth, height, mrpt::img::IMG_INTERP_AREA);
  if (small_.size() == kMost) small_.pop_back();
  small_.push_back(std::move(small));
}

mrpt::img::CImage ContactSheet::sheet() const
{
  const std::size_t columns = std::min(kColumns, small_.size());
  const std::size_t rows = (small_.size() + columns - 1) / columns;
  const auto height = static_cast<unsigned>(small_.front().getHeight());
  const auto side = [](std::size_t count, unsigned each)
  { return static_cast<unsigned>(count) * (each + kGap) + kGap; };
  mrpt::img::CImage sheet(side(columns, kWidth), side(rows, height), mrpt::img::CH_RGB);
  sheet.filledRectangle(0, 0, static_cast<int>(sheet.getWidth()) - 1,
                        static_cast<int>(sheet.getHeight()) - 1, mrpt::img::TColor(70, 70, 70));
  for (std::size_t k = 0; k < small_.size(); ++k)
  {
    sheet.drawImage(static_cast<int>(side(k % columns, kWidth)),
                    static_cast<int>(side(k / columns, height)), small_[k]);
  }
  return sheet;
}
}  // namespace sigloc
