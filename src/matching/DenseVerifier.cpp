// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/matching/DenseVerifier.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/Dense>
#include <stdexcept>
#include <unordered_set>

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::math::wrapToPi;

namespace
{
constexpr double kFineSigma = 0.12;  // [m]
constexpr double kCoarseSigma = 0.25;  // [m]
constexpr double kQuickCell = 0.1;  // [m], of the raster for the first look
constexpr std::size_t kQuickBeams = 24;
constexpr std::size_t kQuickKept = 64;  // cells of poses that are refined: the cascade's knob
constexpr std::size_t kMiddleBeams = 48;
constexpr int kMiddleSteps = 4;
constexpr std::size_t kFinalKept = 20;
constexpr int kFinalSteps = 4;
constexpr double kDistinctDistance = 0.5;  // [m]
constexpr double kDistinctAngle = 17.0 * M_PI / 180.0;  // [rad]
constexpr double kMaxShift = 0.5;  // [m] a refinement may move a pose
constexpr double kMaxTurn = 10.0 * M_PI / 180.0;  // [rad]
constexpr double kWallMargin = 0.4;  // [m] before its end a beam must be clear of walls
constexpr std::size_t kRayBeams = 64;  // beams tested for passing through walls
constexpr double kFreeMargin = 0.4;  // [m] from any wall that makes an end in free space count
constexpr double kThroughPenalty = 0.5;
constexpr double kFreePenalty = 0.5;

using LikelihoodTable = std::array<float, 256>;

/// Likelihood of a return at each distance byte.
LikelihoodTable makeTable(double sigma)
{
  LikelihoodTable table{};
  for (std::size_t d = 0; d < 255; ++d)
  {
    const double distance = static_cast<double>(d) * DenseField::kDistanceUnit;
    table[d] = static_cast<float>(std::exp(-0.5 * distance * distance / (sigma * sigma)));
  }
  return table;
}

const LikelihoodTable& fineTable()
{
  static const LikelihoodTable table = makeTable(kFineSigma);
  return table;
}
const LikelihoodTable& coarseTable()
{
  static const LikelihoodTable table = makeTable(kCoarseSigma);
  return table;
}

/// Look-up of cells by map coordinates; outside lies one cell that knows nothing.
class CellView
{
 public:
  explicit CellView(const DenseField& field)
      : cells_(field.cells.data()),
        x0_(static_cast<float>(field.frame.origin.x)),
        y0_(static_cast<float>(field.frame.origin.y)),
        scale_(static_cast<float>(1.0 / field.frame.resolution)),
        width_(field.frame.width),
        height_(field.frame.height)
  {
  }

  const DenseCell& at(float x, float y) const
  {
    const float fx = (x - x0_) * scale_;
    const float fy = (y - y0_) * scale_;
    if (!(fx >= 0 && fy >= 0 && fx < static_cast<float>(width_) &&
          fy < static_cast<float>(height_)))
    {
      return outside_;
    }
    return cells_[static_cast<std::size_t>(fy) * width_ + static_cast<std::size_t>(fx)];
  }

  /// The middle of the wall cell nearest to the cell that holds (x, y).
  TPoint2D nearestWall(float x, float y, const DenseCell& cell) const
  {
    const double resolution = 1.0 / static_cast<double>(scale_);
    const double ix = std::floor(static_cast<double>((x - x0_) * scale_)) + cell.dx + 0.5;
    const double iy = std::floor(static_cast<double>((y - y0_) * scale_)) + cell.dy + 0.5;
    return {static_cast<double>(x0_) + ix * resolution, static_cast<double>(y0_) + iy * resolution};
  }

