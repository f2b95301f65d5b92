// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/DenseVerifier.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "CellView.h"
#include "likelihood_table.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kQuickCell = 0.1;  // [m], of the raster for the first look
constexpr double kStandingCell = 0.5;  // [m]
constexpr std::uint8_t kStandingCentre = 2;
constexpr std::size_t kQuickBeams = 24;
constexpr std::size_t kQuickSorted = 1024;  // best first looks that are sorted at all
constexpr std::size_t kQuickKept = 48;  // cells of poses that are refined: the cascade's knob
constexpr std::size_t kMiddleBeams = 32;
constexpr std::size_t kMiddleScored = 48;
constexpr int kMiddleSteps = 3;
constexpr std::size_t kFinalKept = 16;
constexpr std::size_t kFinalBeams = 96;
constexpr int kFinalSteps = 3;
constexpr std::size_t kSettled = 4;
constexpr int kSettleSteps = 6;
constexpr double kContender = 0.2;  // of the score, behind the best
constexpr double kDistinctDistance = 0.5;  // [m]
constexpr double kApartDistance = 0.08;  // [m]
constexpr double kDistinctAngle = 17.0 * M_PI / 180.0;  // [rad]
constexpr double kWallMargin = 0.4;  // [m] before its end a beam must be clear of walls
constexpr std::size_t kRayBeams = 64;  // beams tested for passing through walls
constexpr double kFreeMargin = 0.4;  // [m] from any wall that makes an end in free space count
constexpr double kThroughPenalty = 0.5;
constexpr double kFreePenalty = 0.5;

bool distinct(const TPose2D& a, const TPose2D& b, double distance)
{
  return std::hypot(a.x - b.x, a.y - b.y) > distance ||
         std::abs(wrapToPi(a.phi - b.phi)) > kDistinctAngle;
}

/// Best first; ties are broken by the pose, so that the order never depends on the history.
bool better(const RankedPose& a, const RankedPose& b)
{
  if (a.evidence.score != b.evidence.score) return a.evidence.score > b.evidence.score;
  if (a.pose.x != b.pose.x) return a.pose.x < b.pose.x;
  if (a.pose.y != b.pose.y) return a.pose.y < b.pose.y;
  return a.pose.phi < b.pose.phi;
}

/// Keeps the best of each group of poses that are not distinct; at most `count`.
void keepDistinct(std::vector<RankedPose>& poses, std::size_t count,
                  double distance = kDistinctDistance)
{
  std::sort(poses.begin(), poses.end(), better);
  std::vector<RankedPose> kept;
  for (const RankedPose& candidate : poses)
  {
    if (kept.size() == count) break;
    const bool fresh = std::all_of(kept.begin(), kept.end(),
                                   [&](const RankedPose& other)
                                   { return distinct(candidate.pose, other.pose, distance); });
    if (fresh) kept.push_back(candidate);
  }
  poses = std::move(kept);
}

/// A raster over the same area with cells of about `cell` [m], a whole number of the finer ones.
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

std::uint32_t ratioOf(const RasterFrame& coarse, const RasterFrame& fine)
{
  return static_cast<std::uint32_t>(std::lround(coarse.resolution / fine.resolution));
}

std::size_t cellCount(const RasterFrame& frame)
{
  return static_cast<std::size_t>(frame.width) * frame.height;
}

/// Key of the 0.4 m x 8 degree cell of poses that a proposal lies in.
std::uint64_t poseCell(const PoseProposal& p)
{
  const auto bin = [](float value, float size)
  {
    const auto index = static_cast<std::int64_t>(std::floor(value / size));
    return static_cast<std::uint64_t>(index) & 0xFFFFFU;
  };
  const auto heading = static_cast<float>(wrapToPi(static_cast<double>(p.phi)));
  return bin(p.x, 0.4F) << 40U | bin(p.y, 0.4F) << 20U | bin(heading, 0.14F);
}
}  // namespace

DenseVerifier::DenseVerifier(const DenseField& field) : field_(field)
{
  if (field.cells.empty()) throw std::invalid_argument("DenseVerifier: the field has no cells");
  quick_frame_ = coarserFrame(field.frame, kQuickCell);
  standing_frame_ = coarserFrame(field.frame, kStandingCell);
  quick_.assign(cellCount(quick_frame_) + 1, 0);
  standing_.assign(cellCount(standing_frame_), 0);
  const std::uint32_t quick_ratio = ratioOf(quick_frame_, field.frame);
  const std::uint32_t standing_ratio = ratioOf(standing_frame_, field.frame);
  std::array<std::uint8_t, 256> bytes{};
  for (std::size_t d = 0; d < bytes.size(); ++d)
  {
    bytes[d] = static_cast<std::uint8_t>(std::lround(255.0F * coarseTable()[d]));
  }
  for (std::uint32_t y = 0; y < field.frame.height; ++y)
  {
    const DenseCell* row = &field.cells[static_cast<std::size_t>(y) * field.frame.width];
    std::uint8_t* quick_row =
        &quick_[static_cast<std::size_t>(y / quick_ratio) * quick_frame_.width + 1];
    for (std::uint32_t x = 0; x < field.frame.width; ++x)
    {
      std::uint8_t& quick = quick_row[x / quick_ratio];
      quick = std::max(quick, bytes[row[x].distance]);
      if (row[x].state == CellState::free)
      {
        markStanding(x / standing_ratio, y / standing_ratio);
      }
    }
  }
}

