// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "matching/dense/CoarseField.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <memory>

#include "matching/dense/likelihood_table.h"
#include "matching/dense/simd.h"

namespace sigloc
{
namespace
{
constexpr double kCell = 0.1;  // [m]
constexpr double kLargestCell = 0.2;  // [m], of maps whose raster would leave the cache
constexpr std::size_t kCachedCells = 2U << 20U;
constexpr double kBorder = 20.0;  // [m] around the map where returns are looked up unchecked
constexpr double kStandingCell = 0.5;  // [m]
/// The lowest bit of a byte, of which the likelihood has the others: a robot could stand there.
/// It is too little to matter in a sum of bytes.
constexpr std::uint8_t kStanding = 1;
constexpr std::size_t kReturns = 24;
constexpr std::size_t kGlanceReturns = 8;  // of those, by which proposals are thinned first
constexpr std::size_t kGlanceShare = 4;  // one in so many is kept,
constexpr std::size_t kLeastGlanceKept = 512;  // but no fewer,
constexpr std::size_t kMostGlanceKept = 2048;  // and no more
constexpr std::uint32_t kHeadings = 512;  // 0.35 degrees to the nearest: 0.1 m at 16 m

std::uint32_t ratioOf(const RasterFrame& coarse, const RasterFrame& fine)
{
  return static_cast<std::uint32_t>(std::lround(coarse.resolution / fine.resolution));
}

std::size_t cellCount(const RasterFrame& frame)
{
  return static_cast<std::size_t>(frame.width) * frame.height;
}

/// The raster of the first look: as fine as it pays, and small enough to stay in the cache.
RasterFrame likelihoodFrame(const RasterFrame& field)
{
  const RasterFrame frame = coarserFrame(field, kCell);
  return cellCount(frame) <= kCachedCells ? frame : coarserFrame(field, kLargestCell);
}

/// For each block of the field kStanding if it holds free space, else 0.
std::vector<std::uint8_t> freeBlocks(const DenseField& field, const RasterFrame& blocks)
{
  const std::uint32_t ratio = ratioOf(blocks, field.frame);
  std::vector<std::uint8_t> out(cellCount(blocks), 0);
  for (std::uint32_t y = 0; y < field.frame.height; ++y)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(y) * field.frame.width];
    std::uint8_t* to = &out[static_cast<std::size_t>(y / ratio) * blocks.width];
    for (std::uint32_t x = 0; x < field.frame.width; ++x)
    {
      if (row[x].state == CellState::free) to[x / ratio] = kStanding;
    }
  }
  return out;
}

/// Where free space is no farther than in the next block there is a place to stand: a map may end a
/// little early.
std::vector<std::uint8_t> withNeighbours(const RasterFrame& blocks,
                                         const std::vector<std::uint8_t>& free)
{
  std::vector<std::uint8_t> out(free.size(), 0);
  for (std::uint32_t y = 0; y < blocks.height; ++y)
  {
    for (std::uint32_t x = 0; x < blocks.width; ++x)
    {
      if (free[static_cast<std::size_t>(y) * blocks.width + x] == 0) continue;
      const std::uint32_t left = x == 0 ? 0 : x - 1;
      const std::uint32_t end = std::min(x + 2, blocks.width);
      for (std::uint32_t j = y == 0 ? 0 : y - 1; j < std::min(y + 2, blocks.height); ++j)
      {
        std::fill_n(&out[static_cast<std::size_t>(j) * blocks.width + left], end - left, kStanding);
      }
    }
  }
  return out;
}