 private:
  const DenseCell* cells_;
  float x0_, y0_, scale_;
  std::size_t width_, height_;
  DenseCell outside_;
};

/// A pose with its rotation worked out.
struct Placement
{
  explicit Placement(const TPose2D& pose)
      : x(static_cast<float>(pose.x)),
        y(static_cast<float>(pose.y)),
        c(static_cast<float>(std::cos(pose.phi))),
        s(static_cast<float>(std::sin(pose.phi)))
  {
  }
  float placedX(float px, float py) const { return x + c * px - s * py; }
  float placedY(float px, float py) const { return y + s * px + c * py; }
  float x, y, c, s;
};

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

TPose2D DenseVerifier::refine(const DenseScan& scan, const TPose2D& start, int steps,
                              std::size_t beams) const
{
  const std::size_t count = std::min(beams, scan.size());
  const CellView cells(field_);
  TPose2D pose = start;
  for (int step = 0; step < steps; ++step)
  {
    // Returns on a wall pull along the wall's normal only, others towards the nearest wall cell.
    Eigen::Matrix3f hessian = Eigen::Matrix3f::Zero();
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
    const Placement place(pose);
    const float robust = step == 0 ? 0.25F : 0.12F;  // [m], scale of the Cauchy weight
    for (std::size_t i = 0; i < count; ++i)
    {
      const float rx = place.c * scan.x[i] - place.s * scan.y[i];
      const float ry = place.s * scan.x[i] + place.c * scan.y[i];
      const float px = place.x + rx;
      const float py = place.y + ry;
      const DenseCell& cell = cells.at(px, py);
      if (cell.distance == 255) continue;
      const TPoint2D wall = cells.nearestWall(px, py, cell);
      const float ex = px - static_cast<float>(wall.x);
      const float ey = py - static_cast<float>(wall.y);
      const float squared = ex * ex + ey * ey;
      const float weight = 1.0F / (1.0F + squared / (robust * robust));
      const float nx = place.c * scan.nx[i] - place.s * scan.ny[i];
      const float ny = place.s * scan.nx[i] + place.c * scan.ny[i];
      const auto add = [&](float ax, float ay, float w)
      {
        const Eigen::Vector3f j(ax, ay, ay * rx - ax * ry);
        hessian.noalias() += w * j * j.transpose();
        gradient.noalias() += w * (ax * ex + ay * ey) * j;
      };
      if (nx != 0 || ny != 0)
      {
        add(nx, ny, weight);
      }
      else
      {
        add(1, 0, 0.5F * weight);
        add(0, 1, 0.5F * weight);
      }
    }
    // What the returns leave open stays where the proposal put it.
    hessian(0, 0) += 0.05F;
    hessian(1, 1) += 0.05F;
    hessian(2, 2) += 0.05F;
    const Eigen::Vector3f delta = hessian.ldlt().solve(-gradient);
    pose.x += static_cast<double>(delta[0]);
    pose.y += static_cast<double>(delta[1]);
    pose.phi += static_cast<double>(delta[2]);
  }
  pose.phi = wrapToPi(pose.phi);
  const bool inside = std::hypot(pose.x - start.x, pose.y - start.y) <= kMaxShift &&
                      std::abs(wrapToPi(pose.phi - start.phi)) <= kMaxTurn;
  return inside ? pose : start;
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

mrpt::math::CMatrixDouble33 DenseVerifier::covarianceAt(const DenseScan& scan, const TPose2D& pose,
                                                        double common_sigma) const
{
  constexpr double kRangeSigma = 0.05;  // [m], of a return against the raster
  constexpr double kOpenSigma = 5.0;  // [m], of a direction that nothing fixes
  constexpr double kIndependentBeams = 40;  // neighbouring beams are correlated
  const Placement place(pose);
  const CellView cells(field_);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < scan.size(); ++i)
  {
    const float rx = place.c * scan.x[i] - place.s * scan.y[i];
    const float ry = place.s * scan.x[i] + place.c * scan.y[i];
    const DenseCell& cell = cells.at(place.x + rx, place.y + ry);
    const double weight = static_cast<double>(fineTable()[cell.distance]);
    if (weight <= 0.05) continue;
    const double nx = static_cast<double>(place.c * scan.nx[i] - place.s * scan.ny[i]);
    const double ny = static_cast<double>(place.s * scan.nx[i] + place.c * scan.ny[i]);
    const auto add = [&](double ax, double ay, double w)
    {
      const Eigen::Vector3d j(ax, ay, ay * static_cast<double>(rx) - ax * static_cast<double>(ry));
      information += w * j * j.transpose();
    };
    if (nx != 0 || ny != 0)
    {
      add(nx, ny, weight);
    }
    else
    {
      add(1, 0, 0.5 * weight);
      add(0, 1, 0.5 * weight);
    }
  }
  const double tempering = std::min(1.0, kIndependentBeams / static_cast<double>(scan.size() + 1));
  information *= tempering / (kRangeSigma * kRangeSigma);
  information(0, 0) += 1.0 / (kOpenSigma * kOpenSigma);
  information(1, 1) += 1.0 / (kOpenSigma * kOpenSigma);
  information(2, 2) += 1.0 / (0.2 * 0.2);
  Eigen::Matrix3d covariance = information.inverse();
  covariance(0, 0) += common_sigma * common_sigma;
  covariance(1, 1) += common_sigma * common_sigma;
  mrpt::math::CMatrixDouble33 out;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c) out(r, c) = 0.5 * (covariance(r, c) + covariance(c, r));
  }
  return out;
}
}  // namespace sigloc
