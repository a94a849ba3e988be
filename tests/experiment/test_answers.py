"""What a robot says is checked where it comes in: no answer makes a run that cannot be read."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest
from msgspec import inspect

from asp.language import Literal
from testbed.analysis.export import export
from testbed.experiment.plan import plan_trials
from testbed.experiment.recorder import Result
from testbed.experiment.run_folder import write_config
from testbed.experiment.specs import TrialSpec
from testbed.experiment.store import TrialWriter, encode, read_records
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot
from testbed.protocol import Decision, Percept, Task
from tests.experiment.samples import Configure

MANY = 10**6
BAD: dict[str, dict[str, Any]] = {
    "no time": {"planning_time_s": float("nan")},
    "endless": {"planning_time_s": float("inf")},
    "before it began": {"diagnosis_time_s": -1.0},
    "more plans than an int64 holds": {"plans": 2**63},
    "more plans than can be made": {"plans": 2**40},
    "fewer plans than none": {"plans": -1},
    "an activity without a number": {"mental": "start(x)"},
    "an activity with too many digits": {"mental": f"start({'1' * 5000})"},
    "the opposite of a mental action": {"mental": "-start(1)"},
    "no mental action": {"mental": "start(1) and more"},
    "a long text": {"reason": "x" * MANY},
    "a long name": {"plan": ["x" * MANY]},
    "a long list": {"plan": ["wait"] * MANY},
    "a step that is none": {"explanation": {"step": 2**63, "unobserved": [], "exceptions": []}},
    "fine counts that are none": {"fine": {"plans": -1}},
}
NESTED = msgspec.Raw(b"\x82\xa7version\x01\xa5trace" + b"\x91" * MANY + b"\xc0")


class Saying:
    """A robot that waits, with these values in its trace, or says something else altogether."""

    def __init__(self, trace: dict[str, Any], instead: object = None) -> None:
        self._trace, self._instead = trace, instead

    def begin(self, task: Task) -> None:
        pass

    def act(self, percept: Percept) -> Any:
        sound = {"version": 1, "trial": percept.trial, "step": percept.step, "action": "wait"}
        return self._instead or {**sound, "believes_goal": False, "trace": self._trace}


@pytest.fixture
def spec(configure: Configure) -> TrialSpec:
    config = configure("scenarios=[1]", "robots=[intentional]", "limits.steps=30")
    return plan_trials(config)[0]


def _play(spec: TrialSpec, robot: Any) -> Result:
    return play_trial(spec, InProcessRobot(lambda _: robot))


@pytest.mark.parametrize("kind", [*BAD, "nested", "long altogether"])
def test_an_answer_out_of_bounds_loses_the_robot(spec: TrialSpec, kind: str) -> None:
    instead = {"nested": NESTED, "long altogether": b"x" * 50 * MANY}.get(kind)
    record = _play(spec, Saying(BAD.get(kind, {}), instead)).record
    assert (record.outcome, record.cause, record.steps) == ("robot_lost", "robot", 0)
    assert record.reason is not None
    assert record.reason.startswith("answer not understood")
    assert len(record.reason) < 1000


def test_what_is_within_bounds_is_kept(spec: TrialSpec) -> None:
    record = _play(spec, Saying({"plans": 3, "reason": "x" * 1000, "mental": "start(7)"})).record
    assert (record.outcome, record.plans, record.activities[0].name) == ("step_limit", 3, 7)


def test_what_is_bounded_in_each_answer_is_bounded_in_all(spec: TrialSpec) -> None:
    """Every answer is small enough, the record of all of them is not."""
    said = {"step": 1, "unobserved": [], "exceptions": ["-" + "x" * 8000] * 50}
    record = _play(spec, Saying({"explanation": said})).record
    assert (record.outcome, record.cause) == ("robot_lost", "robot")
    assert len(encode(record)) < 10_000


def test_an_error_of_any_length_leaves_a_record_of_few_characters(spec: TrialSpec) -> None:
    class Failing(Saying):
        def act(self, percept: Percept) -> Any:
            raise RuntimeError(f"at step {percept.step} {'x' * 50 * MANY}")

    result = _play(spec, Failing({}))
    assert (result.record.outcome, result.record.cause) == ("robot_lost", "robot")
    assert result.record.reason is not None
    assert "at step 1" in result.record.reason
    assert len(result.record.reason) + len(result.details or "") < MANY


class Mute(Exception):  # noqa: N818
    """One that says nothing, not even when it is asked."""

    def __str__(self) -> str:
        raise ValueError("nothing to say")


@pytest.mark.parametrize("error", [RuntimeError("no \udcff.al"), Mute()])
def test_an_error_whose_text_cannot_be_written_is_the_robots(
    spec: TrialSpec, error: Exception
) -> None:
    class Failing(Saying):
        def act(self, percept: Percept) -> Any:
            raise error from ValueError(percept.step)

    record = _play(spec, Failing({})).record
    assert (record.outcome, record.cause) == ("robot_lost", "robot")
    assert type(error).__name__ in (record.reason or "")


def test_a_run_with_such_an_answer_can_be_read_and_exported(
    configure: Configure, tmp_path: Path
) -> None:
    config = configure("scenarios=[1]", "robots=[intentional]")
    write_config(tmp_path, config)
    (spec,) = plan_trials(config)
    with TrialWriter(tmp_path) as writer:
        for number, trace in enumerate((*BAD.values(), {})):
            own = msgspec.structs.replace(spec, trial=f"{number:016x}")  # a trial has one record
            writer.append(_play(own, Saying(trace)).record)
    assert len(list(read_records(tmp_path))) == len(BAD) + 1
    export(tmp_path)


def test_every_part_of_an_answer_has_a_bound() -> None:
    loose = [name for name, kind in _parts(inspect.type_info(Decision)) if not _bounded(kind)]
    assert loose == ["Decision.version"], "which is only compared"


def _parts(kind: inspect.Type, name: str = "") -> Iterator[tuple[str, inspect.Type]]:
    """The types in a type, with the names of the fields that they are in."""
    yield name, kind
    if isinstance(kind, inspect.StructType):
        for field in kind.fields:
            yield from _parts(field.type, f"{kind.cls.__name__}.{field.name}")
    elif isinstance(kind, inspect.UnionType):
        for item in kind.types:
            yield from _parts(item, name)
    elif isinstance(kind, inspect.ListType):
        yield from _parts(kind.item_type, name)


def _bounded(kind: inspect.Type) -> bool:
    if isinstance(kind, inspect.StrType):
        return kind.max_length is not None or kind.pattern is not None
    if isinstance(kind, inspect.ListType):
        return kind.max_length is not None
    if isinstance(kind, inspect.IntType | inspect.FloatType):
        return None not in (kind.ge, kind.le)
    if isinstance(kind, inspect.CustomType):
        return kind.cls is Literal  # whose text `literal_within_bounds` bounds
    free = inspect.StructType | inspect.UnionType | inspect.LiteralType
    return isinstance(kind, free | inspect.BoolType | inspect.NoneType)
