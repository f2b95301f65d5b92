// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "QuickField.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "likelihood_table.h"

namespace sigloc
{
namespace
{
constexpr double kCell = 0.1;  // [m]
constexpr double kBorder = 20.0;  // [m] around the map where returns are looked up unchecked
constexpr double kStandingCell = 0.5;  // [m]
constexpr std::uint8_t kStandingCentre = 2;
constexpr std::size_t kReturns = 24;
constexpr std::uint32_t kHeadings = 512;  // 0.35 degrees to the nearest: 0.1 m at 16 m

std::uint32_t ratioOf(const RasterFrame& coarse, const RasterFrame& fine)
{
  return static_cast<std::uint32_t>(std::lround(coarse.resolution / fine.resolution));
}

std::size_t cellCount(const RasterFrame& frame)
{
  return static_cast<std::size_t>(frame.width) * frame.height;
}
}  // namespace

RasterFrame coarserFrame(const RasterFrame& fine, double cell)
{
  const auto ratio = static_cast<std::uint32_t>(std::max(1.0, std::round(cell / fine.resolution)));
  RasterFrame frame;
  frame.origin = fine.origin;
  frame.resolution = fine.resolution * ratio;
  frame.width = (fine.width + ratio - 1) / ratio;
  frame.height = (fine.height + ratio - 1) / ratio;
  return frame;
}

/// The returns of the first look as offsets in cells, for each heading of the table once it is
/// asked for.
class QuickField::TurnedReturns
{
 public:
  struct Turned
  {
    bool ready = false;
    std::int32_t min_x = 0, max_x = 0, min_y = 0, max_y = 0;
    std::array<std::int32_t, kReturns> dx, dy;
    std::array<std::ptrdiff_t, kReturns> flat;
  };

  TurnedReturns(const DenseScan& scan, const RasterFrame& frame)
      : scan_(scan),
        scale_(static_cast<float>(1.0 / frame.resolution)),
        stride_(static_cast<std::ptrdiff_t>(frame.width)),
        table_(kHeadings)
  {
  }

  std::size_t size() const { return std::min(kReturns, scan_.size()); }

  const Turned& at(float phi)
  {
    constexpr auto kPerRadian = static_cast<float>(kHeadings / (2.0 * M_PI));
    const auto bin = static_cast<std::int32_t>(std::lrintf(phi * kPerRadian));
    Turned& turned = table_[static_cast<std::uint32_t>(bin) % kHeadings];
    if (!turned.ready) turn(static_cast<float>(bin) / kPerRadian, turned);
    return turned;
  }

 private:
  void turn(float phi, Turned& turned) const
  {
    const float c = std::cos(phi) * scale_;
    const float s = std::sin(phi) * scale_;
    for (std::size_t i = 0; i < size(); ++i)
    {
      turned.dx[i] = static_cast<std::int32_t>(std::lrintf(c * scan_.x[i] - s * scan_.y[i]));
      turned.dy[i] = static_cast<std::int32_t>(std::lrintf(s * scan_.x[i] + c * scan_.y[i]));
      turned.flat[i] = turned.dy[i] * stride_ + turned.dx[i];
      turned.min_x = std::min(turned.min_x, turned.dx[i]);
      turned.max_x = std::max(turned.max_x, turned.dx[i]);
      turned.min_y = std::min(turned.min_y, turned.dy[i]);
      turned.max_y = std::max(turned.max_y, turned.dy[i]);
    }
    turned.ready = true;
  }

  const DenseScan& scan_;
  float scale_;
  std::ptrdiff_t stride_;
  std::vector<Turned> table_;
};

QuickField::QuickField(const DenseField& field)
    : frame_(coarserFrame(field.frame, kCell)),
      standing_frame_(coarserFrame(field.frame, kStandingCell))
{
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  const std::uint32_t standing_ratio = ratioOf(standing_frame_, field.frame);
  const auto border = std::min(static_cast<std::uint32_t>(std::ceil(kBorder / frame_.resolution)),
                               std::max(frame_.width, frame_.height));
  frame_.origin.x -= border * frame_.resolution;
  frame_.origin.y -= border * frame_.resolution;
  frame_.width += 2 * border;
  frame_.height += 2 * border;
  likelihoods_.assign(cellCount(frame_), 0);
  standing_.assign(cellCount(standing_frame_), 0);
  std::array<std::uint8_t, 256> bytes{};
  for (std::size_t d = 0; d < bytes.size(); ++d)
  {
    bytes[d] = static_cast<std::uint8_t>(std::lround(255.0F * coarseTable()[d]));
  }
  for (std::uint32_t y = 0; y < field.frame.height; ++y)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(y) * field.frame.width];
    std::uint8_t* likelihood =
        &likelihoods_[static_cast<std::size_t>(y / ratio + border) * frame_.width + border];
    for (std::uint32_t x = 0; x < field.frame.width; ++x)
    {
      std::uint8_t& best = likelihood[x / ratio];
      best = std::max(best, bytes[row[x].distance]);
      if (row[x].state == CellState::free) markStanding(x / standing_ratio, y / standing_ratio);
    }
  }
}

