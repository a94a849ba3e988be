"""The triggers of the scenarios, checked against a table of what fires when."""

import pytest

from agents.adversary import AdversaryView, Game, Script, Triggered
from asp import load_description
from asp.language import Literal
from testbed.environment import Core, Rules
from testbed.protocol import FINISH, NONE, WAIT
from testbed.world import world_of

BOOKS, ROOMS = ("book1", "book2"), ("kitchen", "office1", "office2", "library")
SCENARIOS = ("2", "3", "4", "5", "6", "random")
WORLD = world_of(load_description("office"))


def triggered(scenario: str) -> Triggered:
    description = WORLD.description
    actions = description.exogenous_actions
    game = Game(scenario=scenario, goal=(), exogenous_actions=actions, description=description)
    return Triggered(game, Triggered.Options())


def view(core: Core, robot_action: str) -> AdversaryView:
    true = frozenset(core.world.true_atoms(core.situation.state))
    action = Literal.parse(robot_action)
    return AdversaryView(core.situation.step, true, action, core.events(action))


def asked(scenario: str, initial: list[str], action: str, seed: int = 0) -> str:
    """The adversary's answer beside the robot's first action."""
    core = Core(WORLD, Rules(goal=()), ())
    core.reset(seed=0, initial=initial)
    adversary = triggered(scenario)
    adversary.reset(seed)
    return adversary.act(view(core, action))


def answers(scenario: str, initial: list[str], action: str) -> set[str]:
    """Every answer over many seeds."""
    return {asked(scenario, initial, action, seed) for seed in range(60)}


