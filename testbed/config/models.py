"""The keys of a configuration, each with its type and default.

Those of its sections stand in `testbed.config.sections`. Literals and actions are ASP text without
spaces, `f(a,b)` or `-f(a,b)`. Whether a domain knows them is checked in `testbed.config.checking`.
"""

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field, model_validator

from testbed import environment
from testbed.config.running import Runner, Tls
from testbed.config.sections import (
    AdversarySettings,
    Drawing,
    LevelSettings,
    Limits,
    Observability,
    RewardSettings,
    ScenarioSettings,
    ScriptEntry,
    StressSettings,
)
from testbed.config.sweep import Sweep
from testbed.config.values import (
    LARGEST_SEED,
    Count,
    Flag,
    Literals,
    Name,
    Names,
    Probability,
    Scenarios,
    Section,
)
from testbed.protocol import Knowledge, Plans, Relevance

LinkKind = Literal["zenoh", "inprocess"]
ScriptPolicy = Literal["error", "skip"]
FINE_STEPS = 5000
"""Environment steps of a trial at the fine resolution, unless given."""
TRIGGERS = "triggers"
"""The strategy of an adversary that plays the domain's triggers."""
NO_EVENTS = "none"
"""The strategy of an adversary that never does anything."""
TREATMENT, BASELINE = "intentional", "traditional"
"""The robots that are compared unless others are named: those of the published study."""
GOAL = 'goal: ["f(a,b)", "-g(a)"]'
"""How a goal is written."""


class ExperimentConfig(Section):
    """A whole experiment: which trials, in which domain, under which rules.

    `scenarios` absent, which nothing that was loaded has, means those of the domain; `none`, that
    nothing exogenous happens.
    `initial` absent means every state that the domain's `initially` allows. A `script` replaces
    the scenario's triggers; an empty one means that nothing exogenous happens. `script_policy` says
    what becomes of an entry that is not possible when it is due: it ends the trial with an error,
    or is skipped. `knowledge` is what robots know of the initial state: all of it, or only what
    they see; `relevance` is which of the literals that they see intentional robots heed; `plans`:
    whether some outcomes of a plan's actions have to reach the goal, or all; `ties` is the seed of
    the order in which robots choose among equally small explanations. `repeats`: so many
    pairs of trials from each initial state, in scenarios in which something is drawn. `protocol` is
    the study that the trials are for: a name, or `module:OBJECT`. `sweep` says under which
    conditions trials are played, each under all of them. `runner` is what plays them: processes of
    this machine, or Dask: the workers of a `scheduler`, without one a cluster on this machine.
    `rewards` is what a game of the environment is worth, and `stress` what a search for failures
    looks for; results of trials depend on neither.

    `infos`, `illegal` and `padded` are conventions of the environments of a configuration.

    With `levels`, or with the `refinement` of a domain of one's own, trials are played at the fine
    resolution. They are drawn: each has its initial state and its goal unless these are given.
    """

    name: Annotated[Name, Field(pattern=r"^[A-Za-z0-9][\w.-]*$", examples=["name: quickstart"])]
    protocol: Name | None = None
    seed: Annotated[int, Field(strict=True, ge=0, le=LARGEST_SEED)] = 0
    domain: Name = "office"
    refinement: Name | None = None
    goal: Annotated[Literals, Field(examples=[GOAL])]
    initial: Literals | None = None
    scenarios: Scenarios = ()
    scenario_settings: dict[Name, ScenarioSettings] = Field(default_factory=dict)
    levels: tuple[Name, ...] = ()
    level_sizes: dict[Name, LevelSettings] = Field(default_factory=dict)
    draw: Drawing = Drawing()
    robots: Annotated[tuple[Name, ...], Field(min_length=1)] = (TREATMENT, BASELINE)
    baseline: Name | None = None
    treatment: Names = ()
    repeats: Count = 1
    limit: Count | None = None
    link: LinkKind = "zenoh"
    runner: Runner = "local"
    scheduler: Name | None = None
    tls: Tls = Tls()
    knowledge: Knowledge = "complete"
    relevance: Relevance = "definition"
    plans: Plans = "optimistic"
    ties: Annotated[int, Field(strict=True, ge=0, le=LARGEST_SEED)] | None = None
    observability: dict[str, Observability] = Field(default_factory=dict)
    goal_feedback: Flag = True
    exogenous_while_thinking: Flag = False
    script: tuple[ScriptEntry, ...] | None = None
    script_policy: ScriptPolicy = "error"
    statistics: dict[str, Probability] = Field(default_factory=dict)
    adversary: AdversarySettings = AdversarySettings()
    rewards: RewardSettings = RewardSettings()
    limits: Limits = Limits()
    sweep: Sweep = Sweep()
    stress: StressSettings = StressSettings()
    infos: environment.Infos = "numeric"
    illegal: environment.Illegal = "error"
    padded: Flag = False

    @model_validator(mode="before")
    @classmethod
    def _with_fine_defaults(cls, given: object) -> object:
        """At the fine resolution a goal may be drawn, and a trial has many more steps."""
        if not isinstance(given, Mapping) or not (given.get("levels") or given.get("refinement")):
            return given
        limits, goal = given.get("limits", {}), given.get("goal")
        if isinstance(limits, Mapping):
            limits = {"steps": FINE_STEPS, **limits}
        return {**given, "goal": () if goal is None else goal, "limits": limits}

    @property
    def is_fine(self) -> bool:
        """Whether trials are played at the fine resolution."""
        return bool(self.levels) or self.refinement is not None

    @property
    def is_sweep(self) -> bool:
        """Whether trials are played under several conditions."""
        return bool(self.sweep.axes)

    @property
    def plays_triggers(self) -> bool:
        """Whether in scenarios without a script the domain's triggers are played."""
        return not self.is_fine and self.adversary.strategy in (None, TRIGGERS)

    @property
    def gives_goal_feedback(self) -> bool:
        """Whether in every scenario a robot is told that it finished without its goal."""
        own = (settings.goal_feedback for settings in self.scenario_settings.values())
        return self.goal_feedback and False not in own

    @property
    def comparisons(self) -> tuple[tuple[str, str], ...]:
        """Which robots are compared: a baseline and a treatment each, the main comparison first.

        What is not given is as in the published study, where that robot plays, else the first that
        is left over. None where a single robot plays.
        """
        rest = [name for name in self.robots if name != self.baseline]
        treatments = self.treatment or ((TREATMENT,) if TREATMENT in rest else ())
        others = [name for name in self.robots if name not in treatments]
        baseline = self.baseline or (BASELINE if BASELINE in others else next(iter(others), None))
        treatments = treatments or tuple(name for name in self.robots if name != baseline)[:1]
        return tuple((baseline, name) for name in treatments) if baseline is not None else ()

    def rules_of_news(self) -> dict[str, environment.Observability]:
        """`observability` as the environment has it, by the name of the exogenous action."""
        return {
            name: environment.Observability(**dict(own))
            for name, own in sorted(self.observability.items())
        }

    def settings(self, scenario: str) -> ScenarioSettings:
        """The settings that hold in a scenario: its own where it has them, else the common ones.

        `goal`, `exogenous_while_thinking`, `goal_feedback` and `repeats` are never None in the
        answer.
        """
        own = self.scenario_settings.get(scenario, ScenarioSettings())
        chosen = {key: self if value is None else own for key, value in own}
        return ScenarioSettings(**{key: getattr(owner, key) for key, owner in chosen.items()})
