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
using mrpt::math::TPose2D;

namespace
{
constexpr double kCell = 0.1;  // [m] cell of the likelihoods
constexpr double kLargestCell = 0.2;  // [m] cell where the raster would be larger than the cache
constexpr std::size_t kCachedCells = 2U << 20U;  // cells that the cache holds, one byte each
constexpr double kBorder = 20.0;  // [m] around the map, where returns need no check of the range
constexpr double kStandingCell = 0.5;  // [m] cell that must have free space in it or beside it
/// The lowest bit of a byte: a robot could be there. The likelihood has the other bits. In a sum of
/// bytes this bit is too little to matter.
constexpr std::uint8_t kStanding = 1;
constexpr std::size_t kReturns = CoarseScore::kReturns;
constexpr std::size_t kThinningReturns = 8;  // first returns, by which proposals are thinned
constexpr std::size_t kRoughReturns = 12;  // first returns, by which very many are thinned
constexpr std::size_t kThinningShare = 4;  // one proposal in so many is kept
constexpr std::size_t kLeastThinned = 512;  // lower bound of the proposals kept
constexpr std::size_t kMostThinned = 8000;  // upper bound of the proposals kept, ties not counted
constexpr std::uint32_t kHeadings = 512;  // of the table: an error of 0.35 degrees, 0.1 m at 16 m

std::uint32_t ratioOf(const RasterFrame& coarse, const RasterFrame& fine)
{
  return static_cast<std::uint32_t>(std::lround(coarse.resolution / fine.resolution));
}

std::size_t cellCount(const RasterFrame& frame)
{
  return static_cast<std::size_t>(frame.width) * frame.height;
}

/// Returns the raster of the likelihoods, small enough to stay in the cache.
RasterFrame likelihoodFrame(const RasterFrame& field)
{
  const RasterFrame frame = coarserFrame(field, kCell);
  return cellCount(frame) <= kCachedCells ? frame : coarserFrame(field, kLargestCell);
}

/// Returns the blocks of the field with free space, and those around them: a map may end a little
/// before the free space does.
ByteRaster standingBlocks(const DenseField& field, const RasterFrame& blocks)
{
  const std::uint32_t ratio = ratioOf(blocks, field.frame);
  ByteRaster free(blocks.width, blocks.height, field.isTiled());
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      const DenseCell* row = stored.row(y);
      for (std::uint32_t x = 0; x < stored.width; ++x)
      {
        if (row[x].state != CellState::free) continue;
        free.at((stored.x + x) / ratio, (stored.y + y) / ratio) = kStanding;
      }
    }
  }
  ByteRaster standing(blocks.width, blocks.height, field.isTiled());
  free.forEachSet(
      [&](std::uint32_t x, std::uint32_t y)
      {
        for (std::uint32_t j = y == 0 ? 0 : y - 1; j < std::min(y + 2, blocks.height); ++j)
        {
          for (std::uint32_t i = x == 0 ? 0 : x - 1; i < std::min(x + 2, blocks.width); ++i)
          {
            standing.at(i, j) = kStanding;
          }
        }
      });
  return standing;
}

