"""docs/environment.md says what the environment of the office is."""

from pathlib import Path

from gymnasium import spaces

from testbed import office_v0
from testbed.environment import Ending, rewards

PAGE = Path(__file__).parents[2] / "docs" / "environment.md"


def _cells(heading: str) -> list[list[str]]:
    """The rows of the first table below a heading, without its head."""
    text = PAGE.read_text(encoding="utf-8").partition(f"## {heading}\n")[2]
    table = text[text.index("|") :].partition("\n\n")[0]
    return [[cell.strip() for cell in row.split("|")[1:-1]] for row in table.splitlines()[2:]]


def test_the_office_has_the_actions_and_vectors_that_are_told() -> None:
    env = office_v0.raw_env()
    robot, adversary = env.core.robot_actions, env.core.adversary_actions
    rows = _cells("Actions")
    assert [row[0] for row in rows] == [str(number) for number in range(len(rows))]
    assert [row[1].strip("`") for row in rows] == list(robot)
    assert [row[2].strip("`") for row in rows if row[2]] == list(adversary)
    for agent, _, length, _, mask in _cells("Observations"):
        space = env.observation_space(agent.strip("`"))
        assert isinstance(space, spaces.Dict)
        assert space["observation"].shape == (int(length),)
        assert space["action_mask"].shape == (int(mask),)


def test_the_fluents_stand_where_the_page_says() -> None:
    fluents = office_v0.raw_env().core.world.fluents
    rooms = ("kitchen", "office1", "office2", "library")
    for first, thing in ((0, "book1"), (4, "book2"), (8, "rob1")):
        assert fluents[first : first + 4] == tuple(f"loc({thing},{room})" for room in rooms)
    assert fluents[12:] == ("in_hand(rob1,book1)", "in_hand(rob1,book2)", "locked(library)")


def test_every_ending_is_worth_what_the_page_says() -> None:
    rows = _cells("Rewards and endings")
    assert {row[0].strip("`") for row in rows} == set(Ending)
    for outcome, _, robot, adversary, flag in rows:
        ending = Ending(outcome.strip("`"))
        assert rewards(ending) == {"robot_0": float(robot), "adversary_0": float(adversary)}
        assert ending.by_answer == (flag == "termination")


def test_the_levels_have_the_sizes_that_are_told() -> None:
    text = PAGE.read_text(encoding="utf-8").partition("## The fine resolution\n")[2]
    table = text[text.index("| | L1 |") :].partition("\n\n")[0].splitlines()
    levels, _, *rows = ([cell.strip("` ") for cell in row.split("|")[1:-1]] for row in table)
    for number, level in list(enumerate(levels))[1:3]:
        core = office_v0.raw_env(level=level).core
        sizes = (core.world.fluents, core.robot_actions, core.adversary_actions)
        assert [row[number] for row in rows] == [f"{len(size):,}" for size in sizes]