/// Keeps the best `count` of looks that were a glance only, and those that tie with the last of
/// them: which ones stay must not hang on their order.
void keepBest(std::vector<CoarseScore>& looks, std::size_t count)
{
  if (looks.size() <= count) return;
  std::array<std::uint32_t, 255 * kGlanceReturns + 1> with_score{};
  for (const CoarseScore& look : looks) ++with_score[look.score];
  std::size_t kept = 0;
  auto lowest = static_cast<std::uint32_t>(with_score.size());
  while (kept < count && lowest > 0) kept += with_score[--lowest];
  looks.erase(std::remove_if(looks.begin(), looks.end(),
                             [&](const CoarseScore& look) { return look.score < lowest; }),
              looks.end());
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

/// The first returns of a scan as offsets in cells, for each heading of a table once it is asked
/// for. A scan of fewer returns is gone through again.
class CoarseField::TurnedReturns
{
 public:
  TurnedReturns(const DenseScan& scan, const CoarseField& field)
      : bytes_(field.likelihoods_.data()),
        x0_(static_cast<float>(field.frame_.origin.x)),
        y0_(static_cast<float>(field.frame_.origin.y)),
        scale_(static_cast<float>(1.0 / field.frame_.resolution)),
        width_(static_cast<std::int32_t>(field.frame_.width)),
        height_(static_cast<std::int32_t>(field.frame_.height)),
        border_(static_cast<std::int32_t>(field.border_)),
        table_(new Turned[kHeadings])
  {
    for (std::size_t i = 0; i < kReturns; ++i)
    {
      x_[i] = scan.x[i % scan.size()] * scale_;
      y_[i] = scan.y[i % scan.size()] * scale_;
    }
  }

  /// Looks at the proposals that a robot could stand at by the first kGlanceReturns.
  std::vector<CoarseScore> glance(const std::vector<PoseProposal>& proposals)
  {
    const auto near_rim = static_cast<float>(border_);
    const auto right_rim = static_cast<float>(width_ - border_);
    const auto top_rim = static_cast<float>(height_ - border_);
    std::vector<CoarseScore> looks(proposals.size());
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < proposals.size(); ++k)
    {
      const PoseProposal& p = proposals[k];
      const float x = columnOf(p);
      const float y = rowOf(p);
      // Nobody stands in the border, and from there it would not hold all returns.
      if (!(x >= near_rim && y >= near_rim && x < right_rim && y < top_rim)) continue;
      // Kept or written over by the next: which of them stand follows no pattern to be guessed.
      looks[count] = {sumAt<0, kGlanceReturns>(p), k};
      const std::uint8_t here = *byteAt(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
      count += here & kStanding;
    }
    looks.resize(count);
    return looks;
  }

  /// Adds what the other returns say at each look's pose to its score.
  void lookFurther(std::vector<CoarseScore>& looks, const std::vector<PoseProposal>& proposals)
  {
    for (CoarseScore& look : looks)
    {
      look.score += sumAt<kGlanceReturns, kReturns>(proposals[look.index]);
    }
  }

 private:
  struct Turned
  {
    std::int32_t left, right, bottom, top;  // from here all returns fall on the raster
    std::array<std::int32_t, kReturns> dx, dy, flat;
  };

  float columnOf(const PoseProposal& p) const { return (p.x - x0_) * scale_; }
  float rowOf(const PoseProposal& p) const { return (p.y - y0_) * scale_; }

  /// The sum of the bytes where the returns `from` to `to` fall at a pose inside of the raster.
  template <std::size_t from, std::size_t to>
  std::uint32_t sumAt(const PoseProposal& p)
  {
    const Turned& turned = at(p.phi);
    const auto x = static_cast<std::int32_t>(columnOf(p));
    const auto y = static_cast<std::int32_t>(rowOf(p));
    std::uint32_t sum = 0;
    if (x >= turned.left && x < turned.right && y >= turned.bottom && y < turned.top)
    {
      const std::uint8_t* cell = byteAt(x, y);
      for (std::size_t i = from; i < to; ++i) sum += cell[turned.flat[i]];
      return sum;
    }
    for (std::size_t i = from; i < to; ++i)
    {
      const std::int32_t ix = x + turned.dx[i];
      const std::int32_t iy = y + turned.dy[i];
      if (isWithin(ix, width_) && isWithin(iy, height_)) sum += *byteAt(ix, iy);
    }
    return sum;
  }

  static bool isWithin(std::int32_t index, std::int32_t size)
  {
    return static_cast<std::uint32_t>(index) < static_cast<std::uint32_t>(size);
  }

  const std::uint8_t* byteAt(std::int32_t x, std::int32_t y) const
  {
    return bytes_ + static_cast<std::ptrdiff_t>(y) * width_ + x;
  }

  const Turned& at(float phi)
  {
    constexpr auto kPerRadian = static_cast<float>(kHeadings / (2.0 * M_PI));
    const auto bin = static_cast<std::int32_t>(std::lrintf(phi * kPerRadian));
    const std::uint32_t row = static_cast<std::uint32_t>(bin) % kHeadings;
    if (!ready_[row])
    {
      turn(static_cast<float>(bin) / kPerRadian, table_[row]);
      ready_[row] = true;
    }
    return table_[row];
  }

  SIGLOC_WIDE_VECTORS void turn(float phi, Turned& turned) const
  {
    constexpr std::int32_t kShift =
        1 << 14;  // truncation rounds to the nearest where all is positive
    const float c = std::cos(phi);
    const float s = std::sin(phi);
    std::int32_t least_x = 0;
    std::int32_t most_x = 0;
    std::int32_t least_y = 0;
    std::int32_t most_y = 0;
    for (std::size_t i = 0; i < kReturns; ++i)
    {
      const auto dx = static_cast<std::int32_t>(c * x_[i] - s * y_[i] + (kShift + 0.5F)) - kShift;
      const auto dy = static_cast<std::int32_t>(s * x_[i] + c * y_[i] + (kShift + 0.5F)) - kShift;
      turned.dx[i] = dx;
      turned.dy[i] = dy;
      // Only of use where all returns fall on the raster; elsewhere it may wrap around.
      turned.flat[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(dy) *
                                                     static_cast<std::uint32_t>(width_) +
                                                 static_cast<std::uint32_t>(dx));
      least_x = std::min(least_x, dx);
      most_x = std::max(most_x, dx);
      least_y = std::min(least_y, dy);
      most_y = std::max(most_y, dy);
    }
    turned.left = -least_x;
    turned.right = width_ - most_x;
    turned.bottom = -least_y;
    turned.top = height_ - most_y;
  }

  const std::uint8_t* bytes_;
  float x0_, y0_, scale_;
  std::int32_t width_, height_, border_;
  std::array<float, kReturns> x_, y_;  // [cells], robot frame
  std::bitset<kHeadings> ready_;
  std::unique_ptr<Turned[]> table_;  // its rows are left as they are until they are asked for
};

CoarseField::CoarseField(const DenseField& field) : frame_(likelihoodFrame(field.frame))
{
  fillLikelihoods(field);
  markStanding(field);
}

void CoarseField::fillLikelihoods(const DenseField& field)
{
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  border_ = std::min(static_cast<std::uint32_t>(std::ceil(kBorder / frame_.resolution)),
                     std::max(frame_.width, frame_.height));
  frame_.origin.x -= border_ * frame_.resolution;
  frame_.origin.y -= border_ * frame_.resolution;
  frame_.width += 2 * border_;
  frame_.height += 2 * border_;
  likelihoods_.assign(cellCount(frame_), 0);
  std::array<std::uint8_t, 256> bytes{};
  for (std::size_t d = 0; d < bytes.size(); ++d)
  {
    const auto byte = static_cast<std::uint8_t>(std::lround(255.0F * coarseTable()[d]));
    bytes[d] = byte & static_cast<std::uint8_t>(~kStanding);
  }
  for (std::uint32_t y = 0; y < field.frame.height; ++y)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(y) * field.frame.width];
    std::uint8_t* likelihood =
        &likelihoods_[static_cast<std::size_t>(y / ratio + border_) * frame_.width + border_];
    for (std::uint32_t x = 0; x < field.frame.width; ++x)
    {
      std::uint8_t& best = likelihood[x / ratio];
      best = std::max(best, bytes[row[x].distance]);
    }
  }
}

void CoarseField::markStanding(const DenseField& field)
{
  const RasterFrame blocks = coarserFrame(field.frame, kStandingCell);
  const std::vector<std::uint8_t> standing = withNeighbours(blocks, freeBlocks(field, blocks));
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  const std::uint32_t block_ratio = ratioOf(blocks, field.frame);
  for (std::uint32_t y = border_; y < frame_.height - border_; ++y)
  {
    std::uint8_t* row = &likelihoods_[static_cast<std::size_t>(y) * frame_.width];
    const std::uint8_t* block_row =
        &standing[static_cast<std::size_t>((y - border_) * ratio / block_ratio) * blocks.width];
    for (std::uint32_t x = border_; x < frame_.width - border_; ++x)
    {
      row[x] |= block_row[(x - border_) * ratio / block_ratio];
    }
  }
}

std::vector<CoarseScore> CoarseField::score(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals) const
{
  TurnedReturns returns(scan, *this);
  std::vector<CoarseScore> looks = returns.glance(proposals);
  keepBest(looks, std::clamp(looks.size() / kGlanceShare, kLeastGlanceKept, kMostGlanceKept));
  returns.lookFurther(looks, proposals);
  return looks;
}
}  // namespace sigloc