/// Free space makes its own cell and those around it places to stand: a map may end a little early.
void DenseVerifier::markStanding(std::uint32_t x, std::uint32_t y)
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

bool DenseVerifier::canStand(float x, float y) const
{
  const double fx =
      (static_cast<double>(x) - standing_frame_.origin.x) / standing_frame_.resolution;
  const double fy =
      (static_cast<double>(y) - standing_frame_.origin.y) / standing_frame_.resolution;
  if (!(fx >= 0 && fy >= 0 && fx < standing_frame_.width && fy < standing_frame_.height))
  {
    return false;
  }
  return standing_[static_cast<std::size_t>(fy) * standing_frame_.width +
                   static_cast<std::size_t>(fx)] != 0;
}

std::vector<RankedPose> DenseVerifier::rank(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t max_ranked,
                                            std::uint64_t& poses_scored) const
{
  if (scan.size() == 0) return {};
  // 1. A first look at every proposal with a few beams.
  const std::vector<Scored> scored = firstLook(scan, proposals);
  poses_scored += scored.size();

  // 2. The best of each cell of poses, refined on some of the beams.
  std::vector<RankedPose> poses = refineBest(scan, proposals, scored);
  // Poses of one place that stopped apart stay rivals until all beams have judged them: which of
  // them wins must not hang on where the proposals happened to lie.
  keepDistinct(poses, kFinalKept, kApartDistance);

  // 3. The best of those, refined on more beams and judged by all of them.
  for (RankedPose& pose : poses)
  {
    pose.pose = refine(scan, pose.pose, kFinalSteps, kFinalBeams);
    pose.evidence = evaluate(scan, pose.pose);
  }
  keepDistinct(poses, max_ranked);

  // 4. What may win or be the runner-up is settled on all beams.
  const double contender = poses.empty() ? 0 : poses.front().evidence.score - kContender;
  for (std::size_t k = 0; k < std::min(kSettled, poses.size()); ++k)
  {
    RankedPose& pose = poses[k];
    if (pose.evidence.score < contender) break;
    const TPose2D settled = refine(scan, pose.pose, kSettleSteps, scan.size());
    const DenseEvidence evidence = evaluate(scan, settled);
    if (evidence.score < pose.evidence.score) continue;
    pose.pose = settled;
    pose.evidence = evidence;
  }
  keepDistinct(poses, max_ranked);
  return poses;
}

std::vector<DenseVerifier::Scored> DenseVerifier::firstLook(
    const DenseScan& scan, const std::vector<PoseProposal>& proposals) const
{
  const std::size_t beams = std::min(kQuickBeams, scan.size());
  const auto scale = static_cast<float>(1.0 / quick_frame_.resolution);
  const auto origin_x = static_cast<float>(quick_frame_.origin.x);
  const auto origin_y = static_cast<float>(quick_frame_.origin.y);
  const std::uint32_t width = quick_frame_.width;
  const std::uint32_t height = quick_frame_.height;
  // Offsets of the beams' ends in cells; runs of proposals with one heading share them.
  std::array<float, kQuickBeams> dx{};
  std::array<float, kQuickBeams> dy{};
  float phi = std::nanf("");
  std::vector<Scored> scored;
  scored.reserve(proposals.size());
  for (std::uint32_t k = 0; k < proposals.size(); ++k)
  {
    const PoseProposal& p = proposals[k];
    if (!canStand(p.x, p.y)) continue;
    if (p.phi != phi)
    {
      phi = p.phi;
      const float c = std::cos(phi) * scale;
      const float s = std::sin(phi) * scale;
      for (std::size_t i = 0; i < beams; ++i)
      {
        dx[i] = c * scan.x[i] - s * scan.y[i];
        dy[i] = s * scan.x[i] + c * scan.y[i];
      }
    }
    const float x0 = (p.x - origin_x) * scale;
    const float y0 = (p.y - origin_y) * scale;
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < beams; ++i)
    {
      // A negative coordinate becomes a huge unsigned one and fails the comparison.
      const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(x0 + dx[i]));
      const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(y0 + dy[i]));
      sum += quick_[ix < width && iy < height ? iy * width + ix + 1 : 0];
    }
    scored.push_back({static_cast<float>(sum), k});
  }
  return scored;
}

