// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sigloc/eval/landmarks.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "landmark_queries.h"
#include "sigloc/eval/cpu_time.h"
#include "sigloc/eval/feature_methods.h"
#include "sigloc/eval/report_files.h"

namespace sigloc
{
namespace
{
constexpr const char* kExplanation =
    "\nFirm: significant, and far ahead of the second. Not judged: answers that are not right by a "
    "truth that is\nuncertain by more than 0.5 m itself, or jumps against the odometry; they count "
    "as "
    "not right, but not as wrong.\n";

/// What counts as right, by data set: the truth of the park is itself off by up to 0.3 m.
AccuracyGates gatesOf(const std::string& dataset)
{
  AccuracyGates gates;
  if (dataset == "victoria-park")
  {
    gates.right_distance = 1.0;
    gates.right_angle_deg = 3.0;
  }
  return gates;
}

/// Significant, and so far ahead of the second that it holds 99 % between the two.
bool isFirm(const std::vector<FeatureHypothesis>& found, const GeneratorOptions& options)
{
  const double ahead = std::log(99.0);
  return !found.empty() && found[0].chance < options.significance &&
         (found.size() < 2 || found[0].log_odds - found[1].log_odds > ahead);
}

struct Asked
{
  LandmarkRecord record;
  std::vector<FeatureHypothesis> found;
};

Asked ask(const FeatureHypothesisGenerator& method, const LocalMap& local, std::size_t step,
          const LandmarkData& data, const LandmarksOptions& options)
{
  const std::vector<Feature> features = local.features();
  MatchingCounters counters;
  const double before = threadCpuSeconds();
  Asked asked;
  asked.found = method.generate(features, counters);
  LandmarkRecord& record = asked.record;
  record.time_ms = 1e3 * (threadCpuSeconds() - before);
  record.operations = counters.signature_pairs + counters.hypotheses + counters.checks;
  record.cut_short = counters.cut_short > 0;
  record.step = step;
  record.features = features.size();
  record.travelled = local.travelled();
  record.answered = !asked.found.empty();
  record.firm = isFirm(asked.found, options.generator);
  record.truth_sure = data.steps[step].truth_sure;
  if (record.answered)
  {
    record.error = poseError(asked.found.front().pose.mean, data.steps[step].truth);
    record.right = isRight(record.error, gatesOf(options.dataset));
  }
  return asked;
}

template <class Container>
void limit(Container& container, std::size_t most)
{
  if (most > 0 && container.size() > most) container.resize(most);
}

void runFixedLocalMaps(const FeatureHypothesisGenerator& method, const std::string& name,
                       const LandmarkData& data, const LandmarksOptions& options,
                       LandmarksReport& report)
{
  std::vector<std::size_t> queries = detail::laterVisits(data, options);
  limit(queries, options.max_queries);
  for (const std::size_t count : options.local_map_steps)
  {
    for (const std::size_t step : queries)
    {
      LandmarkRecord record =
          ask(method, detail::localMapAt(data, step, count), step, data, options).record;
      record.method = name;
      record.local_map_steps = count;
      report.records.push_back(record);
    }
  }
}

/// Victoria Park: from each start the local map grows until the answer is firm or it is too long.
void runGrowingLocalMaps(const FeatureHypothesisGenerator& method, const std::string& name,
                         const LandmarkData& data, const LandmarksOptions& options,
                         LandmarksReport& report)
{
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k + 1 < data.steps.size(); k += options.query_stride)
  {
    starts.push_back(k);
  }
  limit(starts, options.max_queries);
  for (const std::size_t start : starts)
  {
    LocalMap local;
    LandmarkRecord record;
    double time = 0;
    std::uint64_t operations = 0;
    for (std::size_t k = start; k < data.steps.size(); ++k)
    {
      const double before_travel = local.travelled();
      const std::size_t before_features = local.features().size();
      local.add(data.steps[k].motion, data.steps[k].observed);
      // Standing still shows nothing new.
      const bool news = k == start || local.features().size() != before_features ||
                        local.travelled() > before_travel + 0.1;
      if (!news) continue;
      record = ask(method, local, k, data, options).record;
      time += record.time_ms;
      operations += record.operations;
      if (record.firm || local.travelled() > options.max_travel) break;
    }
    record.method = name;
    record.time_ms = time;
    record.operations = operations;
    report.records.push_back(record);
  }
}

std::vector<LandmarksRow> summarizeRows(const std::vector<LandmarkRecord>& records)
{
  std::vector<LandmarksRow> rows;
  std::vector<std::vector<double>> travelled;
  std::vector<std::vector<double>> times;
  for (const LandmarkRecord& record : records)
  {
    if (rows.empty() || rows.back().method != record.method ||
        rows.back().local_map_steps != record.local_map_steps)
    {
      rows.emplace_back();
      rows.back().method = record.method;
      rows.back().local_map_steps = record.local_map_steps;
      travelled.emplace_back();
      times.emplace_back();
    }
    LandmarksRow& row = rows.back();
    row.features += static_cast<double>(record.features);
    row.operations += static_cast<double>(record.operations);
    row.cut_short += record.cut_short;
    for (Proportion* share : {&row.right, &row.firm, &row.firm_and_wrong}) ++share->cases;
    row.right.count += record.right;
    row.firm.count += record.firm;
    row.firm_and_wrong.count += record.firm && !record.right && record.truth_sure;
    row.not_judged += !record.right && !record.truth_sure;
    travelled.back().push_back(record.travelled);
    times.back().push_back(record.time_ms);
  }
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    rows[k].features /= static_cast<double>(rows[k].right.cases);
    rows[k].operations /= static_cast<double>(rows[k].right.cases);
    rows[k].travelled = quantilesOf(travelled[k]);
    rows[k].time_ms = quantilesOf(times[k]);
  }
  return rows;
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
  const FeatureMap map(
      dlr && options.first_half_map ? mapFromSteps(data, data.steps.size() / 2) : data.map,
      std::nullopt, data.map_error);
  LandmarksReport report;
  report.dataset = options.dataset;
  report.map_features = map.features().size();
  report.provenance.command = options.command;
  report.provenance.seed = options.seed;
  report.provenance.data_files = data.files;
  GeneratorOptions generator = options.generator;
  generator.seed = static_cast<std::uint32_t>(options.seed);
  for (const std::string& name : options.methods)
  {
    const auto method = makeFeatureMethod(name, map, generator);
    dlr ? runFixedLocalMaps(*method, name, data, options, report)
        : runGrowingLocalMaps(*method, name, data, options, report);
    if (options.progress) options.progress(name + ": done");
  }
  report.rows = summarizeRows(report.records);
  return report;
}

