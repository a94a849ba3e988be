"""Random games against brute force: nothing is found, and each kind of lie is."""

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from msgspec import structs

from asp.language import Action, Literal
from benchmarks import games
from benchmarks.games import fine
from benchmarks.games.__main__ import main
from benchmarks.games.drawing import SHARES, draw
from benchmarks.games.playing import MakeRobot, Story, play, shortened
from testbed.experiment.robots import HUMAN, ROBOTS, make_robot
from testbed.protocol import Decision, Event, Percept, Task, Trace

Lie = Callable[[Decision], Decision]
MOST_GAMES = 40


class Liar:
    """An intentional robot that does not say what it thinks."""

    def __init__(self, lie: Lie, robot: str = "intentional") -> None:
        self._robot = make_robot(robot)
        self._lie = lie

    def begin(self, task: Task) -> None:
        self._robot.begin(task)

    def act(self, percept: Percept) -> Decision:
        return self._lie(self._robot.act(percept))


def _retold(change: Callable[[Trace], dict[str, Any]]) -> Lie:
    def lie(decision: Decision) -> Decision:
        trace = structs.replace(decision.trace, **change(decision.trace))
        return structs.replace(decision, trace=trace)

    return lie


def _explaining(change: Callable[[list[Event]], list[Event]]) -> Lie:
    def changed(trace: Trace) -> dict[str, Any]:
        told = trace.explanation
        if told is None or not told.unobserved:
            return {}
        events = change(list(told.unobserved))
        return {"explanation": structs.replace(told, unobserved=events)}

    return _retold(changed)


def _planning(change: Callable[[list[Action]], list[Action]]) -> Lie:
    return _retold(
        lambda trace: (
            {"plan": change(list(trace.plan))}
            if trace.mental is not None and trace.mental.name == "start"
            else {}
        )
    )


def _locked(trace: Trace) -> dict[str, Any]:
    lock = Literal.parse("locked(library)")
    rest = [fluent for fluent in trace.belief if fluent != lock]
    return {"belief": rest if lock in trace.belief else sorted([*trace.belief, lock])}


def _other_no_plan(trace: Trace) -> dict[str, Any]:
    others = {"out of reach": "beyond the limit", "beyond the limit": "out of reach"}
    return {} if trace.no_plan is None else {"no_plan": others[trace.no_plan]}


LIES: dict[str, tuple[str, Lie]] = {
    "the lock is otherwise": ("belief", _retold(_locked)),
    "nothing happened": ("explanation", _explaining(lambda _: [])),
    "one more thing happened": (
        "explanation",
        _explaining(
            lambda told: [
                *told,
                Event(step=told[-1].step + 1, action=Literal.parse("exo_lock(library)")),
                Event(step=told[-1].step, action=Literal.parse("exo_lock(library)")),
            ]
        ),
    ),
    "there is no other explanation": (
        "explanation",
        _retold(lambda _: {"alternatives": [], "more_alternatives": False}),
    ),
    "the plan has a gap": ("plan", _planning(lambda plan: plan[:-1])),
    "the plan goes on": ("plan", _planning(lambda plan: [*plan, plan[-1]])),
    "there is another reason for no plan": ("plan", _retold(_other_no_plan)),
    "the goal is believed otherwise": (
        "reason",
        lambda decision: structs.replace(decision, believes_goal=not decision.believes_goal),
    ),
    "the plan breaks later": (
        "reason",
        _retold(
            lambda trace: {} if trace.futile_at is None else {"futile_at": trace.futile_at + 1}
        ),
    ),
    "the contrary was seen": (
        "reason",
        _retold(
            lambda trace: {
                "contradictions": [
                    structs.replace(each, observed=each.believed, believed=each.observed)
                    for each in trace.contradictions
                ]
            }
        ),
    ),
}


def test_nothing_is_found_in_a_sample_of_games() -> None:
    tally = games.run(range(games.GAMES["small"]))
    assert [str(story) for story in tally.found] == []
    assert set(tally.counts) <= set(SHARES)
    total = tally.rows[-1]
    for key in ("explanations", "plans", "stopped", "given_up"):
        assert int(str(total[key])) > 0, key


def test_every_robot_of_ours_plays_that_acts_at_the_coarse_resolution() -> None:
    ours = ROBOTS.built_in.keys() - {HUMAN}
    able = {name: ROBOTS.find(name).capabilities.resolutions for name in ours}
    assert set(SHARES) == {name for name, resolutions in able.items() if "coarse" in resolutions}


def test_nothing_is_found_at_the_fine_resolution() -> None:
    assert [*fine.found(range(fine.GAMES["small"]))] == []


def test_a_lie_is_caught_at_the_fine_resolution() -> None:
    games_of_liar = (
        fine.play(seed, Liar(LIES["nothing happened"][1])) for seed in range(MOST_GAMES)
    )
    assert next(filter(None, games_of_liar))[0].check == "explanation"


@pytest.mark.parametrize(
    ("lie", "robot"),
    [
        *((lie, "intentional") for lie in LIES),
        ("the lock is otherwise", "intentional-checking"),
        ("nothing happened", "intentional-checking"),
        ("the plan has a gap", "intentional-checking"),
        ("the goal is believed otherwise", "intentional-checking"),
    ],
)
def test_a_lie_is_caught_by_the_check_that_is_there_for_it(lie: str, robot: str) -> None:
    check, change = LIES[lie]
    found = next(
        story for story in _stories(robot, lambda name: Liar(change, name)) if story.faults
    )
    assert found.faults[0].check == check


def test_a_robot_that_is_not_sure_of_its_goal_is_caught_finishing() -> None:
    stories = _stories("intentional-checking", lambda _: make_robot("intentional"))
    faults = (s.faults for s in stories if s.faults and s.moments[-1].decision.action == "finish")
    assert next(faults)[0].check == "reason"


def _stories(robot: str, make: MakeRobot) -> Iterator[Story]:
    return (play(draw(seed, {robot: 1}), make) for seed in range(MOST_GAMES))


def test_the_story_of_a_fault_is_made_shorter_and_can_be_played_again() -> None:
    def make(_: str) -> Liar:
        return Liar(LIES["nothing happened"][1])

    found = next(
        story
        for story in _stories("intentional", make)
        if story.faults and len(story.game.script) > 1
    )
    short = shortened(found, make)
    assert len(short.game.script) < len(found.game.script)
    assert len(short.moments) <= len(found.moments)
    assert play(short.game, make).faults == short.faults


def test_a_game_follows_from_its_seed() -> None:
    assert draw(7) == draw(7)
    assert draw(7) != draw(8)


def test_the_command_says_by_its_exit_code_whether_anything_is_found(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    seed = next(n for n in range(MOST_GAMES) if draw(n).robot == "intentional")
    honest, lie = games.run, LIES["the lock is otherwise"][1]
    assert main(["1", "--seed", f"{seed}"]) == 0
    monkeypatch.setattr(games, "run", lambda seeds: honest(seeds, lambda _: Liar(lie)))
    capsys.readouterr()
    assert main(["1", "--seed", f"{seed}"]) == 1
    assert f"seed={seed}" in capsys.readouterr().out


def test_a_wrong_number_of_games_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["0"])
    assert stopped.value.code == 2
    assert "N: 0" in capsys.readouterr().err
