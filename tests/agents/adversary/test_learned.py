"""A policy from a file plays as its network says; what is no policy is refused in one line."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from agents.adversary.policy import PolicyError, load_policy
from testbed.cli import app
from testbed.config import ConfigError, load_config
from testbed.experiment.checks import CHECKS
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.learning import AdversaryEnv, input_names, save_policy
from testbed.link import InProcessRobot
from tests.stress.domains import DOMAINS, write_search

RULES = (
    "adversary.budget=3",
    "adversary.cooldown=1",
    "exogenous_while_thinking=true",
    "limits.steps=16",
)


def _network(env: AdversaryEnv, seed: int, hidden: int = 8) -> list[tuple[Any, Any]]:
    draw = np.random.default_rng(seed)
    sizes = [len(input_names(env)), hidden, len(env.game.core.adversary_actions)]
    return [(draw.normal(size=(n, m)), draw.normal(size=m)) for n, m in pairwise(sizes)]


@pytest.mark.parametrize("robot", ["traditional", "intentional"])
@pytest.mark.parametrize("domain", DOMAINS)
def test_it_plays_what_the_network_prefers_in_the_environment(
    domain: str, robot: str, tmp_path: Path
) -> None:
    path = write_search(tmp_path, domain)
    path.write_text(path.read_text().replace("limit: 3", "limit: 8"), encoding="utf-8")
    config = load_config(path, [f"robots=[{robot}]", *RULES])
    env = AdversaryEnv(config, robot)
    happened = 0
    given = ["adversary.strategy=learned", "adversary.options={policy: net.npz}"]
    layers = _network(env, 1)
    save_policy(tmp_path / "net.npz", env, layers, "drawn")
    (first, offset), (last, bias) = layers
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path)
        specs = plan_trials(load_config(path, [f"robots=[{robot}]", *RULES, *given]))
    for spec in specs:
        env.reset(options={"initial": spec.initial})
        over, events = False, []
        while not over:
            seen = env.game.observe("adversary_0")
            preferences = np.tanh(seen["observation"] @ first + offset) @ last + bias
            choice = int(np.argmax(np.where(seen["action_mask"], preferences, -np.inf)))
            step = env.game.core.situation.step
            _, _, ended, cut, _ = env.step(choice)
            over = ended or cut
            events += [(step, env.game.core.adversary_actions[choice])] if choice else []
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("TESTBED_PATH", str(tmp_path))
            record = play_trial(spec, InProcessRobot(make_robot)).record
        assert record.outcome not in ("error", "robot_lost"), record.reason
        assert [(own.step, own.action) for own in record.exogenous] == events
        happened += len(events)
    assert happened


def test_a_policy_is_read_as_it_was_written(tmp_path: Path) -> None:
    env = AdversaryEnv(write_search(tmp_path, "ferry"), "traditional")
    save_policy(tmp_path / "net.npz", env, _network(env, 1), "drawn with seed 1")
    read = load_policy(tmp_path / "net.npz")
    assert (read.inputs, read.made) == (input_names(env), "drawn with seed 1")
    for (weights, bias), (w, b) in zip(read.layers, _network(env, 1), strict=True):
        assert np.allclose(weights, w, atol=1e-6)
        assert np.allclose(bias, b, atol=1e-6)


@pytest.mark.parametrize("number", [np.nan, -np.inf, 2e6])
def test_numbers_that_no_file_may_have_are_not_written(number: float, tmp_path: Path) -> None:
    env = AdversaryEnv(write_search(tmp_path, "ferry"), "traditional")
    layers = _network(env, 1)
    layers[-1][1][0] = number
    with pytest.raises(ValueError, match="layers"):
        save_policy(tmp_path / "net.npz", env, layers, "diverged")
    assert not (tmp_path / "net.npz").exists()


def _file(path: Path, **changed: Any) -> None:
    arrays = {
        "inputs": np.array(["a", "b"]),
        "actions": np.array(["none", "c"]),
        "weights_0": np.zeros((2, 2)),
        "bias_0": np.zeros(2),
    }
    merged = {key: own for key, own in (arrays | changed).items() if own is not None}
    np.savez(path, **merged)


@pytest.mark.parametrize(
    ("changed", "part"),
    [
        ({"inputs": None}, "inputs"),
        ({"inputs": np.array(["a", "a"])}, "inputs"),
        ({"inputs": np.array([object()])}, "plain arrays"),
        ({"actions": np.array([1.0, 2.0])}, "actions"),
        ({"weights_0": np.zeros((3, 2))}, "weights_0"),
        ({"weights_0": np.full((2, 2), np.nan)}, "weights_0"),
        ({"weights_0": np.full((2, 2), 1e300)}, "weights_0"),
        ({"weights_0": np.full((2, 2), -np.inf, np.float32)}, "weights_0"),
        ({"bias_0": np.array([0.0, 2e6])}, "bias_0"),
        ({"weights_0": np.zeros((2, 2), object)}, "plain arrays"),
        ({"bias_0": np.zeros(3)}, "bias_0"),
        ({"bias_0": None}, "bias_0"),
        ({"weights_0": None, "bias_0": None}, "last layer"),
        ({"mood": np.zeros(3)}, "weights_1"),
        ({"weights_0": np.zeros((2, 3)), "bias_0": np.zeros(3)}, "last layer"),
    ],
)
def test_what_is_no_policy_is_refused_in_one_line(
    changed: dict[str, Any], part: str, tmp_path: Path
) -> None:
    path = tmp_path / "net.npz"
    _file(path, **changed)
    with pytest.raises(PolicyError, match=part) as refused:
        load_policy(path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 torn", b"no archive"])
def test_another_file_is_refused(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "net.npz").write_bytes(content)
    with pytest.raises(PolicyError, match="plain arrays"):
        load_policy(tmp_path / "net.npz")


def test_a_policy_of_another_domain_is_refused_before_a_run(tmp_path: Path) -> None:
    ferry = AdversaryEnv(write_search(tmp_path, "ferry"), "traditional")
    save_policy(tmp_path / "net.npz", ferry, _network(ferry, 1), "drawn")
    config = write_search(tmp_path, "garden")
    given = ["adversary.strategy=learned", "adversary.options={policy: net.npz}"]
    done = CliRunner().invoke(app, ["check", str(config), *given])
    (line,) = done.stderr.splitlines()
    assert done.exit_code == 2
    assert "options.policy" in line


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("does wait", "does loiter"),
        ("left budget", "left bugdet"),
        ("left cooldown", "left room kitchen"),
        ("none", "nothing"),
    ],
)
@pytest.mark.parametrize("domain", DOMAINS)
def test_every_name_of_a_policy_has_to_be_of_the_domain(
    domain: str, old: str, new: str, tmp_path: Path
) -> None:
    """Fluents alone do not tell two domains apart."""
    path, file = write_search(tmp_path, domain), tmp_path / "net.npz"
    env = AdversaryEnv(load_config(path, RULES), "traditional")
    given = [*RULES, "adversary.strategy=learned", f"adversary.options={{policy: {file}}}"]
    save_policy(file, env, _network(env, 1), "drawn")
    load_config(path, given, CHECKS)
    arrays = dict(np.load(file))
    assert old in {*arrays["inputs"], *arrays["actions"]}
    for key in ("inputs", "actions"):
        arrays[key] = np.array([new if own == old else str(own) for own in arrays[key]])
    np.savez(file, **arrays)
    with pytest.raises(ConfigError, match=new):
        load_config(path, given, CHECKS)


def test_a_missing_file_and_a_missing_option_are_said(tmp_path: Path) -> None:
    config = write_search(tmp_path, "garden")
    for options, part in (("{policy: no.npz}", "no.npz"), ("{}", "policy")):
        given = ["adversary.strategy=learned", f"adversary.options={options}"]
        done = CliRunner().invoke(app, ["check", str(config), *given])
        (line,) = done.stderr.splitlines()
        assert done.exit_code == 2
        assert part in line


@pytest.mark.parametrize("robot", ["traditional", "intentional"])
def test_the_packaged_policies_play_the_office(robot: str) -> None:
    given = [
        f"robots=[{robot}]",
        "limit=1",
        "scenarios=[1]",
        "adversary.budget=2",
        "adversary.fair=true",
        "adversary.strategy=learned",
        f"adversary.options={{policy: office-{robot}}}",
    ]
    (spec,) = plan_trials(load_config("office", given))
    record = play_trial(spec, InProcessRobot(make_robot)).record
    assert record.outcome not in ("error", "robot_lost"), record.reason
    assert record.exogenous
    assert record.execution_units > (record.minimal_units or 0)
