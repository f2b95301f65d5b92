// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/slam/SignatureAligner.h"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CPointsMap.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/poses/CPosePDFSOG.h>
#include <mrpt/system/CTicTac.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "features/observe_points.h"
#include "map/simulated_observation.h"
#include "sigloc/io/map_files.h"
#include "sigloc/plugin/pose_pdf.h"
#include "sigloc/plugin/SignatureMap.h"
#include "slam/map_matcher.h"

namespace sigloc
{
using mrpt::maps::CMetricMap;
using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CPointsMap;
using mrpt::math::TPoint2D;

namespace
{
[[noreturn]] void refuse(const char* which, const CMetricMap* map, const char* wanted)
{
  const std::string kind = map == nullptr ? "null" : map->GetRuntimeClass()->className;
  throw std::invalid_argument(std::string("SignatureAligner: ") + which + " is " + kind + ", not " +
                              wanted);
}

std::vector<TPoint2D> planarPoints(const CPointsMap& map)
{
  std::vector<TPoint2D> points;
  points.reserve(map.size());
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    float x = 0;
    float y = 0;
    map.getPoint(i, x, y);
    points.emplace_back(static_cast<double>(x), static_cast<double>(y));
  }
  return points;
}

ObservedScene sceneOf(const CMetricMap* m2)
{
  if (const auto* map = findMap<SignatureMap>(m2)) return sceneOfMap(*map->featureMap());
  if (const auto* points = findMap<CPointsMap>(m2)) return observePoints(planarPoints(*points));
  refuse("m2", m2, "a points map or a SignatureMap");
}

PoseRegion regionAround(const mrpt::poses::CPose2D& pose,
                        const SignatureAligner::SearchLimits& limits)
{
  return {pose.x() - limits.distance,
          pose.x() + limits.distance,
          pose.y() - limits.distance,
          pose.y() + limits.distance,
          pose.phi(),
          limits.turn};
}
}  // namespace

SignatureAligner::SignatureAligner(const MatcherOptions& options) : options_(options)
{
  checkOptions(options);
}

const SignatureMatcher& SignatureAligner::matcherFor(const CMetricMap* m1)
{
  std::shared_ptr<const FeatureMap> features;
  if (const auto* map = findMap<SignatureMap>(m1))
  {
    features = map->featureMap();
  }
  else if (const auto* grid = findMap<COccupancyGridMap2D>(m1))
  {
    features = std::make_shared<const FeatureMap>(buildMapFromRaster(rasterOf(*grid)));
  }
  else
  {
    refuse("m1", m1, "a SignatureMap or a COccupancyGridMap2D");
  }
  return matcherOf(features, options_, matcher_);
}

mrpt::poses::CPosePDF::Ptr SignatureAligner::AlignPDF(
    const CMetricMap* m1, const CMetricMap* m2,
    const mrpt::poses::CPosePDFGaussian& initial_estimate,
    mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> out_info)
{
  const mrpt::system::CTicTac clock;
  const SignatureMatcher& matcher = matcherFor(m1);
  const ObservedScene scene = sceneOf(m2);
  std::optional<PoseRegion> region;
  if (search_limits) region = regionAround(initial_estimate.mean, *search_limits);
  RelocationResult result = matcher.localize(scene, region);
  auto poses = mrpt::poses::CPosePDFSOG::Create(toSumOfGaussians(toBelief(result)));
  if (!out_info.has_value()) return poses;
  auto& info = out_info.value().get();
  info.executionTime = clock.Tac();
  if (auto* own = dynamic_cast<TReturnInfo*>(&info)) own->relocation = std::move(result);
  return poses;
}

mrpt::poses::CPose3DPDF::Ptr SignatureAligner::Align3DPDF(
    const CMetricMap* m1, const CMetricMap* m2,
    const mrpt::poses::CPose3DPDFGaussian& initial_estimate,
    mrpt::optional_ref<mrpt::slam::TMetricMapAlignmentResult> out_info)
{
  const mrpt::poses::CPosePDFGaussian planar(mrpt::poses::CPose2D(initial_estimate.mean));
  const auto poses = AlignPDF(m1, m2, planar, out_info);
  return mrpt::poses::CPose3DPDF::Ptr(mrpt::poses::CPose3DPDF::createFrom2D(*poses));
}
}  // namespace sigloc
