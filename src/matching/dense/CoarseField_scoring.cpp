// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "geometry/simd.h"
#include "matching/dense/CoarseField.h"

namespace sigloc
{
using mrpt::math::TPose2D;

namespace
{
constexpr std::size_t kReturns = CoarseScore::kReturns;
constexpr std::size_t kThinningReturns = 8;  // first returns, by which proposals are thinned
constexpr std::size_t kRoughReturns = 12;  // first returns, by which very many are thinned
constexpr std::size_t kThinningShare = 4;  // one proposal in so many is kept
constexpr std::size_t kLeastThinned = 512;  // lower bound of the proposals kept
constexpr std::size_t kMostThinned = 8000;  // upper bound of the proposals kept, ties not counted
constexpr std::uint32_t kHeadings = 512;  // of the table: an error of 0.35 degrees, 0.1 m at 16 m
constexpr auto kHeadingsPerRadian = static_cast<float>(kHeadings / (2.0 * M_PI));

/// How many proposals have each score by the first returns.
using ScoreCounts = std::array<std::uint32_t, 255 * kRoughReturns + 1>;

/// Keeps the best `count` of the first scores, and those equal to the last of them, so that the
/// order of the proposals does not decide which ones stay. Returns the least score that it keeps.
std::uint32_t keepBest(std::vector<CoarseScore>& scores, const ScoreCounts& with_score,
                       std::size_t count)
{
  if (scores.size() <= count) return 0;
  std::size_t enough = 0;
  auto lowest = static_cast<std::uint32_t>(with_score.size());
  while (enough < count && lowest > 0) enough += with_score[--lowest];
  // An entry is kept or overwritten by the next one: a branch here could not be predicted.
  std::size_t kept = 0;
  for (const CoarseScore& entry : scores)
  {
    scores[kept] = entry;
    kept += entry.score >= lowest ? 1 : 0;
  }
  scores.resize(kept);
  return lowest;
}

/// Where proposals are placed on a raster.
struct RasterPlace
{
  float x0, y0;  // [m]
  float scale;  // cells a metre
  float last_column, last_row;  // all beyond a rim is on the rim
};

/// Proposals as cells of a raster and headings of the table.
struct PlacedBlock
{
  static constexpr std::size_t kSize = 128;
  std::array<std::int32_t, kSize> column, row, heading;
};

/// Places `count` proposals. The loop has no branches, so that compilers can process several of
/// them at once.
SIGLOC_WIDE_VECTORS void placeOn(const RasterPlace& raster, const PoseProposal* proposals,
                                 std::size_t count, PlacedBlock& placed)
{
  constexpr float kRounds = 3 << 22;  // added and taken away again, it rounds to the nearest
  for (std::size_t i = 0; i < count; ++i)
  {
    const float x = (proposals[i].x - raster.x0) * raster.scale;
    const float y = (proposals[i].y - raster.y0) * raster.scale;
    placed.column[i] = static_cast<std::int32_t>(std::min(std::max(0.0F, x), raster.last_column));
    placed.row[i] = static_cast<std::int32_t>(std::min(std::max(0.0F, y), raster.last_row));
    const float rounded = proposals[i].phi * kHeadingsPerRadian + kRounds;
    placed.heading[i] = static_cast<std::int32_t>(rounded - kRounds);
  }
}

struct Heading
{
  float c, s;
};

/// The headings of the table.
const std::array<Heading, kHeadings>& headings()
{
  static const std::array<Heading, kHeadings> kTable = []
  {
    std::array<Heading, kHeadings> table{};
    for (std::uint32_t k = 0; k < kHeadings; ++k)
    {
      const float phi = static_cast<float>(k) / kHeadingsPerRadian;
      table[k] = {std::cos(phi), std::sin(phi)};
    }
    return table;
  }();
  return kTable;
}
}  // namespace

/// The first returns of a scan as offsets in cells, for the headings of a table. A heading is
/// computed when it first occurs. A scan of fewer returns is used repeatedly.
class CoarseField::TurnedReturns
{
 public:
  TurnedReturns(const DenseScan& scan, const CoarseField& field)
      : bytes_(field.likelihoods_.bytes()),
        tiles_(field.likelihoods_.tiles()),
        tile_columns_(field.likelihoods_.tileColumns()),
        place_{static_cast<float>(field.frame_.origin.x), static_cast<float>(field.frame_.origin.y),
               static_cast<float>(1.0 / field.frame_.resolution),
               static_cast<float>(field.frame_.width - 1),
               static_cast<float>(field.frame_.height - 1)},
        width_(static_cast<std::int32_t>(field.frame_.width)),
        height_(static_cast<std::int32_t>(field.frame_.height)),
        table_(new Turned[kHeadings])
  {
    for (std::size_t i = 0; i < kReturns; ++i)
    {
      x_[i] = scan.x[i % scan.spaced] * place_.scale;
      y_[i] = scan.y[i % scan.spaced] * place_.scale;
    }
  }

