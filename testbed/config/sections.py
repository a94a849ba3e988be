"""The sections of a configuration: keys that belong together, each with its type and default."""

from dataclasses import fields
from typing import Annotated, Any
from typing import Literal as Choice

from pydantic import AfterValidator, Field
from pydantic_core import PydanticCustomError

from asp import language
from testbed import environment
from testbed.config.values import (
    MOST,
    Amount,
    Count,
    Flag,
    Literals,
    LiteralText,
    Name,
    Natural,
    Probability,
    Seconds,
    Section,
)

Objective = Choice["fail", "waste", "regret", "reasoning", "principles"]
Varied = Choice["initial", "goal", "observability", "goal_feedback"]


class Observability(Section):
    """Whether the robot is told of an exogenous action, how often, how truly and how late.

    `false_reports`: probability a step of a report of something that did not happen; `delay`:
    steps by which every report is late.
    """

    mode: environment.Mode = "never"
    probability: Probability = 1.0
    false_reports: Probability = 0.0
    delay: Natural = 0


class ScriptEntry(Section):
    """An exogenous action and when it happens: either at a step, or with an action of the robot.

    `at_action`: the number of the physical action of the robot, from 1 on, that it happens with.
    """

    step: Count | None = None
    at_action: Count | None = None
    action: LiteralText


class Limits(Section):
    """Bounds of a trial: environment steps, length of a plan, seconds for an answer.

    A decision may take so many `conflicts` of the solver, ground programs of at most so many
    `ground_rules`, and so many `expansions` of sets of states; None: any number. `decision_s` are
    the seconds that it may take with everything, a guard. At any of them a robot waits for a step.
    `judge_states` are the states that a search with complete knowledge looks at: after the trial,
    for the fewest actions that achieve its goal, which are not known where they do not suffice; and
    what rules and rewards of the game ask for.
    """

    steps: Count = 100
    plan: Count = 30
    answer_s: Seconds = 60.0
    conflicts: Count | None = 50_000
    ground_rules: Count | None = 1_000_000
    expansions: Count | None = 1_000_000
    decision_s: Seconds | None = 30.0
    judge_states: Count = 5_000


class AdversarySettings(Section):
    """What others do, and when.

    `strategy`: the domain's `triggers`, `random` events, or an adversary of one's own; absent:
    triggers in scenarios, random at levels. `rate`: probability per step that a trigger fires,
    absent: as the domain states it; or that a random event happens, absent: 0.1, at levels 0; of
    others what they take it for. `options` are those that the strategy declares. `pace`: at the
    fine resolution, at each `concrete` action or only at those that change what holds at the coarse
    one (`abstract`).

    What bounds any strategy, and any script: `budget` events per game, `per_object` events per game
    that name one object of a sort, `cooldown` steps that pass after an event, `events` that it may
    use (names of exogenous actions, or ground ones; null: all), and with `fair` only events after
    which the goal can still be achieved. `cost`: what an event takes from its reward.
    """

    strategy: Name | None = None
    options: dict[str, Any] = Field(default_factory=dict)
    rate: Probability | None = None
    pace: environment.Pace = "concrete"
    budget: Natural | None = None
    per_object: dict[Name, Natural] = Field(default_factory=dict)
    cooldown: Natural = 0
    cost: Amount = 0.0
    events: Literals | None = None
    fair: Flag = False

    def bounds(self) -> dict[str, Any]:
        """What bounds the adversary, by the names of the environment's rules."""
        return {field.name: getattr(self, field.name) for field in fields(environment.EventRules)}


class RewardSettings(Section):
    """What a game is worth: docs/game.md has the equations.

    `step`: what a step costs the robot; `shaping`: the factor of the potential-based reward;
    `discount`: that of the learner, which the latter needs.
    """

    robot: environment.RobotReward = "goal"
    adversary: environment.AdversaryReward = "zero_sum"
    step: Amount = 0.0
    shaping: Amount = 0.0
    discount: Annotated[float, Field(strict=True, gt=0.0, le=1.0)] = 1.0


def _distinct(names: tuple[Objective, ...]) -> tuple[Objective, ...]:
    if not names or len({*names}) < len(names):
        raise PydanticCustomError("objectives", "should be one name or several different ones")
    return names


class StressSettings(Section):
    """What a search for failures looks for, and how far it goes (docs/stress.md).

    `objectives` judge each episode. `events`: the most exogenous actions of an episode; `fair`:
    only those after which the goal can still be achieved; `minutes` that the search takes;
    `branches`: of a case with given events, the most that are tried as the next one. `vary`: what
    episodes draw that are not of the plan of trials. More than `waste`, or `regret`, execution
    units, or `reasoning_s` seconds of process time, are a finding; null: none is, and the greatest
    are told.
    """

    objectives: Annotated[tuple[Objective, ...], AfterValidator(_distinct)] = ("fail",)
    events: Count = 2
    fair: Flag = True
    minutes: Annotated[float, Field(strict=True, gt=0.0, le=1e6)] = 10.0
    branches: Count = 1_000
    vary: tuple[Varied, ...] = ()
    waste: Amount | None = None
    regret: Amount | None = None
    reasoning_s: Seconds | None = None


class LevelSettings(Section):
    """Rooms in a row, each a grid of cells; `objects` are kinds of them, each (number, parts)."""

    rooms: Annotated[int, Field(strict=True, ge=2, le=MOST)]
    rows: Count
    columns: Count
    objects: Annotated[tuple[tuple[Count, Count], ...], Field(min_length=1)]


class Drawing(Section):
    """What a trial at a level draws with its seed.

    `goal`: literals with sorts in place of constants, equal sorts being one constant, which is
    drawn such that the goal does not hold yet. `holding`: probability that the robot starts with
    something in its hand.
    """

    goal: Annotated[Literals, Field(min_length=1)] = (language.Literal.parse("loc(object,room)"),)
    holding: Probability = 0.2


class ScenarioSettings(Section):
    """What one scenario has of its own; a key left out is the experiment's."""

    initial: Literals | None = None
    goal: Literals | None = None
    script: tuple[ScriptEntry, ...] | None = None
    exogenous_while_thinking: Flag | None = None
    goal_feedback: Flag | None = None
    repeats: Count | None = None