/// Keeps the best `count` of the first scores, and those equal to the last of them, so that the
/// order of the proposals does not decide which ones stay.
void keepBest(std::vector<CoarseScore>& scores, std::size_t count)
{
  if (scores.size() <= count) return;
  std::array<std::uint32_t, 255 * kRoughReturns + 1> with_score{};
  for (const CoarseScore& entry : scores) ++with_score[entry.score];
  std::size_t kept = 0;
  auto lowest = static_cast<std::uint32_t>(with_score.size());
  while (kept < count && lowest > 0) kept += with_score[--lowest];
  scores.erase(std::remove_if(scores.begin(), scores.end(),
                              [&](const CoarseScore& entry) { return entry.score < lowest; }),
               scores.end());
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

/// The first returns of a scan as offsets in cells, for the headings of a table. A heading is
/// computed when it first occurs. A scan of fewer returns is used repeatedly.
class CoarseField::TurnedReturns
{
 public:
  TurnedReturns(const DenseScan& scan, const CoarseField& field)
      : bytes_(field.likelihoods_.bytes()),
        tiles_(field.likelihoods_.tiles()),
        tile_columns_(field.likelihoods_.tileColumns()),
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
      x_[i] = scan.x[i % scan.spaced] * scale_;
      y_[i] = scan.y[i % scan.spaced] * scale_;
    }
  }

  /// Scores the proposals at which a robot could be, by the first `returns`.
  template <std::size_t returns>
  std::vector<CoarseScore> firstScores(const std::vector<PoseProposal>& proposals)
  {
    const auto near_rim = static_cast<float>(border_);
    const auto right_rim = static_cast<float>(width_ - border_);
    const auto top_rim = static_cast<float>(height_ - border_);
    std::vector<CoarseScore> scores(proposals.size());
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < proposals.size(); ++k)
    {
      const PoseProposal& p = proposals[k];
      const float x = columnOf(p);
      const float y = rowOf(p);
      // No robot is in the border, and from there returns could fall outside.
      if (!(x >= near_rim && y >= near_rim && x < right_rim && y < top_rim)) continue;
      // The entry is kept or overwritten by the next one: a branch here could not be predicted.
      scores[count] = {sumAt<0, returns>(p), k};
      const std::uint8_t here = byteAt(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
      count += here & kStanding;
    }
    scores.resize(count);
    return scores;
  }

  /// Returns the score of a pose by all returns, or 0 off the raster.
  std::uint32_t scoreAt(const PoseProposal& p)
  {
    const float x = columnOf(p);
    const float y = rowOf(p);
    const bool is_on =
        x >= 0 && y >= 0 && x < static_cast<float>(width_) && y < static_cast<float>(height_);
    return is_on ? sumAt<0, kReturns>(p) : 0;
  }

  /// Adds the likelihoods of the other returns to each score.
  void addOtherReturns(std::vector<CoarseScore>& scores, const std::vector<PoseProposal>& proposals)
  {
    for (CoarseScore& entry : scores)
    {
      entry.score += sumAt<kThinningReturns, kReturns>(proposals[entry.index]);
    }
  }

 private:
  struct Turned
  {
    std::int32_t left, right, bottom, top;  // within these cells all returns fall on the raster
    std::array<std::int32_t, kReturns> dx, dy, flat;
  };

  float columnOf(const PoseProposal& p) const { return (p.x - x0_) * scale_; }
  float rowOf(const PoseProposal& p) const { return (p.y - y0_) * scale_; }

  /// Returns the sum of the bytes in which the returns `from` to `to` fall, at a pose on the
  /// raster.
  template <std::size_t from, std::size_t to>
  std::uint32_t sumAt(const PoseProposal& p)
  {
    const Turned& turned = at(p.phi);
    const auto x = static_cast<std::int32_t>(columnOf(p));
    const auto y = static_cast<std::int32_t>(rowOf(p));
    std::uint32_t sum = 0;
    if (x >= turned.left && x < turned.right && y >= turned.bottom && y < turned.top)
    {
      if (tiles_ != nullptr)
      {
        for (std::size_t i = from; i < to; ++i) sum += byteAt(x + turned.dx[i], y + turned.dy[i]);
        return sum;
      }
      const std::uint8_t* cell = bytes_ + static_cast<std::ptrdiff_t>(y) * width_ + x;
      for (std::size_t i = from; i < to; ++i) sum += cell[turned.flat[i]];
      return sum;
    }
    for (std::size_t i = from; i < to; ++i)
    {
      const std::int32_t ix = x + turned.dx[i];
      const std::int32_t iy = y + turned.dy[i];
      if (isWithin(ix, width_) && isWithin(iy, height_)) sum += byteAt(ix, iy);
    }
    return sum;
  }

  static bool isWithin(std::int32_t index, std::int32_t size)
  {
    return static_cast<std::uint32_t>(index) < static_cast<std::uint32_t>(size);
  }

  std::uint8_t byteAt(std::int32_t x, std::int32_t y) const
  {
    if (tiles_ == nullptr) return bytes_[static_cast<std::ptrdiff_t>(y) * width_ + x];
    constexpr std::uint32_t kSide = ByteRaster::kTileSide;
    const auto column = static_cast<std::uint32_t>(x);
    const auto row = static_cast<std::uint32_t>(y);
    const std::size_t tile = tiles_[row / kSide * tile_columns_ + column / kSide];
    return bytes_[tile * ByteRaster::kTileBytes + (row % kSide * kSide + column % kSide)];
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
    // Truncation rounds to the nearest where all values are positive.
    constexpr std::int32_t kShift = 1 << 14;
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
      // Used only where all returns fall on the raster; elsewhere it may wrap around.
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
  const std::uint32_t* tiles_;  // null where the raster is stored whole
  std::uint32_t tile_columns_;
  float x0_, y0_, scale_;
  std::int32_t width_, height_, border_;
  std::array<float, kReturns> x_, y_;  // [cells], robot frame
  std::bitset<kHeadings> ready_;
  std::unique_ptr<Turned[]> table_;  // a row is not initialised before it is ready
};