HOLDS_1 = ["loc(rob1,kitchen)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]
DELIVERS_1 = ["loc(rob1,library)", "in_hand(rob1,book1)", "loc(book2,kitchen)"]
DELIVERS_2 = ["loc(rob1,library)", "in_hand(rob1,book2)", "loc(book1,library)"]
EMPTY_HANDED = ["loc(rob1,office2)", "loc(book1,kitchen)", "loc(book2,office1)"]


def moves(book: str, *rooms: str) -> set[str]:
    return {f"exo_move({book},{room})" for room in rooms}


@pytest.mark.parametrize(
    ("scenario", "initial", "action", "expected"),
    [
        ("2", DELIVERS_1, "put_down(rob1,book1)", moves("book2", "library")),
        ("2", HOLDS_1, "move(rob1,library)", {NONE}),
        ("2", ["locked(library)", *HOLDS_1], "put_down(rob1,book1)", {NONE}),
        # Of two books outside, the first that can be moved: book1 is in the hand.
        ("2", HOLDS_1, "put_down(rob1,book1)", moves("book2", "library")),
        # Only book2 is not in the hand, and it is in the destination only on the way to it.
        ("3", HOLDS_1, "put_down(rob1,book1)", moves("book2", "office1", "office2", "library")),
        # The room is drawn before it is known that it is locked.
        (
            "3",
            ["locked(library)", *HOLDS_1],
            "put_down(rob1,book1)",
            {NONE, *moves("book2", *ROOMS[1:3])},
        ),
        ("3", HOLDS_1, "move(rob1,library)", {NONE}),
        ("3", HOLDS_1, "move(rob1,office2)", {NONE}),
        # A book is drawn first: if it is the one that is elsewhere, nothing happens this time.
        (
            "3",
            EMPTY_HANDED,
            "move(rob1,kitchen)",
            {NONE, *moves("book1", "office1", "office2", "library")},
        ),
        ("3", EMPTY_HANDED, "unlock(rob1,library)", {NONE}),
        # The book that is being picked up is not drawn.
        (
            "3",
            ["loc(rob1,kitchen)", "loc(book1,kitchen)", "loc(book2,kitchen)"],
            "pickup(rob1,book1)",
            moves("book2", "office1", "office2", "library"),
        ),
        ("4", HOLDS_1, "move(rob1,office2)", moves("book2", "office2")),
        ("4", HOLDS_1, "move(rob1,library)", {NONE}),
        ("4", EMPTY_HANDED, "move(rob1,kitchen)", {NONE, *moves("book2", "kitchen")}),
        (
            "4",
            ["loc(rob1,office2)", "loc(book1,library)", "loc(book2,library)", "locked(library)"],
            "move(rob1,kitchen)",
            {NONE},
        ),
        ("5", DELIVERS_2, "put_down(rob1,book2)", moves("book1", "kitchen")),
        ("5", DELIVERS_2, "move(rob1,kitchen)", moves("book1", "kitchen")),
        ("5", [*DELIVERS_2, "locked(library)"], "put_down(rob1,book2)", {NONE}),
        ("5", DELIVERS_1, "put_down(rob1,book1)", {NONE}),
        ("6", HOLDS_1, "move(rob1,library)", {"exo_lock(library)"}),
        ("6", HOLDS_1, "put_down(rob1,book1)", {"exo_lock(library)"}),
        ("6", [*HOLDS_1, "locked(library)"], "move(rob1,office2)", {NONE}),
        ("1", HOLDS_1, "move(rob1,library)", {NONE}),
        # Only failing the coin comes to nothing: book1, which is in the hand, is not drawn.
        (
            "random",
            HOLDS_1,
            "move(rob1,library)",
            {NONE, "exo_lock(library)", *moves("book2", "office1", "office2", "library")},
        ),
    ],
)
def test_the_table(scenario: str, initial: list[str], action: str, expected: set[str]) -> None:
    assert answers(scenario, initial, action) == expected


def waited(scenario: str, thinking: bool, robot_action: str = WAIT) -> set[str]:
    """Every answer over many seeds beside a robot that thinks in the library."""
    core = Core(WORLD, Rules(goal=(), exogenous_while_thinking=thinking), ())
    core.reset(seed=0, initial=DELIVERS_2)
    adversary, found = triggered(scenario), set()
    for seed in range(60):
        adversary.reset(seed)
        found.add(adversary.act(view(core, robot_action)))
    return found


@pytest.mark.parametrize(
    ("scenario", "expected"),
    [
        # These need an action of the robot, of which waiting is none.
        ("2", {NONE}),
        ("3", {NONE}),
        ("4", {NONE}),
        # These fire upon any.
        ("5", moves("book1", "kitchen")),
        ("6", {"exo_lock(library)"}),
        ("random", {NONE, "exo_lock(library)", *moves("book1", *ROOMS[:3])}),
    ],
)
def test_a_thinking_robot_is_open_to_triggers_upon_any(scenario: str, expected: set[str]) -> None:
    assert waited(scenario, thinking=True) == expected


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_nothing_happens_at_steps_that_the_rules_close(scenario: str) -> None:
    assert waited(scenario, thinking=False) == {NONE}
    assert waited(scenario, thinking=True, robot_action=FINISH) == {NONE}


def test_a_closed_step_draws_nothing() -> None:
    core = Core(WORLD, Rules(goal=()), ())
    core.reset(seed=0, initial=DELIVERS_1)
    adversary = triggered("random")
    for seed in range(40):
        adversary.reset(seed)
        assert adversary.act(view(core, WAIT)) == NONE
        after_waiting = adversary.act(view(core, "move(rob1,kitchen)"))
        adversary.reset(seed)
        assert adversary.act(view(core, "move(rob1,kitchen)")) == after_waiting


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_at_most_one_legal_event_a_trial_and_the_same_for_the_same_seed(scenario: str) -> None:
    core = Core(WORLD, Rules(goal=(), steps=30), WORLD.initial_states())
    fired = 0
    for seed in range(60):
        played = [walk(core, triggered(scenario), seed) for _ in range(2)]
        assert played[0] == played[1]
        assert len(played[0]) <= 1
        fired += len(played[0])
    assert fired > 0


def walk(core: Core, adversary: Triggered, seed: int) -> list[tuple[int, str]]:
    """The events beside a walk of the robot; `advance` refuses an illegal one."""
    core.reset(seed)
    adversary.reset(seed)
    events = []
    while core.situation.ending is None:
        physical = core.robot_actions[2:]
        action = physical[(core.situation.step * 7 + seed) % len(physical)]
        step, event = core.situation.step, adversary.act(view(core, action))
        core.advance(action, event)
        if event != NONE:
            events.append((step, event))
    return events


def test_a_reset_lets_it_fire_again() -> None:
    core = Core(WORLD, Rules(goal=()), ())
    core.reset(seed=0, initial=HOLDS_1)
    adversary = triggered("6")
    asks = view(core, "move(rob1,library)")
    adversary.reset(0)
    assert [adversary.act(asks), adversary.act(asks)] == ["exo_lock(library)", NONE]
    adversary.reset(0)
    assert adversary.act(asks) == "exo_lock(library)"


def test_the_random_event_comes_with_the_stated_probability() -> None:
    # Wherever the lock or one of the books is drawn something is possible here.
    state = ["loc(rob1,kitchen)", "loc(book1,office1)", "loc(book2,office1)"]
    drawn = [asked("random", state, "move(rob1,office2)", seed) for seed in range(600)]
    share = sum(event != NONE for event in drawn) / len(drawn)
    assert 0.88 < share < 0.96  # 0.92; the standard deviation of 600 draws is 0.011
    kinds = [event.arguments[0] for event in drawn if event != NONE]
    assert all(0.26 < kinds.count(kind) / len(kinds) < 0.41 for kind in ("library", *BOOKS))


def test_an_unknown_scenario_names_the_known_ones() -> None:
    with pytest.raises(
        ValueError, match=r"no scenario 7; there are 1, 2, 3, 4, 5, 6, random, random-possible"
    ):
        triggered("7")


def test_a_script_plays_its_entries_at_their_steps() -> None:
    script = Script([(2, "exo_lock(library)"), (4, "exo_move(book1,kitchen)")])
    core = Core(WORLD, Rules(goal=()), WORLD.initial_states())
    core.reset(seed=0)
    told = []
    for _ in range(5):
        told.append(script.act(view(core, WAIT)))
        core.advance(WAIT)
    assert told == [NONE, "exo_lock(library)", NONE, "exo_move(book1,kitchen)", NONE]


def test_a_script_has_one_action_a_step() -> None:
    with pytest.raises(ValueError, match="step 1 has two actions"):
        Script([(1, "exo_lock(library)"), (1, "exo_move(book1,kitchen)")])
