// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/DenseVerifier.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <unordered_set>

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
constexpr std::size_t kQuickBeams = 24;
constexpr std::size_t kQuickKept = 64;  // cells of poses that are refined: the cascade's knob
constexpr std::size_t kMiddleBeams = 48;
constexpr int kMiddleSteps = 4;
constexpr std::size_t kFinalKept = 20;
constexpr int kFinalSteps = 4;
constexpr double kDistinctDistance = 0.5;  // [m]
constexpr double kDistinctAngle = 17.0 * M_PI / 180.0;  // [rad]
constexpr double kWallMargin = 0.4;  // [m] before its end a beam must be clear of walls
constexpr std::size_t kRayBeams = 64;  // beams tested for passing through walls
constexpr double kFreeMargin = 0.4;  // [m] from any wall that makes an end in free space count
constexpr double kThroughPenalty = 0.5;
constexpr double kFreePenalty = 0.5;

bool distinct(const TPose2D& a, const TPose2D& b)
{
  return std::hypot(a.x - b.x, a.y - b.y) > kDistinctDistance ||
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
void keepDistinct(std::vector<RankedPose>& poses, std::size_t count)
{
  std::sort(poses.begin(), poses.end(), better);
  std::vector<RankedPose> kept;
  for (const RankedPose& candidate : poses)
  {
    if (kept.size() == count) break;
    const bool fresh =
        std::all_of(kept.begin(), kept.end(),
                    [&](const RankedPose& other) { return distinct(candidate.pose, other.pose); });
    if (fresh) kept.push_back(candidate);
  }
  poses = std::move(kept);
}
}  // namespace

DenseVerifier::DenseVerifier(const DenseField& field) : field_(field)
{
  if (field.cells.empty()) throw std::invalid_argument("DenseVerifier: the field has no cells");
  const auto ratio =
      static_cast<std::uint32_t>(std::max(1.0, std::round(kQuickCell / field.frame.resolution)));
  quick_frame_.origin = field.frame.origin;
  quick_frame_.resolution = field.frame.resolution * ratio;
  quick_frame_.width = (field.frame.width + ratio - 1) / ratio;
  quick_frame_.height = (field.frame.height + ratio - 1) / ratio;
  quick_.assign(static_cast<std::size_t>(quick_frame_.width) * quick_frame_.height + 1, 0);
  const LikelihoodTable& table = coarseTable();
  for (std::size_t y = 0; y < field.frame.height; ++y)
  {
    for (std::size_t x = 0; x < field.frame.width; ++x)
    {
      const std::uint8_t distance = field.cells[y * field.frame.width + x].distance;
      const auto value = static_cast<std::uint8_t>(std::lround(255.0F * table[distance]));
      // Cell 0 is the look-up for everything outside and stays zero.
      std::uint8_t& quick = quick_[(y / ratio) * quick_frame_.width + x / ratio + 1];
      quick = std::max(quick, value);
    }
  }
}

float DenseVerifier::quickScore(const float* x, const float* y, std::size_t count,
                                const PoseProposal& p) const
{
  const auto scale = static_cast<float>(1.0 / quick_frame_.resolution);
  const float x0 = (p.x - static_cast<float>(quick_frame_.origin.x)) * scale;
  const float y0 = (p.y - static_cast<float>(quick_frame_.origin.y)) * scale;
  const std::uint32_t width = quick_frame_.width;
  const std::uint32_t height = quick_frame_.height;
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    // A negative coordinate becomes a huge unsigned one and fails the comparison.
    const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(x0 + x[i] * scale));
    const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(y0 + y[i] * scale));
    const std::size_t cell =
        ix < width && iy < height ? static_cast<std::size_t>(iy) * width + ix + 1 : 0;
    sum += quick_[cell];
  }
  return static_cast<float>(sum);
}

std::vector<RankedPose> DenseVerifier::rank(const DenseScan& scan,
                                            const std::vector<PoseProposal>& proposals,
                                            std::size_t max_ranked,
                                            std::uint64_t& poses_scored) const
{
  if (scan.size() == 0 || proposals.empty()) return {};
  poses_scored += proposals.size();

  // 1. A first look at every proposal with a few beams; runs of equal heading share the rotation.
  const std::size_t quick_beams = std::min(kQuickBeams, scan.size());
  std::array<float, kQuickBeams> rotated_x{};
  std::array<float, kQuickBeams> rotated_y{};
  struct Scored
  {
    float score;
    std::uint32_t index;
  };
  std::vector<Scored> scored(proposals.size());
  float phi = std::nanf("");
  for (std::uint32_t k = 0; k < proposals.size(); ++k)
  {
    if (proposals[k].phi != phi)
    {
      phi = proposals[k].phi;
      const float c = std::cos(phi);
      const float s = std::sin(phi);
      for (std::size_t i = 0; i < quick_beams; ++i)
      {
        rotated_x[i] = c * scan.x[i] - s * scan.y[i];
        rotated_y[i] = s * scan.x[i] + c * scan.y[i];
      }
    }
    scored[k] = {quickScore(rotated_x.data(), rotated_y.data(), quick_beams, proposals[k]), k};
  }
  std::sort(scored.begin(), scored.end(),
            [](const Scored& a, const Scored& b)
            { return a.score != b.score ? a.score > b.score : a.index < b.index; });

  // 2. The best of each cell of poses, refined on some of the beams.
  std::vector<RankedPose> poses;
  std::unordered_set<std::uint64_t> taken;
  for (const Scored& s : scored)
  {
    if (poses.size() == kQuickKept) break;
    const PoseProposal& p = proposals[s.index];
    const auto bin = [](float value, float size)
    {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / size))) &
             0xFFFFF;
    };
    const float wrapped = static_cast<float>(wrapToPi(static_cast<double>(p.phi)));
    const std::uint64_t key = bin(p.x, 0.4F) << 40U | bin(p.y, 0.4F) << 20U | bin(wrapped, 0.14F);
    if (!taken.insert(key).second) continue;
    RankedPose pose;
    pose.pose = refine(scan, {p.x, p.y, p.phi}, kMiddleSteps, kMiddleBeams);
    const Placement place(pose.pose);
    const CellView cells(field_);
    const std::size_t beams = std::min(kMiddleBeams, scan.size());
    float sum = 0;
    for (std::size_t i = 0; i < beams; ++i)
    {
      const DenseCell& cell =
          cells.at(place.placedX(scan.x[i], scan.y[i]), place.placedY(scan.x[i], scan.y[i]));
      sum += fineTable()[cell.distance] + coarseTable()[cell.distance];
    }
    pose.evidence.score = 0.5 * static_cast<double>(sum) / static_cast<double>(beams);
    poses.push_back(pose);
  }
  keepDistinct(poses, kFinalKept);

  // 3. The best of those, refined and judged on all beams.
  for (RankedPose& pose : poses)
  {
    pose.pose = refine(scan, pose.pose, kFinalSteps, scan.size());
    pose.evidence = evaluate(scan, pose.pose);
  }
  keepDistinct(poses, max_ranked);
  return poses;
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
      const float clear = static_cast<float>(cell.distance) * kUnit - 1.42F * resolution;
      along += std::max(clear, 0.7F * resolution);
    }
  }
  return static_cast<double>(through) / static_cast<double>(count);
}
}  // namespace sigloc
