"""The adversaries that can be asked for, their options, and the one that plays a trial."""

import os
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any, Protocol, get_args, get_type_hints

import msgspec

from agents.adversary import Adversary, AdversaryView, Game, Script, Sight
from asp.language import Action, Literal, suggestion
from testbed.config import NO_EVENTS, ExperimentConfig, Finding, refinements
from testbed.environment import EventRules
from testbed.experiment.robots import HUMAN
from testbed.experiment.specs import Setting, default_strategy
from testbed.protocol import in_one_line, shortened
from testbed.registry import PATH_VARIABLE, Registry, RegistryError, class_fault
from testbed.world import World, load_world, world_of

SIGHTS = get_args(Sight)
STRATEGY = "adversary.strategy"
RATE = "rate"
"""The option that is a key of its own in configurations."""


class AdversaryClass(Protocol):
    """The class of an adversary, with what it declares; `Options` may be missing."""

    sees: Sequence[Sight]
    Options: type

    def __call__(self, game: Game, options: Any) -> Adversary: ...


class AdversaryError(RuntimeError):
    """What an adversary of a user's did wrong: one line that names it."""


def _fault(found: Any) -> str | None:
    fault = class_fault(found, "reset", "act", arguments=2)
    sees = getattr(found, "sees", None)
    if fault is None and not (isinstance(sees, tuple) and set(sees) <= set(SIGHTS)):
        return f"should declare sees, a tuple with some of {', '.join(SIGHTS)}, or with none"
    if fault is None and not is_dataclass(getattr(found, "Options", _NoOptions)):
        return "has Options that are no dataclass"
    return fault


@dataclass(frozen=True)
class _NoOptions:
    """Of an adversary that declares none."""


ADVERSARIES: Registry[AdversaryClass] = Registry(
    "adversary",
    "intention_testbed.adversaries",
    {
        "triggers": "agents.adversary.scripted:Triggered",
        NO_EVENTS: "agents.adversary.none:Nothing",
        "random": "agents.adversary.random:Random",
        "meddler": "agents.adversary.meddler:Meddler",
        "belief": "agents.adversary.belief:Belief",
        "greedy": "agents.adversary.greedy:Greedy",
        "optimal": "agents.adversary.optimal:Optimal",
        "learned": "agents.adversary.learned:Learned",
        HUMAN: "agents.adversary.human:Human",
    },
    _fault,
)


class OptionError(ValueError):
    """An option that an adversary does not take: `name` says which, None where one is missing."""

    def __init__(self, name: str | None, why: str) -> None:
        super().__init__(why)
        self.name = name


def make_adversary(setting: Setting, game: Game) -> Adversary:
    """The adversary of a trial: the script that is given, else the strategy.

    Raises:
        RegistryError: where there is no such strategy.
        OptionError: for options that it does not take.
        ValueError: for a scenario that the strategy does not know.
    """
    if setting.script is not None:
        return Script(setting.script, setting.script_at_actions, setting.script_skips)
    fine = setting.fine is not None
    name = setting.strategy or default_strategy(fine)
    found, given = ADVERSARIES.find(name), dict(setting.options or {})
    if setting.rate is not None:
        given[RATE] = setting.rate
    elif setting.strategy is None and fine:
        given[RATE] = 0.0
    return _Named(name, lambda: found(game, options_of(found, given)))


def options_of(found: AdversaryClass, given: Mapping[str, object]) -> object:
    """The options that an adversary is made with. Raises OptionError."""
    declared = getattr(found, "Options", _NoOptions)
    known = [field.name for field in fields(declared)]
    for name in given:
        if name not in known:
            raise OptionError(name, f"no such option; {suggestion(name, known)}")
    files = {
        name: _located(given[name]) for name in getattr(declared, "files", ()) if name in given
    }
    try:
        return msgspec.convert({**given, **files}, declared)
    except msgspec.ValidationError as error:
        why, _, place = str(error).replace("`", "").partition(" - at $")
        wrong = re.split(r"[.\[]", place.lstrip("."))[0]
        if wrong in given and why.startswith("Invalid enum value"):
            choices = get_args(get_type_hints(declared)[wrong])
            why = f"should be {' or '.join(map(repr, choices))}, not {given[wrong]!r}"
        raise OptionError(wrong or None, why) from None