/// Free space makes its own cell and those around it places to stand: a map may end a little early.
void QuickField::markStanding(std::uint32_t x, std::uint32_t y)
{
  const std::uint32_t right = std::min(x + 1, standing_frame_.width - 1);
  const std::uint32_t top = std::min(y + 1, standing_frame_.height - 1);
  if (standing_[static_cast<std::size_t>(y) * standing_frame_.width + x] == kStandingCentre) return;
  for (std::uint32_t j = y == 0 ? 0 : y - 1; j <= top; ++j)
  {
    for (std::uint32_t i = x == 0 ? 0 : x - 1; i <= right; ++i)
    {
      std::uint8_t& cell = standing_[static_cast<std::size_t>(j) * standing_frame_.width + i];
      cell = std::max<std::uint8_t>(cell, 1);
    }
  }
  standing_[static_cast<std::size_t>(y) * standing_frame_.width + x] = kStandingCentre;
}

bool QuickField::canStand(float x, float y) const
{
  const auto scale = static_cast<float>(1.0 / standing_frame_.resolution);
  const float fx = (x - static_cast<float>(standing_frame_.origin.x)) * scale;
  const float fy = (y - static_cast<float>(standing_frame_.origin.y)) * scale;
  if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(standing_frame_.width) &&
        fy < static_cast<float>(standing_frame_.height)))
  {
    return false;
  }
  return standing_[static_cast<std::size_t>(fy) * standing_frame_.width +
                   static_cast<std::size_t>(fx)] != 0;
}

std::vector<QuickLook> QuickField::look(const DenseScan& scan,
                                        const std::vector<PoseProposal>& proposals) const
{
  const auto scale = static_cast<float>(1.0 / frame_.resolution);
  const auto origin_x = static_cast<float>(frame_.origin.x);
  const auto origin_y = static_cast<float>(frame_.origin.y);
  const auto width = static_cast<std::int32_t>(frame_.width);
  const auto height = static_cast<std::int32_t>(frame_.height);
  TurnedReturns returns(scan, frame_);
  const std::size_t count = returns.size();
  std::vector<QuickLook> looks;
  looks.reserve(proposals.size());
  for (std::uint32_t k = 0; k < proposals.size(); ++k)
  {
    const PoseProposal& p = proposals[k];
    if (!canStand(p.x, p.y)) continue;
    const TurnedReturns::Turned& turned = returns.at(p.phi);
    // A place to stand lies inside the raster, so the cells are not negative.
    const auto x = static_cast<std::int32_t>((p.x - origin_x) * scale);
    const auto y = static_cast<std::int32_t>((p.y - origin_y) * scale);
    const bool inside = x + turned.min_x >= 0 && x + turned.max_x < width &&
                        y + turned.min_y >= 0 && y + turned.max_y < height;
    std::uint32_t sum = 0;
    if (inside)
    {
      const std::uint8_t* cell =
          &likelihoods_[static_cast<std::size_t>(y) * frame_.width + static_cast<std::size_t>(x)];
      for (std::size_t i = 0; i < count; ++i) sum += cell[turned.flat[i]];
    }
    else
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        // A negative coordinate becomes a huge unsigned one and fails the comparison.
        const auto ix = static_cast<std::uint32_t>(x + turned.dx[i]);
        const auto iy = static_cast<std::uint32_t>(y + turned.dy[i]);
        if (ix >= frame_.width || iy >= frame_.height) continue;
        sum += likelihoods_[static_cast<std::size_t>(iy) * frame_.width + ix];
      }
    }
    looks.push_back({sum, k});
  }
  return looks;
}
}  // namespace sigloc