std::vector<RankedPose> DenseVerifier::refineBest(const DenseScan& scan,
                                                  const std::vector<PoseProposal>& proposals,
                                                  const std::vector<Scored>& scored) const
{
  std::vector<Scored> best = scored;
  const auto better_look = [](const Scored& a, const Scored& b)
  { return a.score != b.score ? a.score > b.score : a.index < b.index; };
  if (best.size() > kQuickSorted)
  {
    std::nth_element(best.begin(), best.begin() + kQuickSorted, best.end(), better_look);
    best.resize(kQuickSorted);
  }
  std::sort(best.begin(), best.end(), better_look);

  std::vector<RankedPose> poses;
  poses.reserve(kQuickKept);
  std::vector<std::uint64_t> taken;
  for (const Scored& look : best)
  {
    if (poses.size() == kQuickKept) break;
    const PoseProposal& p = proposals[look.index];
    const std::uint64_t cell = poseCell(p);
    if (std::find(taken.begin(), taken.end(), cell) != taken.end()) continue;
    taken.push_back(cell);
    RankedPose pose;
    pose.pose = refine(scan, {p.x, p.y, p.phi}, kMiddleSteps, kMiddleBeams);
    pose.evidence.score = likelihood(scan, pose.pose, kMiddleScored);
    poses.push_back(pose);
  }
  return poses;
}

/// Mean of the fine and the coarse likelihood of the first `beams` returns.
double DenseVerifier::likelihood(const DenseScan& scan, const TPose2D& pose,
                                 std::size_t beams) const
{
  const Placement place(pose);
  const CellView cells(field_);
  const std::size_t count = std::min(beams, scan.size());
  float sum = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const DenseCell& cell =
        cells.at(place.placedX(scan.x[i], scan.y[i]), place.placedY(scan.x[i], scan.y[i]));
    sum += fineTable()[cell.distance] + coarseTable()[cell.distance];
  }
  return 0.5 * static_cast<double>(sum) / static_cast<double>(count);
}

DenseEvidence DenseVerifier::evaluate(const DenseScan& scan, const TPose2D& pose) const
{
  DenseEvidence evidence;
  if (scan.size() == 0) return evidence;
  const Placement place(pose);
  const CellView cells(field_);
  const auto far_from_wall = static_cast<std::uint8_t>(kFreeMargin / DenseField::kDistanceUnit);
  float fine = 0;
  float coarse = 0;
  std::size_t in_free = 0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const DenseCell& cell =
        cells.at(place.placedX(scan.x[i], scan.y[i]), place.placedY(scan.x[i], scan.y[i]));
    fine += fineTable()[cell.distance];
    coarse += coarseTable()[cell.distance];
    if (cell.distance <= far_from_wall) continue;
    if (cell.state == CellState::free) ++in_free;
    if (cell.state == CellState::unknown) ++unknown;
  }
  const auto n = static_cast<double>(scan.size());
  evidence.fine = static_cast<double>(fine) / n;
  evidence.coarse = static_cast<double>(coarse) / n;
  evidence.in_free = static_cast<double>(in_free) / n;
  evidence.unknown = static_cast<double>(unknown) / n;
  evidence.through_wall = throughWallShare(scan, pose);
  evidence.score = 0.5 * (evidence.fine + evidence.coarse) -
                   kThroughPenalty * evidence.through_wall - kFreePenalty * evidence.in_free;
  return evidence;
}

double DenseVerifier::throughWallShare(const DenseScan& scan, const TPose2D& pose) const
{
  const std::size_t count = std::min(kRayBeams, scan.size());
  const Placement place(pose);
  const CellView cells(field_);
  const auto resolution = static_cast<float>(field_.frame.resolution);
  constexpr auto kUnit = static_cast<float>(DenseField::kDistanceUnit);
  const auto far = static_cast<float>(truncationDistance(field_.frame.resolution));
  std::size_t through = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const TPoint2D& origin = scan.origins[scan.origin[i]];
    const auto ox = static_cast<float>(origin.x);
    const auto oy = static_cast<float>(origin.y);
    const float x0 = place.placedX(ox, oy);
    const float y0 = place.placedY(ox, oy);
    float dx = place.placedX(scan.x[i], scan.y[i]) - x0;
    float dy = place.placedY(scan.x[i], scan.y[i]) - y0;
    const float length = std::sqrt(dx * dx + dy * dy);
    const float limit = length - static_cast<float>(kWallMargin);
    if (limit <= 0) continue;
    dx /= length;
    dy /= length;
    float along = 0;
    while (along < limit)
    {
      const DenseCell& cell = cells.at(x0 + along * dx, y0 + along * dy);
      if (cell.state == CellState::solid_wall)
      {
        ++through;
        break;
      }
      const float distance = std::min(far, static_cast<float>(cell.distance) * kUnit);
      const float clear = distance - 1.42F * resolution;
      along += std::max(clear, 0.7F * resolution);
    }
  }
  return static_cast<double>(through) / static_cast<double>(count);
}
}  // namespace sigloc
