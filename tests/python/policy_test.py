# SPDX-FileCopyrightText: 2026 the sigloc authors
# SPDX-License-Identifier: BSD-3-Clause
"""When a pose may be used: the policy on a drive through the office."""
import pathlib

import numpy as np
import pytest

import sigloc

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def drive():
    """Times, answers, motions and what the scan alone tells of 60 steps."""
    localizer = sigloc.Localizer(sigloc.Map.load(ROOT / "maps/office.simplemap"))
    tracker = sigloc.Tracker(localizer)
    rows = []
    for step in sigloc.Log(ROOT / "rawlogs/office.rawlog"):
        answer = tracker.step(step.observations, step.motion, step.motion_covariance)
        rows.append((step.time, answer, step.motion, localizer.localize(step.observations)))
        if len(rows) == 60:
            return rows


def test_a_pose_is_given_out_once_it_is_confirmed(drive):
    policy = sigloc.Policy(confirm_steps=5, confirm_time=0.0)
    asked = []
    decisions = []
    for time, answer, motion, alone in drive:
        decisions.append(policy.update(time, answer, motion, localize_alone=lambda a=alone: asked.append(1) or a))
    known = [d.state for d in decisions].index("known")
    verdicts = [answer.verdict for _, answer, _, _ in drive]
    assert verdicts[known - 4 : known + 1] == [sigloc.Verdict.LOCALIZED] * 5
    assert decisions[known].announce and len(asked) == 1
    for decision, (_, answer, _, _) in zip(decisions, drive):
        assert (decision.pose is not None) == (decision.state == "known") == (decision.covariance is not None)
        if decision.pose is not None:
            assert np.array_equal(decision.pose, answer.hypotheses[0].pose)
            assert np.array_equal(decision.covariance, answer.hypotheses[0].covariance)
        assert decision.message and not decision.alarm


def test_a_filter_that_has_the_pose_is_left_alone(drive):
    policy = sigloc.Policy()
    for time, answer, motion, _ in drive:
        assert not policy.update(time, answer, motion, answer.hypotheses[0].pose).announce


def test_a_search_that_finds_nothing_is_given_up():
    policy = sigloc.Policy(attempt_time=1.0, max_attempts=2)
    blind = sigloc.Scan(np.full(180, np.inf), 0.0, 0.02)
    lost = sigloc.Localizer(sigloc.Map.load(ROOT / "maps/office.simplemap")).localize(blind)
    decisions = [policy.update(float(k), lost) for k in range(4)]
    assert [d.restart for d in decisions] == [False, True, False, False]
    assert [d.alarm for d in decisions] == [False, False, True, True]
    policy.request_restart()
    assert policy.update(4.0, lost).restart


def test_what_the_scan_alone_raises_comes_through(drive):
    policy = sigloc.Policy(confirm_steps=1, confirm_time=0.0)
    time, answer, motion, _ = drive[-1]
    with pytest.raises(ZeroDivisionError):
        policy.update(time, answer, motion, None, lambda: 1 / 0)


def test_bad_values_are_refused(drive):
    _, answer, _, _ = drive[0]
    policy = sigloc.Policy()
    policy.update(5.0, answer)
    for time in (4.0, float("nan")):
        with pytest.raises(ValueError, match="time"):
            policy.update(time, answer)
    with pytest.raises(ValueError, match="motion"):
        policy.update(6.0, answer, [1.0, 2.0])
    with pytest.raises(ValueError, match="confirm_steps"):
        sigloc.Policy(confirm_steps=0)
    with pytest.raises(TypeError, match="did you mean 'confirm_steps'"):
        sigloc.Policy(confirm_stebs=1)
