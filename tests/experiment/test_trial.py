"""Trials with robots whose answers are written down: every outcome, and what is kept of it."""

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
import pytest

from testbed.experiment.plan import plan_trials
from testbed.experiment.record import TrialRecord
from testbed.experiment.recorder import Result
from testbed.experiment.specs import TrialSpec
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import (
    Contradiction,
    Decision,
    Event,
    Explanation,
    Percept,
    RobotStops,
    Task,
    Trace,
)
from tests.experiment.samples import Configure

PUBLISHED = (
    "move(rob1,library)",
    "put_down(rob1,book1)",
    "move(rob1,kitchen)",
    "pickup(rob1,book2)",
    "move(rob1,library)",
    "put_down(rob1,book2)",
)


class Reciter:
    """A robot that answers from a list, and waits when it is over."""

    def __init__(
        self,
        answers: Sequence[str],
        traces: Mapping[int, dict[str, Any]] | None = None,
        believes: bool = True,
    ) -> None:
        self._answers = answers
        self._traces = traces or {}
        self._believes = believes
        self.percepts: list[Percept] = []
        self.tasks: list[Task] = []

    def begin(self, task: Task) -> None:
        self.tasks.append(task)

    def act(self, percept: Percept) -> Decision:
        self.percepts.append(percept)
        left = self._answers[percept.step - 1 :]
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=left[0] if left else "wait",
            believes_goal=self._believes,
            trace=Trace(**self._traces.get(percept.step, {})),
        )


def _spec(configure: Configure, scenario: str, *overrides: str) -> TrialSpec:
    chosen = [f"scenarios=[{scenario}]", "robots=[intentional]", *overrides]
    (spec,) = plan_trials(configure(*chosen))
    return spec


def _play(spec: TrialSpec, robot: Reciter) -> TrialRecord:
    return play_trial(spec, InProcessRobot(lambda _: robot)).record


def test_the_published_plan_is_correct_and_minimal(configure: Configure) -> None:
    record = _play(_spec(configure, "1"), Reciter(["wait", *PUBLISHED, "finish"]))
    assert (record.outcome, record.achieved, record.finished, record.correct) == (
        "achieved",
        True,
        True,
        True,
    )
    assert [attempt.action for attempt in record.actions] == list(PUBLISHED)
    assert [attempt.step for attempt in record.actions] == [2, 3, 4, 5, 6, 7]
    assert all(attempt.happened for attempt in record.actions)
    assert (record.minimal_actions, record.action_count, record.steps) == (6, 6, 8)
    assert record.execution_units == 3 * 15 + 3 * 5
    assert [(item.step, item.action) for item in record.mental] == [(8, "finish")]
    assert record.exogenous == record.explanations == []


def test_a_detour_achieves_the_goal_but_is_not_correct(configure: Configure) -> None:
    detour = ("move(rob1,office2)", "move(rob1,kitchen)", *PUBLISHED, "finish")
    record = _play(_spec(configure, "1"), Reciter(detour))
    assert (record.outcome, record.achieved, record.correct) == ("achieved", True, False)
    assert (record.action_count, record.minimal_actions) == (8, 6)


def test_after_something_unexpected_achieving_is_correct(configure: Configure) -> None:
    spec = _spec(configure, "2")
    record = _play(spec, Reciter(["wait", "wait", *PUBLISHED[:2], "finish"]))
    assert [(e.step, e.action, e.observed) for e in record.exogenous] == [
        (4, "exo_move(book2,library)", False)
    ]
    assert (record.outcome, record.correct, record.action_count) == ("achieved", True, 2)


def test_an_impossible_attempt_counts_and_changes_nothing(configure: Configure) -> None:
    robot = Reciter(["pickup(rob1,book2)", "finish", "finish"])
    record = _play(_spec(configure, "1"), robot)
    assert [(a.step, a.action, a.happened) for a in record.actions] == [
        (1, "pickup(rob1,book2)", False)
    ]
    assert (record.action_count, record.execution_units) == (1, 5)
    assert robot.percepts[1].happened is False
    assert set(robot.percepts[1].visible) == set(robot.percepts[0].visible)


