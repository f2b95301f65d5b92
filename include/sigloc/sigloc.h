// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Everything that a program needs; each header may be included by itself.
#include "sigloc/config/option_fields.h"
#include "sigloc/config/plural.h"
#include "sigloc/features/Feature.h"
#include "sigloc/features/LaserScan.h"
#include "sigloc/features/observe_scans.h"
#include "sigloc/features/ObservedScene.h"
#include "sigloc/geometry/GaussianPose.h"
#include "sigloc/io/file_output.h"
#include "sigloc/io/map_files.h"
#include "sigloc/io/RawlogReader.h"
#include "sigloc/localize/LocalizationRun.h"
#include "sigloc/localize/LocalizationSetup.h"
#include "sigloc/localize/RunWriter.h"
#include "sigloc/map/DenseField.h"
#include "sigloc/map/FeatureMap.h"
#include "sigloc/map/map_building.h"
#include "sigloc/map/sensor_model.h"
#include "sigloc/matching/RelocationResult.h"
#include "sigloc/matching/SignatureMatcher.h"
#include "sigloc/plugin/map_drawing.h"
#include "sigloc/plugin/ObservationSignatures.h"
#include "sigloc/plugin/pose_pdf.h"
#include "sigloc/plugin/SignatureMap.h"
#include "sigloc/signature/Signature.h"
#include "sigloc/tracking/Belief.h"
#include "sigloc/tracking/HypothesisTracker.h"
#include "sigloc/tracking/TrackerOptions.h"

// What is in libsigloc-slam, where MRPT's mrpt-slam is at hand.
#if __has_include(<mrpt/slam/CMonteCarloLocalization2D.h>)
#include "sigloc/slam/SignatureAligner.h"
#include "sigloc/slam/SignatureMonteCarlo2D.h"
#endif