  /// Scores the proposals at which a robot could be, by the first `returns`, and counts the scores.
  /// Leaves out some that are not among the best `count`, so that what very many take fits the
  /// cache. They stay counted, below all that are kept.
  template <std::size_t returns>
  std::vector<CoarseScore> firstScores(const std::vector<PoseProposal>& proposals,
                                       std::size_t count, ScoreCounts& with_score)
  {
    std::size_t room = std::max(4 * count, 2 * PlacedBlock::kSize);
    std::vector<CoarseScore> scores;
    scores.reserve(std::min(proposals.size(), room));
    std::uint32_t least = 0;
    PlacedBlock placed;
    std::array<std::uint32_t, PlacedBlock::kSize> standing;
    std::array<CoarseScore, PlacedBlock::kSize> of_block;
    for (std::size_t first = 0; first < proposals.size(); first += PlacedBlock::kSize)
    {
      const std::size_t size = std::min(PlacedBlock::kSize, proposals.size() - first);
      placeOn(place_, &proposals[first], size, placed);
      const std::size_t standing_count = findStanding(placed, size, standing);
      std::size_t kept = 0;
      for (std::size_t k = 0; k < standing_count; ++k)
      {
        const std::uint32_t i = standing[k];
        const Turned& turned = turnedTo(placed.heading[i]);
        const std::uint32_t score = sumAt<0, returns>(placed.column[i], placed.row[i], turned);
        ++with_score[score];
        // An entry is kept or overwritten by the next one: a branch here could not be predicted.
        of_block[kept] = {score, static_cast<std::uint32_t>(first + i)};
        kept += score >= least ? 1 : 0;
      }
      if (scores.size() + kept > room)
      {
        least = keepBest(scores, with_score, count);
        room = std::max(room, 2 * scores.size());  // where many are equal
      }
      scores.insert(scores.end(), of_block.begin(),
                    of_block.begin() + static_cast<std::ptrdiff_t>(kept));
    }
    return scores;
  }

  /// Returns the score of a pose by all returns, or 0 off the raster.
  std::uint32_t scoreAt(const PoseProposal& p)
  {
    const float x = (p.x - place_.x0) * place_.scale;
    const float y = (p.y - place_.y0) * place_.scale;
    const bool is_on =
        x >= 0 && y >= 0 && x < static_cast<float>(width_) && y < static_cast<float>(height_);
    return is_on ? sumOf<0, kReturns>(p) : 0;
  }

  /// Adds the likelihoods of the other returns to each score.
  void addOtherReturns(std::vector<CoarseScore>& scores, const std::vector<PoseProposal>& proposals)
  {
    for (CoarseScore& entry : scores)
    {
      entry.score += sumOf<kThinningReturns, kReturns>(proposals[entry.index]);
    }
  }

 private:
  struct alignas(64) Turned
  {
    // At this many cells from these on all returns fall on the raster.
    std::int32_t left, bottom;
    std::uint32_t columns, rows;
    std::array<std::int32_t, kReturns> flat, dx, dy;
  };

  /// Finds the proposals of a block at which a robot could be. Returns how many these are.
  std::size_t findStanding(const PlacedBlock& placed, std::size_t size,
                           std::array<std::uint32_t, PlacedBlock::kSize>& standing) const
  {
    // An index is kept or overwritten by the next one: a branch here could not be predicted.
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < size; ++i)
    {
      standing[count] = i;
      count += byteAt(placed.column[i], placed.row[i]) & kStanding;
    }
    return count;
  }

  /// Returns the sum of the bytes in which the returns `from` to `to` fall, at a pose on the
  /// raster.
  template <std::size_t from, std::size_t to>
  std::uint32_t sumOf(const PoseProposal& p)
  {
    const auto x = static_cast<std::int32_t>((p.x - place_.x0) * place_.scale);
    const auto y = static_cast<std::int32_t>((p.y - place_.y0) * place_.scale);
    const auto heading = static_cast<std::int32_t>(std::lrintf(p.phi * kHeadingsPerRadian));
    return sumAt<from, to>(x, y, turnedTo(heading));
  }

  template <std::size_t from, std::size_t to>
  std::uint32_t sumAt(std::int32_t x, std::int32_t y, const Turned& turned) const
  {
    std::uint32_t sum = 0;
    if (static_cast<std::uint32_t>(x - turned.left) < turned.columns &&
        static_cast<std::uint32_t>(y - turned.bottom) < turned.rows)
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

  /// Returns the returns turned by a heading of the table, which may go around several times.
  const Turned& turnedTo(std::int32_t heading)
  {
    const std::uint32_t row = static_cast<std::uint32_t>(heading) % kHeadings;
    if (ready_[row] == 0)
    {
      turn(headings()[row], table_[row]);
      ready_[row] = 1;
    }
    return table_[row];
  }

  SIGLOC_WIDE_VECTORS void turn(const Heading& heading, Turned& turned) const
  {
    // Truncation rounds to the nearest where all values are positive.
    constexpr std::int32_t kShift = 1 << 14;
    const auto [c, s] = heading;
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
    turned.bottom = -least_y;
    turned.columns = static_cast<std::uint32_t>(std::max(0, width_ - (most_x - least_x)));
    turned.rows = static_cast<std::uint32_t>(std::max(0, height_ - (most_y - least_y)));
  }

  const std::uint8_t* bytes_;
  const std::uint32_t* tiles_;  // null where the raster is stored whole
  std::uint32_t tile_columns_;
  RasterPlace place_;
  std::int32_t width_, height_;
  std::array<float, kReturns> x_, y_;  // [cells], robot frame
  std::array<std::uint8_t, kHeadings> ready_{};
  std::unique_ptr<Turned[]> table_;  // a row is not initialised before it is ready
};

std::vector<PoseProposal> CoarseField::best(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t count) const
{
  ScoreCounts with_score{};
  std::vector<CoarseScore> scores =
      TurnedReturns(scan, *this).firstScores<kRoughReturns>(proposals, count, with_score);
  keepBest(scores, with_score, count);
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
  ScoreCounts with_score{};
  std::vector<CoarseScore> scores =
      returns.firstScores<kThinningReturns>(proposals, proposals.size(), with_score);
  keepBest(scores, with_score,
           std::clamp(scores.size() / kThinningShare, kLeastThinned, kMostThinned));
  returns.addOtherReturns(scores, proposals);
  return scores;
}
}  // namespace sigloc