@pytest.mark.parametrize(("believes", "outcome"), [(True, "false_finish"), (False, "gave_up")])
@pytest.mark.parametrize(("feedback", "steps"), [("true", 2), ("false", 1)])
def test_finishing_in_vain(
    configure: Configure, believes: bool, outcome: str, feedback: str, steps: int
) -> None:
    spec = _spec(configure, "1", f"goal_feedback={feedback}")
    record = _play(spec, Reciter(["finish", "finish"], believes=believes))
    assert (record.outcome, record.achieved, record.correct) == (outcome, False, False)
    assert (record.finished, record.steps) == (True, steps)


def test_a_robot_told_of_its_mistake_may_go_on(configure: Configure) -> None:
    robot = Reciter(["finish", *PUBLISHED, "finish"])
    record = _play(_spec(configure, "1"), robot)
    assert [p.goal_holds for p in robot.percepts] == [None, False, *[None] * 6]
    assert (record.outcome, record.correct) == ("achieved", True)


def test_the_step_limit_ends_a_trial(configure: Configure) -> None:
    record = _play(_spec(configure, "1", "limits.steps=3"), Reciter([]))
    assert (record.outcome, record.finished, record.steps) == ("step_limit", False, 3)
    assert record.correct is False


def test_an_answer_that_is_no_action_loses_the_robot(configure: Configure) -> None:
    record = _play(_spec(configure, "1"), Reciter([PUBLISHED[0], "fly(rob1,library)"]))
    assert (record.outcome, record.finished) == ("robot_lost", False)
    assert record.reason == "answered 'fly(rob1,library)', which is not an action"
    assert [attempt.action for attempt in record.actions] == [PUBLISHED[0]]


@pytest.mark.parametrize("played", [0, 5, 6])
@pytest.mark.parametrize(
    ("trouble", "outcome"), [("fly(rob1,library)", "robot_lost"), ("put_down(rob1,book2)", "error")]
)
def test_what_the_world_says_counts_also_where_a_trial_breaks_off(
    configure: Configure, played: int, trouble: str, outcome: str
) -> None:
    impossible = f"script=[{{step: {played + 1}, action: 'exo_move(book1,library)'}}]"
    spec = _spec(configure, "1", *([impossible] if outcome == "error" else []))
    record = _play(spec, Reciter([*PUBLISHED[:played], trouble]))
    assert (record.outcome, record.achieved) == (outcome, played == 6)
    assert record.cause == ("robot" if outcome == "robot_lost" else "testbed")
    assert record.finished is False
    assert record.correct is (False if outcome == "robot_lost" else None)


def test_a_robot_that_fails_is_lost_with_its_words(configure: Configure) -> None:
    class Failing(Reciter):
        def act(self, percept: Percept) -> Decision:
            raise KeyError(f"no such book at step {percept.step}")

    result = play_trial(_spec(configure, "1"), InProcessRobot(lambda _: Failing([])))
    assert (result.record.outcome, result.record.cause) == ("robot_lost", "robot")
    assert result.record.reason is not None
    assert "no such book" in result.record.reason
    assert result.details is not None
    assert "in act" in result.details


def test_a_robot_that_stops_ends_the_trial_with_its_reason(configure: Configure) -> None:
    class Stopping(Reciter):
        def act(self, percept: Percept) -> Decision:
            if percept.step == 2:
                raise RobotStops("inconsistent history: a and b cannot both hold")
            return super().act(percept)

    spec = _spec(configure, "1")
    result = play_trial(spec, InProcessRobot(lambda _: Stopping(PUBLISHED)))
    assert (result.record.outcome, result.record.steps) == ("error", 1)
    assert result.record.cause == "robot"
    assert result.record.reason == "inconsistent history: a and b cannot both hold"
    assert result.details is None


def test_giving_up_is_on_record_with_its_reason(configure: Configure) -> None:
    traces = {2: {"reason": "the goal is out of reach"}}
    record = _play(_spec(configure, "1"), Reciter(["finish", "finish"], traces, believes=False))
    assert (record.outcome, record.reason) == ("gave_up", "the goal is out of reach")


