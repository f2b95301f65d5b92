// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/maps/CMetricMap.h>

#include <memory>
#include <optional>
#include <string>

#include "sigloc/map/FeatureMap.h"
#include "sigloc/map/map_building.h"
#include "sigloc/map/sensor_model.h"

namespace sigloc
{
/// A feature map as one of MRPT's metric maps, so that stock programs use it without knowing it.
/// They use it inside a `CMultiMetricMap`, take the likelihood of any particle filter from it,
/// store it and show it.
///
/// In an ini file: `SignatureMap_count=1` and the sections
/// `<name>_SignatureMap_00_{creationOpts,insertOpts,likelihoodOpts}`, where `creationOpts` may name
/// a prepared map, `sigmap_file`. Stock programs that read a simplemap clear all maps and insert
/// its scans. They leave a prepared map as it is when its `enableObservationInsertion` is false.
///
/// Inserted scans are added to the map one by one and are not kept. The cost of one grows with the
/// area that it sees. The likelihood of scans is up to date at once; features are derived when they
/// are asked for.
///
/// A scan that the map cannot hold, far from all others or at no finite pose, is refused: inserting
/// it returns false, and asString() tells how many were and why.
///
/// Const member functions may be called from several threads at once.
class SignatureMap : public mrpt::maps::CMetricMap
{
  DEFINE_SERIALIZABLE(SignatureMap, sigloc)

 public:
  SignatureMap();
  explicit SignatureMap(FeatureMap map);
  /// Scans inserted into a copy do not change the original.
  SignatureMap(const SignatureMap& other);
  SignatureMap& operator=(const SignatureMap& other);
  ~SignatureMap() override;

  /// How scans become features; all keys of both structs in one ini section.
  struct TInsertionOptions : public mrpt::config::CLoadableOptions
  {
    MapBuildingOptions building;
    FeatureExtractorOptions extraction;

    /// Throws std::invalid_argument for an unknown key or a bad value.
    void loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                            const std::string& section) override;
    void saveToConfigFile(mrpt::config::CConfigFileBase& target,
                          const std::string& section) const override;
  };

  struct TLikelihoodOptions : public mrpt::config::CLoadableOptions
  {
    PointLikelihoodOptions points;

    /// Throws std::invalid_argument for an unknown key or a bad value.
    void loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                            const std::string& section) override;
    void saveToConfigFile(mrpt::config::CConfigFileBase& target,
                          const std::string& section) const override;
  };

  /// `extraction` is effective for scans inserted from now on, `building` for those after the map
  /// was empty or loaded.
  TInsertionOptions insertion_options;
  TLikelihoodOptions likelihood_options;

  /// The map, with every scan inserted so far; built on demand, never null. A later insertion makes
  /// a new one.
  std::shared_ptr<const FeatureMap> featureMap() const;

  // Overrides of mrpt::maps::CMetricMap.
  bool isEmpty() const override;
  std::string asString() const override;
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;
  /// Writes `<prefix>.sigmap`.
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  /// Pairs every point of a points map with the nearest point on a feature.
  void determineMatching2D(const mrpt::maps::CMetricMap* other_map,
                           const mrpt::poses::CPose2D& other_map_pose,
                           mrpt::tfest::TMatchingPairList& correspondences,
                           const mrpt::maps::TMatchingParams& params,
                           mrpt::maps::TMatchingExtraResults& extra_results) const override;
  /// Share of the other map's points (or features) that lie on features of this one; 0 for other
  /// kinds of maps.
  float compute3DMatchingRatio(const mrpt::maps::CMetricMap* other_map,
                               const mrpt::poses::CPose3D& other_map_pose,
                               const mrpt::maps::TMatchingRatioParams& params) const override;
  float squareDistanceToClosestCorrespondence(float x, float y) const override;
  void auxParticleFilterCleanUp() override;

  MAP_DEFINITION_START(SignatureMap)
  std::string sigmap_file;  ///< a prepared map, or empty
  sigloc::SignatureMap::TInsertionOptions insertion_options;
  sigloc::SignatureMap::TLikelihoodOptions likelihood_options;
  MAP_DEFINITION_END(SignatureMap)

 private:
  struct Model;  // the map in the form used for look-ups
  struct PreparedObservation;
  struct Learnt;  // the inserted scans' data, and what is derived from them on demand

  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& observation,
      const std::optional<const mrpt::poses::CPose3D>& robot_pose) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& observation,
      const mrpt::poses::CPose3D& taken_from) const override;
  bool internal_canComputeObservationLikelihood(
      const mrpt::obs::CObservation& observation) const override;

  std::shared_ptr<const FeatureMap> baseMap() const;
  std::shared_ptr<const Model> model() const;
  const DenseField* field() const;
  std::shared_ptr<const PreparedObservation> prepared(
      const mrpt::obs::CObservation& observation) const;

  std::shared_ptr<const FeatureMap> prepared_map_ = std::make_shared<FeatureMap>();
  std::unique_ptr<Learnt> learnt_;
};
}  // namespace sigloc
