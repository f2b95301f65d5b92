// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>

#include "eval/wakeup/wakeup.h"

namespace sigloc
{
namespace
{
using Steps = std::vector<WakeupStep>;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Index of the first confident step from which the method stays confident to the end. Steps
/// outside the mapped area are ignored.
std::size_t settledAt(const Steps& steps)
{
  std::size_t settled = steps.size();
  while (settled > 0 && (steps[settled - 1].claim.confident || !steps[settled - 1].mapped))
  {
    --settled;
  }
  while (settled < steps.size() && !steps[settled].claim.confident) ++settled;
  return settled;
}

/// Index of the first step after the kidnapping that does not claim a wrong pose.
std::size_t noticedAt(const Wakeup& run)
{
  std::size_t noticed = run.kidnapped_at;
  while (noticed < run.steps.size() && run.steps[noticed].claim.confident &&
         run.steps[noticed].judged != Claim::right)
  {
    ++noticed;
  }
  return noticed;
}

/// The distance and time between two steps; none when there is no step `to`.
std::optional<WakeupEvent> eventAt(const Steps& steps, std::size_t from, std::size_t to)
{
  if (to >= steps.size()) return std::nullopt;
  return WakeupEvent{steps[to].travelled - steps[from].travelled,
                     steps[to].seconds - steps[from].seconds};
}

void countWrong(Wakeup& run)
{
  for (std::size_t i = 0; i < run.steps.size(); ++i)
  {
    if (run.steps[i].judged != Claim::wrong) continue;
    ++run.wrong_steps;
    run.wrong_mapped_steps += run.steps[i].mapped;
    if (i == 0 || run.steps[i - 1].judged != Claim::wrong) ++run.wrong_episodes;
  }
}

/// Reads a part of what is believed after a step; none of a method that has no belief.
template <class Read>
auto ofBelief(Read read)
{
  return [read](const WakeupStep& step)
  { return step.claim.belief ? std::optional(std::invoke(read, step.claim)) : std::nullopt; };
}

/// Reads a part of what speaks for the heaviest hypothesis.
auto ofEvidence(double InMapEvidence::*part)
{
  return ofBelief([part](const TrackingClaim& claim) { return claim.evidence.*part; });
}

/// The cells of an event, empty where it never came.
auto ofEvent(std::optional<WakeupEvent> Wakeup::*event)
{
  return [event](const Wakeup& run)
  {
    const WakeupEvent at = (run.*event).value_or(WakeupEvent{kNone, kNone});
    return Written{{}, {fixedNumber(at.metres, 3), fixedNumber(at.seconds, 3)}};
  };
}
}  // namespace

const Columns<WakeupStep>& stepColumns()
{
  using C = Column<WakeupStep>;
  using S = WakeupStep;
  using T = TrackingClaim;
  static const Columns<S> kColumns = {
      C("step", &S::step, "of the log"),
      C("travelled_m", &S::travelled, "since the start"),
      C("seconds", &S::seconds, "since the start, by the log"),
      C("kidnapped", &S::kidnapped, "the robot has been carried"),
      C("confident", [](const S& step) { return step.claim.confident; }),
      C(
          "x,y,phi",
          [](const S& step)
          { return step.claim.has_pose ? std::optional(step.claim.pose) : std::nullopt; },
          "the claimed pose [m, rad], in the map", 4),
      C("error_m,error_deg", &S::error, "of it; empty without truth", 4),
      C("claim", &S::judged, "a confident claim, judged"),
      C("verdict", ofBelief(&T::verdict)),
      C("hypotheses", ofBelief(&T::hypotheses), "being tracked"),
      C("weight", ofBelief([](const T& claim) { return claim.weights[0]; }),
        "of the heaviest hypothesis", 5),
      C("second_weight", ofBelief([](const T& claim) { return claim.weights[1]; }),
        "of the next one", 5),
      C("elsewhere", ofBelief(&T::elsewhere), "weight of all other poses", 5),
      C("kappa", ofEvidence(&InMapEvidence::relocations), "log-odds from relocations, (8.7)"),
      C("gamma", ofEvidence(&InMapEvidence::way), "log-odds from the way driven, (8.21)"),
      C("unexplained", ofEvidence(&InMapEvidence::unexplained),
        "share of the mapped area that the heaviest hypothesis leaves unexplained", 4),
      C("cells", ofEvidence(&InMapEvidence::cells), "mapped area that it has seen, of 0.5 m", 1),
      C("followed_m", ofEvidence(&InMapEvidence::followed), "driven since it was proposed"),
      C("searched_m", ofEvidence(&InMapEvidence::searched), "driven unlocalized before that"),
      C("score", ofEvidence(&InMapEvidence::score), "of it at the last scan", 4),
      C(
          "reliability", [](const S& step) { return step.claim.reliability; },
          "of the last scan at the pose; of mcl-best, MRPT's, while its cloud is tight", 4),
      C("tracked", &S::tracked, "one of the four heaviest hypotheses is right"),
      C(
          "nees", [](const S& step) { return step.claim.belief ? step.nees : kNone; },
          "squared normalised error, 3 degrees of freedom"),
      C("mapped", &S::mapped, "the truth lies within 1 m of a mapped pose"),
      C("time_ms", &S::time_ms, "CPU time")};
  return kColumns;
}

const Columns<Wakeup>& runColumns()
{
  using C = Column<Wakeup>;
  static const Columns<Wakeup> kColumns = {
      C("start", &Wakeup::start, "step of the log, or number of the drive"),
      C("group", &Wakeup::group, "kind of the simulated world"),
      C("steps", [](const Wakeup& run) { return run.steps.size(); }),
      C("right_at_end", &Wakeup::right_at_end),
      C("settled_after_m,settled_after_s", ofEvent(&Wakeup::settled_after),
        "empty where it never settles"),
      C("wrong_steps", &Wakeup::wrong_steps, "off the mapped area too"),
      C("wrong_episodes", &Wakeup::wrong_episodes, "unbroken stretches of them"),
      C("noticed_after_m,noticed_after_s", ofEvent(&Wakeup::noticed_after), "after a kidnapping")};
  return kColumns;
}

std::optional<std::size_t> judgedStep(const Wakeup& run)
{
  for (std::size_t i = run.steps.size(); i > 0; --i)
  {
    if (run.steps[i - 1].mapped && !std::isnan(run.steps[i - 1].error.distance)) return i - 1;
  }
  return std::nullopt;
}

bool isFailedRun(const Wakeup& run)
{
  return run.wrong_steps > 0 || (judgedStep(run) && !run.right_at_end);
}

void judgeRun(Wakeup& run)
{
  const Steps& steps = run.steps;
  const std::size_t from = run.kidnapped_at;  // 0, the start, without a kidnapping
  std::size_t settled = settledAt(steps);
  if (run.kidnapped_at > 0)
  {
    const std::size_t noticed = noticedAt(run);
    run.noticed_after = eventAt(steps, from, noticed);
    settled = std::max(settled, noticed);
  }
  run.settled_after = eventAt(steps, from, settled);
  run.cpu_to_settled = 0;
  for (std::size_t i = from; i < steps.size() && i <= settled; ++i)
  {
    run.cpu_to_settled += 1e-3 * steps[i].time_ms;
  }
  countWrong(run);
  const auto judged = judgedStep(run);
  run.right_at_end = judged && steps[*judged].judged == Claim::right;
}
}  // namespace sigloc