std::string landmarksTable(const LandmarksReport& report)
{
  std::vector<std::vector<std::string>> rows{
      {"method", "local map steps", "features", "right", "firm", "firm and wrong", "not judged",
       "travel m median", "p95", "ms median", "p95", "mean", "operations", "cut short"}};
  for (const LandmarksRow& row : report.rows)
  {
    rows.push_back({row.method,
                    row.local_map_steps > 0 ? std::to_string(row.local_map_steps) : "as needed",
                    fixedNumber(row.features, 1), withInterval(row.right), withInterval(row.firm),
                    withInterval(row.firm_and_wrong), std::to_string(row.not_judged),
                    fixedNumber(row.travelled.median, 2), fixedNumber(row.travelled.p95, 2),
                    fixedNumber(row.time_ms.median, 3), fixedNumber(row.time_ms.p95, 3),
                    fixedNumber(row.time_ms.mean, 3), fixedNumber(row.operations, 0),
                    std::to_string(row.cut_short)});
  }
  return markdownTable(rows);
}

void writeLandmarksReport(const LandmarksReport& report, const std::filesystem::path& folder)
{
  RunReport files;
  std::ostringstream csv;
  csv << "method,local_map_steps,step,features,travelled_m,answered,firm,right,truth_sure,error_m,"
         "error_deg,"
         "operations,time_ms\n";
  for (const LandmarkRecord& r : report.records)
  {
    csv << r.method << ',' << r.local_map_steps << ',' << r.step << ',' << r.features << ','
        << fixedNumber(r.travelled, 3) << ',' << r.answered << ',' << r.firm << ',' << r.right
        << ',' << r.truth_sure << ',' << fixedNumber(r.error.distance, 3) << ','
        << fixedNumber(r.error.angle_deg, 3) << ',' << r.operations << ','
        << fixedNumber(r.time_ms, 4) << '\n';
  }
  nlohmann::ordered_json& json = files.summary;
  for (const LandmarksRow& row : report.rows)
  {
    nlohmann::ordered_json entry;
    entry["local_map_steps"] = row.local_map_steps;
    entry["queries"] = row.right.cases;
    addProportion(entry, "recall_at_1", row.right);
    addProportion(entry, "firm", row.firm);
    addProportion(entry, "firm_and_wrong", row.firm_and_wrong);
    entry["not_judged"] = row.not_judged;
    entry["travelled_m"] = toJson(row.travelled);
    entry["time_ms"] = toJson(row.time_ms);
    entry["operations"] = row.operations;
    entry["cut_short"] = row.cut_short;
    json["methods"][row.method]["rows"].push_back(entry);
  }
  json["map"] = {{"features", report.map_features}};
  files.results = csv.str();
  files.text = "# Landmarks: " + report.dataset + "\n\n" + landmarksTable(report) + kExplanation;
  files.provenance = report.provenance;
  writeRunReport(files, folder);
}
}  // namespace sigloc