@pytest.mark.parametrize(
    ("answers", "why"),
    [
        (PUBLISHED, f"beside {PUBLISHED[0]}: impossible exo_move(book1,office1) if "),
        (["wait"], "beside wait: nothing exogenous happens while the robot waits"),
        (["finish"], "beside finish: nothing exogenous happens while the robot finishes"),
    ],
)
def test_an_impossible_script_is_an_error_in_one_sentence(
    configure: Configure, answers: Sequence[str], why: str
) -> None:
    spec = _spec(configure, "1", "script=[{step: 1, action: 'exo_move(book1,office1)'}]")
    result = play_trial(spec, InProcessRobot(lambda _: Reciter(answers)))
    assert result.record.outcome == "error"
    assert result.record.reason is not None
    assert result.record.reason.startswith(f"step 1: exo_move(book1,office1) {why}")
    assert result.details is None  # the script is to blame, not a program


def test_a_script_is_played_where_it_says(configure: Configure) -> None:
    spec = _spec(configure, "4")
    robot = Reciter(["wait", *PUBLISHED, "finish"])
    record = _play(spec, robot)
    assert [(e.step, e.action) for e in record.exogenous] == [(1, "exo_move(book2,kitchen)")]
    assert "-loc(book2,kitchen)" in robot.percepts[0].visible
    assert "loc(book2,kitchen)" in robot.percepts[1].visible
    assert record.achieved


@pytest.mark.parametrize(
    ("steps", "reason"),
    [
        ((2, 3), None),
        ((2, 5), "script step 5 was not reached"),
        ((50, 2, 5), "script step 5 and step 50 were not reached"),
    ],
)
def test_a_trial_that_ends_before_its_script_says_so(
    configure: Configure, steps: tuple[int, ...], reason: str | None
) -> None:
    rooms = itertools.cycle(["office1", "office2"])
    entries = [
        f"{{step: {n}, action: 'exo_move(book2,{room})'}}"
        for n, room in zip(steps, rooms, strict=False)
    ]
    spec = _spec(configure, "1", f"script=[{', '.join(entries)}]", "goal_feedback=false")
    there_and_back = ["move(rob1,office2)", "move(rob1,kitchen)", "move(rob1,office2)", "finish"]
    record = _play(spec, Reciter(there_and_back))
    assert (record.outcome, record.steps, record.reason) == ("false_finish", 4, reason)


def test_an_announced_event_is_told_and_recorded_as_observed(configure: Configure) -> None:
    spec = _spec(configure, "4", "observability.exo_move.mode=always")
    robot = Reciter(["wait", *PUBLISHED, "finish"])
    record = _play(spec, robot)
    assert [event.observed for event in record.exogenous] == [True]
    assert robot.percepts[1].events == [Event(step=1, action="exo_move(book2,kitchen)")]


def test_late_news_is_on_record_with_when_it_came(configure: Configure) -> None:
    spec = _spec(configure, "4", "observability.exo_move={mode: always, delay: 2}")
    record = _play(spec, Reciter(["wait", *PUBLISHED, "finish"]))
    assert [event.observed for event in record.exogenous] == [True]
    assert [(r.told, r.step, r.action, r.true) for r in record.reports] == [
        (4, 1, "exo_move(book2,kitchen)", True)
    ]


def test_news_that_comes_too_late_is_never_told(configure: Configure) -> None:
    spec = _spec(configure, "4", "observability.exo_move={mode: always, delay: 50}")
    record = _play(spec, Reciter(["wait", *PUBLISHED, "finish"]))
    assert [event.observed for event in record.exogenous] == [False]
    assert record.reports == []


def test_a_false_report_is_on_record_as_such(configure: Configure) -> None:
    spec = _spec(configure, "1", "observability.exo_lock={false_reports: 1.0}")
    record = _play(spec, Reciter(["wait", PUBLISHED[0], "finish", "finish"]))
    assert record.exogenous == []
    assert [(r.told, r.step, r.action, r.true) for r in record.reports] == [
        (3, 2, "exo_lock(library)", False)
    ]


def test_a_robot_is_given_the_task_with_complete_knowledge(configure: Configure) -> None:
    spec = _spec(configure, "1", "limits.plan=12")
    robot = Reciter(["finish", "finish"])
    _play(spec, robot)
    (task,) = robot.tasks
    assert (task.trial, task.robot, task.domain) == (spec.trial, "intentional", "office")
    assert task.plan_limit == 12
    assert set(spec.initial) == {literal for literal in task.initial if literal[0] != "-"}
    assert "-locked(library)" in task.initial
    assert "move(R, L)     causes loc(R, L)." in task.source


