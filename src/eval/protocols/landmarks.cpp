// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/protocols/landmarks.h"

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "eval/data/evaluation_data.h"
#include "eval/methods/feature_methods.h"
#include "eval/process/cpu_time.h"
#include "eval/protocols/landmark_queries.h"

namespace sigloc
{
namespace
{
/// The tolerances of a right answer, by data set. The truth of the park has errors of up to 0.3 m.
AccuracyGates gatesOf(const std::string& dataset)
{
  AccuracyGates gates;
  if (dataset == "victoria-park")
  {
    gates.right_distance = 1.0;
    gates.right_angle = 3.0 * M_PI / 180;
  }
  return gates;
}

/// Significant, and with a probability of 99 % between it and the second.
bool isFirm(const std::vector<FeatureHypothesis>& found, const GeneratorOptions& options)
{
  const double ahead = std::log(99.0);
  return !found.empty() && found[0].chance < options.significance &&
         (found.size() < 2 || found[0].log_odds - found[1].log_odds > ahead);
}

struct Asked
{
  LandmarkRecord record;
  std::vector<Feature> features;
  std::vector<FeatureHypothesis> found;
};

/// One method on one data set, and the storage of its answers.
struct MethodRun
{
  const FeatureHypothesisGenerator& method;
  const std::string& name;
  std::shared_ptr<const FeatureMap> map;
  const LandmarkData& data;
  const LandmarksOptions& options;
  LandmarksReport& report;

  void add(Asked asked, std::size_t local_map_steps)
  {
    LandmarkRecord& record = asked.record;
    record.method = name;
    record.local_map_steps = local_map_steps;
    std::size_t& failures = kept[local_map_steps];
    if (!*record.right && record.truth_sure && failures < options.keep_failures)
    {
      ++failures;
      std::string query = std::to_string(record.step);
      if (local_map_steps > 0) query += "-steps-" + std::to_string(local_map_steps);
      report.failures.push_back(featureFailure(name, map, query, asked.features,
                                               data.steps[record.step].truth, asked.found));
    }
    report.records.push_back(record);
  }

  std::map<std::size_t, std::size_t> kept;  ///< failures by local map steps
};

Asked ask(const FeatureHypothesisGenerator& method, const LocalMap& local, std::size_t step,
          const LandmarkData& data, const LandmarksOptions& options)
{
  MatchingCounters counters;
  Asked asked;
  asked.features = local.features();
  const double before = threadCpuSeconds();
  asked.found = method.generate(asked.features, counters);
  LandmarkRecord& record = asked.record;
  record.times_ms = {1e3 * (threadCpuSeconds() - before)};
  record.operations =
      counters.signature_pairs + counters.hypotheses + counters.checks + counters.visits;
  record.cut_short = counters.cut_short > 0;
  record.step = step;
  record.features = asked.features.size();
  record.travelled = local.travelled();
  record.answered = !asked.found.empty();
  record.truth_sure = data.steps[step].truth_sure;
  if (record.answered)
    record.first_error = errorBetween(asked.found.front().pose.mean, data.steps[step].truth);
  record.right = record.answered && isRight(record.first_error, gatesOf(options.dataset));
  if (*record.right) record.error = record.first_error;
  record.saw_nothing = asked.features.empty();
  record.claims_verdict = true;
  record.confident = isFirm(asked.found, options.generator);
  record.confident_right = record.confident && *record.right;
  record.confidently_wrong = record.confident && !*record.right && record.truth_sure;
  return asked;
}

std::vector<std::size_t> limited(const std::vector<std::size_t>& queries, std::size_t most)
{
  std::vector<std::size_t> kept;
  for (const std::size_t which : evenlySpaced(queries.size(), most)) kept.push_back(queries[which]);
  return kept;
}

void runFixedLocalMaps(MethodRun& run)
{
  const LandmarksOptions& options = run.options;
  const auto queries = limited(detail::laterVisits(run.data, options), options.max_queries);
  for (const std::size_t count : options.local_map_steps)
  {
    for (const std::size_t step : queries)
    {
      const LocalMap local = detail::localMapAt(run.data, step, count);
      run.add(ask(run.method, local, step, run.data, options), count);
    }
  }
}

/// Victoria Park: from a start the local map grows until the answer is firm or it is too long.
Asked askGrowing(const MethodRun& run, std::size_t start)
{
  const std::vector<LandmarkStep>& steps = run.data.steps;
  LocalMap local;
  Asked asked;
  double time = 0;
  std::uint64_t operations = 0;
  for (std::size_t k = start; k < steps.size(); ++k)
  {
    const double before_travel = local.travelled();
    const std::size_t before_features = local.features().size();
    local.add(steps[k].motion, steps[k].observed);
    // A robot that stands still observes nothing new.
    const bool news = k == start || local.features().size() != before_features ||
                      local.travelled() > before_travel + 0.1;
    if (!news) continue;
    asked = ask(run.method, local, k, run.data, run.options);
    time += asked.record.times_ms.front();
    operations += asked.record.operations;
    if (asked.record.confident || local.travelled() > run.options.max_travel) break;
  }
  asked.record.times_ms = {time};
  asked.record.operations = operations;
  return asked;
}

void runGrowingLocalMaps(MethodRun& run)
{
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k + 1 < run.data.steps.size(); k += run.options.query_stride)
  {
    starts.push_back(k);
  }
  for (const std::size_t start : limited(starts, run.options.max_queries))
  {
    run.add(askGrowing(run, start), 0);
  }
}

}  // namespace

LandmarksReport runLandmarks(const LandmarksOptions& options)
{
  const bool dlr = options.dataset == "dlr";
  if (!dlr && options.dataset != "victoria-park")
  {
    throw std::invalid_argument("unknown data set '" + options.dataset + "': dlr or victoria-park");
  }
  if (options.local_map_steps.empty() || options.query_stride == 0)
  {
    throw std::invalid_argument("landmarks: needs local map steps and a query stride above 0");
  }
  checkFeatureMethods(options.methods);
  const LandmarkData data = dlr ? readDlr(options.path) : readVictoriaPark(options.path);
  const double before = threadCpuSeconds();
  const auto map = std::make_shared<const FeatureMap>(
      dlr && options.first_half_map ? mapFromSteps(data, data.steps.size() / 2) : data.map,
      std::nullopt, data.map_error);
  LandmarksReport report;
  report.dataset = options.dataset;
  report.map.add(*map, threadCpuSeconds() - before);
  report.provenance.command = options.command;
  report.provenance.seed = options.seed;
  report.provenance.data_files = data.files;
  GeneratorOptions generator = options.generator;
  generator.seed = static_cast<std::uint32_t>(options.seed);
  for (const std::string& name : options.methods)
  {
    const auto method = makeFeatureMethod(name, *map, generator);
    MethodRun run{*method, name, map, data, options, report, {}};
    dlr ? runFixedLocalMaps(run) : runGrowingLocalMaps(run);
    if (options.progress) options.progress(name + ": done");
  }
  return report;
}
}  // namespace sigloc
