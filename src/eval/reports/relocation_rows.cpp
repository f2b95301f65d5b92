// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/reports/relocation_rows.h"

#include "config/fixed_number.h"
#include "config/TextStream.h"
#include "eval/reports/report_files.h"

namespace sigloc
{
namespace
{
constexpr const char* kDefinitions = R"(
## What the columns mean

* **recall@1**: the first candidate lies within 0.5 m and 10 degrees of the truth; **tight**: within
  0.5 m and 3.6 degrees; **recall@10**: one of the first ten does. **proposed**: a right pose was
  among those that the method's features proposed; empty for methods that search instead.
* **confident**: the verdict is `localized`, P(first) >= 0.99. Of these, **right** as above,
  **wrong**: more than 1 m or 20 degrees off (of a simulated scan, whose truth is exact, every one that
  is not right; in a foreign map every one), **inaccurate**: between.
  Methods without a verdict show `-`.
* **error**: median over right first answers.
* **time**: CPU time of one thread from raw scan to ranked candidates, feature extraction included.
  **ratio**: median time over that of the first method listed.
* `jcbb`, `clique` and `interpretation-tree` look at features alone, share the constraints of the
  signatures and none of our search, and end after 10^8 operations.
* `mcl`, `mcl-tuned`: MRPT's filter at its first look: 40 000 particles drawn over the free cells of
  the map (tuned: 200 a square metre, at least 40 000, at most 200 000) and weighed by the scan, with
  pf-localization's likelihood; candidates are the heaviest clusters of 0.5 m and 10 degrees. It
  claims nothing: its rule takes five steps. Before the robot moves KLD adapts nothing, so that a
  fixed number would be the same. What it does over a drive, `track` tells.
* Shares are over queries that saw something (10 valid beams or more) and carry Wilson 95 % intervals.
)";

std::string poseCells(const std::optional<mrpt::math::TPose2D>& pose)
{
  if (!pose) return ",,";
  return fixedNumber(pose->x, 4) + "," + fixedNumber(pose->y, 4) + "," + fixedNumber(pose->phi, 5);
}

}  // namespace

nlohmann::ordered_json toJson(const RelocationSummary& s)
{
  nlohmann::ordered_json json;
  json["queries"] = s.queries;
  json["saw_nothing"] = s.saw_nothing;
  json["claims_verdict"] = s.claims_verdict;
  json["confident"] = s.confident;
  json["confident_right"] = s.confident_right;
  json["confidently_wrong"] = s.confidently_wrong;
  json["inaccurate"] = s.inaccurate;
  json["cut_short"] = s.cut_short;
  addProportion(json, "recall_at_1", s.recall_at_1);
  addProportion(json, "recall_at_1_tight", s.recall_at_1_tight);
  addProportion(json, "recall_at_10", s.recall_at_10);
  addProportion(json, "proposed", s.proposed);
  json["median_error_m"] = s.median_error_m;
  json["median_error_deg"] = s.median_error_deg;
  json["poses_scored"] = toJson(s.poses_scored);
  json["proposals"] = toJson(s.proposals);
  json["time_ms"] = toJson(s.time_ms);
  return json;
}

std::string relocationCsvHead()
{
  return "method,query,truth_x,truth_y,truth_phi,valid_beams,verdict,probability,x,y,phi,score,"
         "error_m,error_deg,candidates,rank_of_right,proposals,proposed,claim,poses_scored,"
         "cut_short,time_ms";
}

std::string relocationCsvRow(const std::string& method, const RelocationRecord& r)
{
  TextStream csv;
  csv << method << "," << r.query << "," << poseCells(r.truth) << "," << r.valid_beams << ","
      << toString(r.verdict) << "," << fixedNumber(r.probability, 6) << "," << poseCells(r.first)
      << "," << fixedNumber(r.first_score, 5) << "," << fixedNumber(r.error.distance, 4) << ","
      << fixedNumber(r.error.angle_deg, 3) << "," << r.candidates << "," << r.rank_of_right << ","
      << r.proposals << "," << (r.proposed ? (*r.proposed ? "1" : "0") : "") << ","
      << (r.claims_verdict ? toString(r.claim) : "") << "," << r.poses_scored << "," << r.cut_short
      << "," << fixedNumber(r.time_ms, 3);
  return csv.str();
}

std::vector<std::string> relocationTableHead()
{
  return {"method",    "queries",   "saw nothing", "recall@1", "tight",      "recall@10",
          "proposed",  "confident", "right",       "wrong",    "inaccurate", "error m",
          "error deg", "ms median", "p95",         "mean",     "ratio"};
}

std::vector<std::string> relocationTableRow(const std::string& method, const RelocationSummary& s,
                                            const RelocationSummary& reference)
{
  const auto claims = [&](std::size_t count)
  { return s.claims_verdict ? std::to_string(count) : std::string("-"); };
  const auto share = [](const Proportion& p)
  { return p.cases > 0 ? fixedNumber(p.value(), 3) : std::string("-"); };
  return {method,
          std::to_string(s.queries),
          std::to_string(s.saw_nothing),
          withInterval(s.recall_at_1),
          share(s.recall_at_1_tight),
          share(s.recall_at_10),
          share(s.proposed),
          claims(s.confident),
          claims(s.confident_right),
          claims(s.confidently_wrong),
          claims(s.inaccurate),
          fixedNumber(s.median_error_m, 3),
          fixedNumber(s.median_error_deg, 2),
          fixedNumber(s.time_ms.median, 3),
          fixedNumber(s.time_ms.p95, 3),
          fixedNumber(s.time_ms.mean, 3),
          fixedNumber(s.time_ms.median / reference.time_ms.median, 2)};
}

std::string relocationDefinitions()
{
  return kDefinitions;
}
}  // namespace sigloc