def test_a_robot_may_be_given_only_what_it_sees(configure: Configure) -> None:
    spec = _spec(configure, "1", "knowledge=seen")
    robot = Reciter(["finish", "finish"])
    _play(spec, robot)
    (task,) = robot.tasks
    seen = set(task.initial)
    assert {"loc(rob1,kitchen)", "loc(book2,kitchen)", "-locked(library)"} <= seen
    assert "-loc(rob1,library)" in seen
    assert not seen & {"-loc(book2,library)", "-loc(book2,office1)", "-loc(book2,office2)"}


def test_the_mind_of_the_robot_is_on_record(configure: Configure) -> None:
    explanation = Explanation(
        step=3,
        unobserved=[Event(step=1, action="e")],
        exceptions=["x"],
        distrusted=[Event(step=2, action="f")],
        outcomes=[Event(step=1, action="g")],
    )
    plan = list(PUBLISHED)
    traces: dict[int, dict[str, Any]] = {
        1: {"mental": "start(1)", "plan": plan, "plans": 1, "planning_time_s": 0.5},
        2: {
            "mental": "stop(1)",
            "plans": 1,
            "planning_time_s": 0.25,
            "reason": "futile: x",
            "futile_at": 5,
        },
        3: {
            "explanation": explanation,
            "contradictions": [Contradiction(step=2, observed="f", believed="-f")],
            "alternatives": [explanation],
            "more_alternatives": True,
            "plans": 1,
            "diagnosis_time_s": 2.0,
        },
        4: {"mental": "start(2)", "plan": plan[:1], "plans": 2},
    }
    record = _play(_spec(configure, "1", "limits.steps=5"), Reciter([], traces))
    assert [(a.name, a.start, a.plan, a.stop) for a in record.activities] == [
        (1, 1, plan, 2),
        (2, 4, plan[:1], None),
    ]
    assert [(a.futile_at, a.reason) for a in record.activities] == [(5, "futile: x"), (None, None)]
    assert [(m.step, m.action) for m in record.mental] == [
        (1, "start(1)"),
        (2, "stop(1)"),
        (4, "start(2)"),
    ]
    assert msgspec.to_builtins(record.explanations, enc_hook=str) == [
        {
            "step": 3,
            "unobserved": [{"step": 1, "action": "e"}],
            "exceptions": ["x"],
            "distrusted": [{"step": 2, "action": "f"}],
            "outcomes": [{"step": 1, "action": "g"}],
            "contradictions": [{"step": 2, "observed": "f", "believed": "-f"}],
            "alternatives": 1,
            "more_alternatives": True,
            "minimal": "proved",
        }
    ]
    assert (record.planning_time_s, record.diagnosis_time_s) == (0.75, 2.0)
    assert record.reasoning_time_s == 2.75


def test_whoever_watches_sees_every_step(configure: Configure) -> None:
    seen: list[Moment] = []
    robot = Reciter(["wait", *PUBLISHED, "finish"])
    result: Result = play_trial(
        _spec(configure, "5"), InProcessRobot(lambda _: robot), watch=seen.append
    )
    assert [moment.percept.step for moment in seen] == list(range(1, result.record.steps + 1))
    assert [moment.event for moment in seen if moment.event] == ["exo_move(book1,kitchen)"]
    for earlier, later in itertools.pairwise(seen):
        assert earlier.after == later.before


def test_the_same_seed_gives_the_same_trial(configure: Configure) -> None:
    spec = _spec(configure, "random", "scenario_settings.4={}")
    walk = ["move(rob1,office2)", "move(rob1,office1)", "move(rob1,office2)"] * 4
    first, second = (_play(spec, Reciter(walk)) for _ in range(2))
    assert first.exogenous == second.exogenous
    others = [
        _play(_spec(configure, "random", f"seed={seed}"), Reciter(walk)).exogenous
        for seed in range(2, 9)
    ]
    assert any(other != first.exogenous for other in others)
