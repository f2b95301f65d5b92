// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/scoring/relocation_summary.h"

#include <mrpt/core/bits_math.h>

namespace sigloc
{
namespace
{
using Summary = RelocationSummary;

constexpr const char* kNotes = R"(
Right: within 0.5 m and 10 degrees of the truth. Wrong: more than 1 m or 20 degrees off. Of a
simulated scan, whose truth is exact, all that is not right is wrong; in a foreign map, everything.
Confident: the verdict is `localized`, P(first) >= 0.99. Methods without a verdict show `-`.
Shares are over queries that saw something (10 valid beams or more); intervals are Wilson's, 95 %.

* `jcbb`, `clique` and `interpretation-tree` look at features alone, share the constraints of the
  signatures and none of our search, and end after 10^8 operations. `jcbb-0.35` and `jcbb-0.25`
  expect less of what is seen to be mapped; `jcbb-greedy` pairs nearest neighbours at the end.
* `branch-and-bound` keeps the best 10 poses of the lattice, `branch-and-bound-1` one, where
  `exhaustive` refines 400. `exhaustive-fine` searches the raster that signatures use.
* `mcl`, `mcl-tuned`: MRPT's filter at its first scan: 40 000 particles drawn over the free cells of
  the map (tuned: 200 a square metre, at least 40 000, at most 200 000) and weighed by the scan, with
  pf-localization's likelihood; candidates are the heaviest clusters of 0.5 m and 10 degrees. It
  claims nothing: its rule takes five steps. Before the robot moves KLD adapts nothing, so that a
  fixed number would be the same. What it does over a drive, `track` measures.
)";

/// A share that tables show without its interval.
auto plainShare(std::optional<bool> Outcome::*is)
{
  return [is](const Summary& s)
  {
    const Proportion p = share(is)(s);
    return Written{written(p, 0).json, {p.cases > 0 ? fixedNumber(p.value(), 3) : "-"}};
  };
}

bool claimsVerdict(const Summary& s)
{
  return total(&Outcome::claims_verdict)(s) > 0;
}

/// A count that tables leave out where the method has no verdict.
auto claims(bool Outcome::*is)
{
  return [is](const Summary& s)
  {
    const std::size_t count = total(is)(s);
    return Written{{{"", count}}, {claimsVerdict(s) ? std::to_string(count) : "-"}};
  };
}
}  // namespace

void RelocationSummary::add(const RelocationRecord& record)
{
  Outcome& outcome = records.emplace_back();
  outcome.saw_nothing = record.sawNothing();
  outcome.claims_verdict = record.claim.has_value();
  outcome.confident = record.claim.value_or(Claim::none) != Claim::none;
  outcome.confident_right = record.claim == Claim::right;
  outcome.confidently_wrong = record.claim == Claim::wrong;
  outcome.inaccurate = record.claim == Claim::inaccurate;
  outcome.cut_short = record.cut_short;
  outcome.poses_scored = static_cast<double>(record.poses_scored);
  outcome.times_ms.assign(1, record.time_ms);
  if (record.sawNothing() || !record.truth) return;
  outcome.right = record.rank_of_right == 1;
  outcome.tight = *outcome.right && record.error.angle <= AccuracyGates().tight_angle;
  outcome.among_ten = record.rank_of_right > 0;
  outcome.proposed = record.proposed;
  if (*outcome.right) outcome.error = record.error;
  if (record.proposed) outcome.proposals = static_cast<double>(record.proposals);
}

Columns<Summary> summaryColumns()
{
  using O = Outcome;
  using C = Column<Summary>;
  constexpr int kClaims = 1, kCosts = 2;
  return {
      C("", &Summary::method, "", 0, {"method"}),
      C("queries", [](const Summary& s) { return s.records.size(); }, "", 0, {"queries"}),
      C("saw_nothing", total(&O::saw_nothing),
        "fewer than 10 valid beams: counted in the queries, left out of the shares", 0,
        {"saw nothing"}),
      C("claims_verdict", claimsVerdict, "the method says whether it is sure"),
      C("confident", claims(&O::confident), "answers whose verdict is `localized`", 0,
        {"confident"}, kClaims),
      C("confident_right", claims(&O::confident_right), "of these, right", 0, {"right"}, kClaims),
      C("confidently_wrong", claims(&O::confidently_wrong), "of these, wrong", 0, {"wrong"},
        kClaims),
      C("inaccurate", claims(&O::inaccurate), "of these, between right and wrong", 0,
        {"inaccurate"}, kClaims),
      C("cut_short", total(&O::cut_short), "searches that ended at their budget"),
      C("recall_at_1", share(&O::right), "the first candidate is right", 3, {"recall@1"}),
      C("recall_at_1_tight", plainShare(&O::tight), "and within 3.6 degrees", 3, {"tight"}),
      C("recall_at_10", plainShare(&O::among_ten), "one of the first ten candidates is right", 3,
        {"recall@10"}),
      C("proposed", plainShare(&O::proposed),
        "a right pose was among those that the method's features proposed; empty for methods that "
        "search instead",
        3, {"proposed"}),
      C("median_error_m",
        part(&Quantiles::median, quantiles([](const O& o) { return o.error.distance; })),
        "of right first candidates", 3, {"error m"}, kCosts),
      C("median_error_deg",
        part(&Quantiles::median,
             quantiles([](const O& o) { return mrpt::RAD2DEG(o.error.angle); })),
        "of right first candidates", 2, {"error deg"}, kCosts),
      C("poses_scored", quantiles(&O::poses_scored), "poses compared with the scan"),
      C("proposals", quantiles(&O::proposals), "poses proposed"),
      C("time_ms", quantiles(&O::times_ms),
        "CPU time of one thread from raw scan to ranked candidates, feature extraction included", 3,
        {"ms median", "p95", "mean"}, kCosts),
      C(
          "", [](const Summary& s) { return medianTime(s) / s.reference_ms; },
          "median time over that of the first method listed", 2, {"ratio"}, kCosts)};
}

std::string relocationDefinitions()
{
  return legend("What the columns mean", summaryColumns()) + kNotes +
         legend("What the columns of results.csv mean", relocationColumns());
}
}  // namespace sigloc