CoarseField::CoarseField(const DenseField& field) : CoarseField(field, likelihoodFrame(field.frame))
{
}

CoarseField::CoarseField(const DenseField& field, double cell)
    : CoarseField(field, coarserFrame(field.frame, cell))
{
}

CoarseField::CoarseField(const DenseField& field, const RasterFrame& frame) : frame_(frame)
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
  likelihoods_ = ByteRaster(frame_.width, frame_.height,
                            field.isTiled() && cellCount(frame_) > kMostWholeCells);
  std::array<std::uint8_t, 256> bytes{};
  for (std::size_t d = 0; d < bytes.size(); ++d)
  {
    const auto byte = static_cast<std::uint8_t>(std::lround(255.0F * coarseTable()[d]));
    bytes[d] = byte & static_cast<std::uint8_t>(~kStanding);
  }
  for (const StoredCells& stored : storedCells(field))
  {
    for (std::uint32_t y = 0; y < stored.height; ++y)
    {
      const DenseCell* row = stored.row(y);
      for (std::uint32_t x = 0; x < stored.width; ++x)
      {
        const std::uint8_t byte = bytes[row[x].distance];
        if (byte == 0) continue;
        std::uint8_t& best =
            likelihoods_.at((stored.x + x) / ratio + border_, (stored.y + y) / ratio + border_);
        best = std::max(best, byte);
      }
    }
  }
}

void CoarseField::markStanding(const DenseField& field)
{
  const RasterFrame blocks = coarserFrame(field.frame, kStandingCell);
  const std::uint32_t ratio = ratioOf(frame_, field.frame);
  const std::uint32_t block_ratio = ratioOf(blocks, field.frame);
  const std::uint32_t width = frame_.width - 2 * border_;
  const std::uint32_t height = frame_.height - 2 * border_;
  const auto first_in = [&](std::uint32_t block)
  { return (block * block_ratio + ratio - 1) / ratio; };
  standingBlocks(field, blocks)
      .forEachSet(
          [&](std::uint32_t x, std::uint32_t y)
          {
            for (std::uint32_t j = first_in(y); j < std::min(first_in(y + 1), height); ++j)
            {
              for (std::uint32_t i = first_in(x); i < std::min(first_in(x + 1), width); ++i)
              {
                likelihoods_.at(i + border_, j + border_) |= kStanding;
              }
            }
          });
  likelihoods_.finish();
}

std::vector<PoseProposal> CoarseField::best(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t count) const
{
  std::vector<CoarseScore> scores =
      TurnedReturns(scan, *this).firstScores<kRoughReturns>(proposals);
  keepBest(scores, count);
  std::vector<PoseProposal> kept;
  kept.reserve(scores.size());
  for (const CoarseScore& entry : scores) kept.push_back(proposals[entry.index]);
  return kept;
}

std::uint32_t CoarseField::bestScore(const DenseScan& scan, const std::vector<TPose2D>& poses) const
{
  TurnedReturns returns(scan, *this);
  std::uint32_t best = 0;
  for (const TPose2D& pose : poses)
  {
    best = std::max(best, returns.scoreAt({static_cast<float>(pose.x), static_cast<float>(pose.y),
                                           static_cast<float>(pose.phi)}));
  }
  return best;
}

std::vector<CoarseScore> CoarseField::score(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals) const
{
  TurnedReturns returns(scan, *this);
  std::vector<CoarseScore> scores = returns.firstScores<kThinningReturns>(proposals);
  keepBest(scores, std::clamp(scores.size() / kThinningShare, kLeastThinned, kMostThinned));
  returns.addOtherReturns(scores, proposals);
  return scores;
}
}  // namespace sigloc
