// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/plugin/SignatureMap.h"

#include "plugin/observation_fingerprint.h"
#include "plugin/SignatureMap_state.h"

#include <mrpt/maps/CPointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose2D.h>

#include <algorithm>
#include <cmath>

#include "io/scan_conversion.h"
#include "map/map_values.h"
#include "sigloc/config/plural.h"
#include "sigloc/io/map_files.h"
#include "sigloc/plugin/map_drawing.h"

namespace sigloc
{
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationBearingRange;
using mrpt::poses::CPose2D;
using mrpt::poses::CPose3D;

namespace
{
constexpr std::size_t kObservationsKept = 16;
constexpr float kFarSquared = 1e4F;  // [m^2]
constexpr double kFar = 10.0;  // [m], the largest distance looked up

std::vector<TPoint2D> returnsOf(const LaserScan& scan)
{
  std::vector<TPoint2D> points;
  forEachReturn(scan, [&](const TPoint2D& end)
                { points.push_back(scan.robot_from_sensor.composePoint(end)); });
  return points;
}
}  // namespace

SignatureMap::SignatureMap() : learnt_(std::make_unique<Learnt>()) {}
SignatureMap::SignatureMap(FeatureMap map)
    : prepared_map_(std::make_shared<FeatureMap>(std::move(map))),
      learnt_(std::make_unique<Learnt>())
{
}
SignatureMap::SignatureMap(const SignatureMap& other)
    : mrpt::maps::CMetricMap(other),
      insertion_options(other.insertion_options),
      likelihood_options(other.likelihood_options),
      prepared_map_(other.prepared_map_),
      learnt_(std::make_unique<Learnt>(*other.learnt_))
{
}
SignatureMap::~SignatureMap() = default;

SignatureMap& SignatureMap::operator=(const SignatureMap& other)
{
  if (this == &other) return *this;
  mrpt::maps::CMetricMap::operator=(other);
  insertion_options = other.insertion_options;
  likelihood_options = other.likelihood_options;
  prepared_map_ = other.prepared_map_;
  *learnt_ = *other.learnt_;
  return *this;
}

SignatureMap::Learnt::Learnt(const Learnt& other)
{
  const std::lock_guard<std::mutex> lock(other.mutex);
  builder = other.builder;
  refused = other.refused;
  refusal = other.refusal;
}

SignatureMap::Learnt& SignatureMap::Learnt::operator=(const Learnt& other)
{
  if (this == &other) return *this;
  const std::scoped_lock lock(mutex, other.mutex);
  builder = other.builder;
  refused = other.refused;
  refusal = other.refusal;
  model.reset();
  observations.clear();
  return *this;
}

/// The map that inserted scans are added to; null for none.
std::shared_ptr<const FeatureMap> SignatureMap::baseMap() const
{
  const bool from_nothing = prepared_map_->empty() && !prepared_map_->field();
  return from_nothing ? nullptr : prepared_map_;
}

std::shared_ptr<const SignatureMap::Model> SignatureMap::model() const
{
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  if (learnt_->model) return learnt_->model;
  const std::shared_ptr<const FeatureMap> map =
      learnt_->builder ? std::make_shared<FeatureMap>(learnt_->builder->map()) : prepared_map_;
  learnt_->model = std::make_shared<Model>(Model{map, NearestFeature(map->features())});
  return learnt_->model;
}

/// The dense field with every scan inserted so far, or null; valid until the next insertion.
const DenseField* SignatureMap::field() const
{
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  if (learnt_->builder) return learnt_->builder->field();
  return prepared_map_->field() ? &*prepared_map_->field() : nullptr;
}

std::shared_ptr<const FeatureMap> SignatureMap::featureMap() const
{
  return model()->map;
}

bool SignatureMap::isEmpty() const
{
  if (baseMap()) return false;
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  return !learnt_->builder;
}

std::string SignatureMap::asString() const
{
  const auto map = featureMap();
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  const std::string refused = learnt_->refused == 0
                                  ? ""
                                  : "; refused " + counted(learnt_->refused, "scan") +
                                        ", the first because " + learnt_->refusal;
  return "SignatureMap of " + counted(map->features().size(), "feature") +
         (map->field() ? " with a dense field" : "") + refused;
}

void SignatureMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const
{
  if (!genericMapParams.enableSaveAs3DObject) return;
  MapDrawing drawing;
  drawing.raster = false;
  scene.insert(drawMap(*featureMap(), drawing));
}

void SignatureMap::saveMetricMapRepresentationToFile(const std::string& prefix) const
{
  saveSigmap(*featureMap(), prefix + ".sigmap");
}

void SignatureMap::internal_clear()
{
  if (genericMapParams.enableObservationInsertion) prepared_map_ = std::make_shared<FeatureMap>();
  *learnt_ = Learnt();
}

bool SignatureMap::internal_insertObservation(const CObservation& observation,
                                              const std::optional<const CPose3D>& robot_pose)
{
  const auto* range_scan = dynamic_cast<const CObservation2DRangeScan*>(&observation);
  if (range_scan == nullptr) return false;
  auto scan = toLaserScan(*range_scan);
  // A scan without any return adds nothing to a map.
  if (!scan || std::count(scan->valid.begin(), scan->valid.end(), 0) ==
                   static_cast<std::ptrdiff_t>(scan->valid.size()))
  {
    return false;
  }
  PosedScans posed;
  if (robot_pose) posed.map_from_robot = CPose2D(*robot_pose).asTPose();
  posed.scans.push_back(std::move(*scan));
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  if (const auto reason = beyondReach(posed.map_from_robot.x, posed.map_from_robot.y))
  {
    learnt_->refuse("its pose " + *reason);
    return false;
  }
  // Only the builder with the scan is kept.
  std::optional<MapBuilder> first;
  if (!learnt_->builder) first.emplace(insertion_options.building, baseMap());
  try
  {
    (first ? *first : *learnt_->builder).add(posed, insertion_options.extraction);
  }
  catch (const std::invalid_argument& error)
  {
    learnt_->refuse(error.what());
    return false;
  }
  if (first) learnt_->builder = std::move(first);
  learnt_->model.reset();
  return true;
}

bool SignatureMap::internal_canComputeObservationLikelihood(const CObservation& observation) const
{
  if (isEmpty()) return false;
  return dynamic_cast<const CObservation2DRangeScan*>(&observation) != nullptr ||
         dynamic_cast<const CObservationBearingRange*>(&observation) != nullptr;
}

std::shared_ptr<const SignatureMap::PreparedObservation> SignatureMap::prepared(
    const CObservation& observation) const
{
  const std::size_t max_points = likelihood_options.points.max_points;
  const std::uint64_t fingerprint = fingerprintOf(observation, max_points);
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  auto& kept = learnt_->observations;
  for (const auto& entry : kept)
  {
    if (entry->fingerprint == fingerprint) return entry;
  }
  auto made = std::make_shared<PreparedObservation>();
  made->fingerprint = fingerprint;
  if (const auto* range_scan = dynamic_cast<const CObservation2DRangeScan*>(&observation))
  {
    const auto scan = toLaserScan(*range_scan);
    if (scan) made->returns = thinned(returnsOf(*scan), max_points);
  }
  if (const auto* bearings = dynamic_cast<const CObservationBearingRange*>(&observation))
  {
    std::vector<TPoint2D> points;
    for (const Feature& landmark : landmarksOf(*bearings)) points.push_back(landmark.position);
    made->landmarks = thinned(points, max_points);
  }
  kept.push_front(made);
  if (kept.size() > kObservationsKept) kept.pop_back();
  return made;
}

double SignatureMap::internal_computeObservationLikelihood(const CObservation& observation,
                                                           const CPose3D& taken_from) const
{
  // A multi-map calls every map with every observation.
  if (!internal_canComputeObservationLikelihood(observation)) return 0;
  const auto seen = prepared(observation);
  const TPose2D pose = CPose2D(taken_from).asTPose();
  const PointLikelihoodOptions& options = likelihood_options.points;
  double sum = 0;
  const DenseField* dense = field();
  if (dense != nullptr) sum += logLikelihood(*dense, seen->returns, pose, options);
  // Deriving the features takes longer than adding a scan. So it is done only where they matter.
  if (seen->landmarks.empty() && dense != nullptr) return sum;
  const auto current = model();
  sum += logLikelihood(current->nearest, seen->landmarks, pose, options);
  if (dense == nullptr) sum += logLikelihood(current->nearest, seen->returns, pose, options);
  return sum;
}

void SignatureMap::determineMatching2D(const mrpt::maps::CMetricMap* other_map,
                                       const CPose2D& other_map_pose,
                                       mrpt::tfest::TMatchingPairList& correspondences,
                                       const mrpt::maps::TMatchingParams& params,
                                       mrpt::maps::TMatchingExtraResults& extra_results) const
{
  correspondences.clear();
  extra_results = {};
  const auto* points = dynamic_cast<const mrpt::maps::CPointsMap*>(other_map);
  if (points == nullptr || points->empty()) return;
  const auto current = model();
  const TPose2D map_from_other = other_map_pose.asTPose();
  const TPoint2D pivot(params.angularDistPivotPoint.x, params.angularDistPivotPoint.y);
  const std::size_t step = std::max<std::size_t>(1, params.decimation_other_map_points);
  std::size_t asked = 0;
  double squared_sum = 0;
  for (std::size_t i = params.offset_other_map_points; i < points->size(); i += step)
  {
    ++asked;
    float x = 0;
    float y = 0;
    float z = 0;
    points->getPointFast(i, x, y, z);
    const TPoint2D point =
        map_from_other.composePoint({static_cast<double>(x), static_cast<double>(y)});
    const double reach =
        static_cast<double>(params.maxDistForCorrespondence) +
        static_cast<double>(params.maxAngularDistForCorrespondence) * (point - pivot).norm();
    const auto hit = current->nearest.find(point, reach);
    if (!hit) continue;
    const double squared = hit->distance * hit->distance;
    squared_sum += squared;
    correspondences.emplace_back(hit->feature, i, static_cast<float>(hit->place.x),
                                 static_cast<float>(hit->place.y), 0.0F, x, y, z);
    correspondences.back().errorSquareAfterTransformation = static_cast<float>(squared);
  }
  extra_results.sumSqrDist = static_cast<float>(squared_sum);
  if (asked == 0) return;
  extra_results.correspondencesRatio =
      static_cast<float>(correspondences.size()) / static_cast<float>(asked);
}

float SignatureMap::compute3DMatchingRatio(const mrpt::maps::CMetricMap* other_map,
                                           const CPose3D& other_map_pose,
                                           const mrpt::maps::TMatchingRatioParams& params) const
{
  const CPose2D planar(other_map_pose);
  if (const auto* other = dynamic_cast<const SignatureMap*>(other_map))
  {
    const auto current = model();
    const auto theirs = other->featureMap();
    if (theirs->empty()) return 0;
    std::size_t found = 0;
    for (const Feature& feature : theirs->features())
    {
      const TPoint2D place = planar.asTPose().composePoint(feature.position);
      if (current->nearest.find(place, static_cast<double>(params.maxDistForCorr))) ++found;
    }
    return static_cast<float>(found) / static_cast<float>(theirs->features().size());
  }
  mrpt::maps::TMatchingParams matching;
  matching.maxDistForCorrespondence = params.maxDistForCorr;
  mrpt::maps::TMatchingExtraResults results;
  mrpt::tfest::TMatchingPairList pairs;
  determineMatching2D(other_map, planar, pairs, matching, results);
  return results.correspondencesRatio;
}

float SignatureMap::squareDistanceToClosestCorrespondence(float x, float y) const
{
  const auto hit = model()->nearest.find({static_cast<double>(x), static_cast<double>(y)}, kFar);
  return hit ? static_cast<float>(hit->distance * hit->distance) : kFarSquared;
}

void SignatureMap::auxParticleFilterCleanUp()
{
  const std::lock_guard<std::mutex> lock(learnt_->mutex);
  learnt_->observations.clear();
}
}  // namespace sigloc
