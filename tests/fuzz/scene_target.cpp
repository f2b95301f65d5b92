// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "fuzz/scene_bytes.h"
#include "fuzz/small_room.h"
#include "fuzz/targets.h"
#include "sigloc/features/observe_scans.h"

namespace sigloc::fuzz
{
namespace
{
class Bytes
{
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }

  template <class T>
  T take()
  {
    T value{};
    const std::size_t n = std::min(sizeof(T), left_.size());
    std::memcpy(&value, left_.data(), n);
    left_.remove_prefix(n);
    return value;
  }

  /// In thousandths; the ends of the type stand for what no sensor means.
  double thousandths()
  {
    const auto raw = take<std::int16_t>();
    constexpr double kUnit = 1e-3;
    switch (raw)
    {
      case kNotANumber:
        return std::numeric_limits<double>::quiet_NaN();
      case kInfinite:
        return std::numeric_limits<double>::infinity();
      case kHuge:
        return 1e30;
      case kTiny:
        return 1e-30;
      default:
        return raw * kUnit;
    }
  }

 private:
  std::string_view left_;
};

LaserScan scanOf(Bytes& bytes, bool odd)
{
  LaserScan scan;
  const std::size_t beams = bytes.take<std::uint8_t>();
  scan.first_angle = odd ? bytes.thousandths() : -M_PI;
  scan.angle_step =
      odd ? bytes.thousandths() : 2 * M_PI / static_cast<double>(std::max<std::size_t>(beams, 1));
  scan.max_range = odd ? bytes.thousandths() : 12;
  scan.range_sigma = odd ? bytes.thousandths() : 0.01;
  if (odd)
  {
    scan.robot_from_sensor = {bytes.thousandths(), bytes.thousandths(), bytes.thousandths()};
  }
  for (std::size_t i = 0; i < beams; ++i)
  {
    const double range = bytes.thousandths();
    scan.ranges.push_back(static_cast<float>(range));
    scan.valid.push_back(odd || (range > 0 && std::isfinite(range)) ? 1 : 0);
  }
  return scan;
}

Feature featureOf(Bytes& bytes)
{
  Feature feature;
  feature.type = static_cast<FeatureType>(bytes.take<std::uint8_t>() % 6U);
  feature.position = {bytes.thousandths(), bytes.thousandths()};
  feature.direction = bytes.thousandths();
  feature.size = bytes.thousandths();
  feature.position_covariance(0, 0) = feature.position_covariance(1, 1) = bytes.thousandths();
  feature.direction_variance = feature.size_variance = bytes.thousandths();
  feature.parent = bytes.take<std::int8_t>();
  return feature;
}

MotionIncrement motionOf(Bytes& bytes)
{
  MotionIncrement motion;
  motion.mean = {bytes.thousandths(), bytes.thousandths(), bytes.thousandths()};
  for (int k = 0; k < 3; ++k) motion.covariance(k, k) = bytes.thousandths();
  return motion;
}

/// The scene of one step. Some have what no reader makes: features left out, so that parents point
/// at others, and beams of no origin.
ObservedScene sceneOf(Bytes& bytes, unsigned flags)
{
  std::vector<LaserScan> scans;
  const bool odd = (flags & kOddScan) != 0;
  if ((flags & kNoScan) == 0) scans.push_back(scanOf(bytes, odd));
  if ((flags & kSecondScan) != 0) scans.push_back(scanOf(bytes, odd));
  std::vector<Feature> landmarks;
  const std::size_t count = (flags & kLandmarks) != 0 ? bytes.take<std::uint8_t>() % 8U : 0;
  for (std::size_t i = 0; i < count; ++i) landmarks.push_back(featureOf(bytes));
  ObservedScene scene = observeScene(scans, landmarks);
  if ((flags & kSpoiltScene) != 0)
  {
    const std::size_t dropped = bytes.take<std::uint8_t>();
    if (dropped < scene.features.size())
    {
      scene.features.erase(scene.features.begin() + static_cast<long>(dropped));
    }
    const std::size_t beam = bytes.take<std::uint8_t>();
    if (beam < scene.beams.size()) scene.beams[beam].origin = bytes.take<std::uint8_t>();
  }
  return scene;
}

std::shared_ptr<const SignatureMatcher> usualMatcher(bool landmarks_alone)
{
  static const auto dense = matcherIn(smallRoom());
  static const auto by_features = matcherIn(landmarksOfRoom());
  return landmarks_alone ? by_features : dense;
}

/// One step of the tracker. Returns false when it was refused, which must leave the belief alone.
bool advances(HypothesisTracker& tracker, const std::optional<MotionIncrement>& motion,
              const ObservedScene& scene)
{
  const Belief before = tracker.belief();
  try
  {
    requireLaws(tracker.step(motion, scene));
    return true;
  }
  catch (const std::invalid_argument&)
  {
    const Belief& after = tracker.belief();
    require(before.reason == after.reason && before.elsewhere == after.elsewhere &&
                before.hypotheses.size() == after.hypotheses.size(),
            "a refused step that changed the belief");
    return false;
  }
}
}  // namespace

bool tracksScene(std::string_view input)
{
  constexpr int kMostSteps = 4;
  Bytes bytes(input);
  const auto matcher = usualMatcher((bytes.take<std::uint8_t>() & 1U) != 0);
  HypothesisTracker tracker(matcher);
  bool accepted = false;
  for (int step = 0; step < kMostSteps && !bytes.empty(); ++step)
  {
    const auto flags = bytes.take<std::uint8_t>();
    std::optional<MotionIncrement> motion;
    if ((flags & kMotion) != 0) motion = motionOf(bytes);
    ObservedScene scene;
    try
    {
      scene = sceneOf(bytes, flags);
    }
    catch (const std::invalid_argument&)
    {
      continue;  // scans that observeScene() refuses
    }
    if (!advances(tracker, motion, scene)) continue;
    accepted = true;
    if ((flags & kRelocate) != 0) requireLaws(matcher->localize(scene));
  }
  return accepted;
}
}  // namespace sigloc::fuzz