def _located(file: object) -> object:
    """A file that an option names: beside the configuration, else where it is."""
    beside = Path(os.environ.get(PATH_VARIABLE, ""), str(file))
    return str(beside) if beside.is_file() else file


class _Named:
    """An adversary whose errors name it."""

    def __init__(self, name: str, make: Callable[[], Adversary]) -> None:
        self._name = name
        with self._blamed():
            self._adversary = make()
            self.sees = self._adversary.sees

    def reset(self, seed: int) -> None:
        """Begins a trial. Raises AdversaryError."""
        with self._blamed():
            self._adversary.reset(seed)

    def act(self, view: AdversaryView) -> Action:
        """The answer at a step. Raises AdversaryError, also for one that is no text."""
        with self._blamed():
            answer: object = self._adversary.act(view)
        try:
            return Literal.parse(answer if isinstance(answer, str) else "")
        except ValueError:
            message = f"{self._name} answered {answer!r}, which is not an action"
            raise AdversaryError(shortened(message)) from None

    @contextmanager
    def _blamed(self) -> Iterator[None]:
        try:
            yield
        except Exception as error:  # whatever it is, it is the adversary's
            raise AdversaryError(f"{self._name}: {in_one_line(error)}") from error


def adversary_findings(config: ExperimentConfig) -> Iterator[Finding]:
    """A strategy that there is not, and options that it does not take."""
    own = config.adversary
    if any(key.startswith(STRATEGY) for keys in config.sweep.cells.values() for key in keys):
        return  # it is checked under each condition
    strategy = own.strategy or default_strategy(config.is_fine)
    given = dict(own.options)
    if RATE in given:
        yield ("adversary", "options", RATE), "is a key of its own; give adversary.rate"
    elif own.rate is not None:
        given[RATE] = own.rate
    try:
        found = ADVERSARIES.find(strategy)
        if getattr(found, "needs_budget", False) and own.budget is None:
            yield ("adversary", "budget"), f"{strategy} needs one: a number of events, such as 2"
        options = options_of(found, given)
        for option, names in getattr(options, "named_events", {}).items():
            for why in _unknown(names, config):
                raise OptionError(option, why)
        for option, why in _misfits(options, config):
            raise OptionError(option, why)
    except RegistryError as error:
        yield ("adversary", "strategy"), str(error)
    except OptionError as error:
        where = (RATE,) if error.name == RATE else ("options", *filter(None, [error.name]))
        yield ("adversary", *where), f"{error} (of {strategy})"


def _unknown(names: Collection[str], config: ExperimentConfig) -> Iterator[str]:
    """What is wrong with names that no exogenous action has, or none that may be used."""
    if not names:
        return
    events = {event for world in _worlds(config) for event in world.exogenous_actions}
    known = {event.name for event in events}
    permits = EventRules(**config.adversary.bounds()).permits
    permitted = {event.name for event in events if permits(event)}
    for name in names:
        if name not in known:
            yield f"'{name}' is no exogenous action; {suggestion(name, sorted(known))}"
        elif name not in permitted:
            yield f"'{name}' is none of adversary.events; list it there, or leave it out"


def _misfits(options: object, config: ExperimentConfig) -> Iterator[tuple[str, str]]:
    """What options have that is not of the worlds that are played in, by option."""
    if hasattr(options, "misfits"):
        for world in _worlds(config):
            yield from options.misfits(world)


def _worlds(config: ExperimentConfig) -> Sequence[World]:
    """The worlds in which a configuration is played."""
    if config.is_fine:
        return [world_of(refinement) for _, refinement in refinements(config)]
    return [load_world(config.domain)]
