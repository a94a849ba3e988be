"""Policies of the adversary's side, as files that the strategy `learned` plays."""

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from agents.adversary.learned import DOES, LEFT
from agents.adversary.policy import LARGEST, Policy
from testbed.learning.gymnasium_envs import AdversaryEnv


def save_policy(
    path: str | Path, env: AdversaryEnv, layers: Sequence[tuple[ArrayLike, ArrayLike]], made: str
) -> None:
    """Write a network that was learned in an environment: docs/learning.md has its equations.

    Parameters
    ----------
    path : the file, `.npz`.
    env : where it was learned; its observation is the input, one value per entry.
    layers : weights, (n, m), with biases, (m,); the first has n entries of the observation, the
        last m actions.
    made : a line that says how, such as the command.

    Raises ValueError for layers that do not fit, or have larger numbers than a file may, OSError
    where the file cannot be written.
    """
    core = env.game.core
    arrays = tuple((np.asarray(w, np.float32), np.asarray(b, np.float32)) for w, b in layers)
    inputs, actions = input_names(env), tuple(map(str, core.adversary_actions))
    widths = [len(inputs), *(weights.shape[-1] for weights, _ in arrays)]
    shapes = [(weights.shape, bias.shape) for weights, bias in arrays]
    wanted = [((n, m), (m,)) for n, m in pairwise(widths)]
    if shapes != wanted or widths[-1] != len(actions):
        wide = f"from {len(inputs)} entries to {len(actions)} actions"
        raise ValueError(f"layers of shapes {shapes} do not lead {wide}")
    if not all((np.abs(own) <= LARGEST).all() for pair in arrays for own in pair):
        raise ValueError(f"layers have numbers that do not lie within ±{LARGEST:,.0f}")
    Policy(inputs, actions, arrays, made).save(Path(path))


def input_names(env: AdversaryEnv) -> tuple[str, ...]:
    """The names of the entries of the adversary's observation, in their order."""
    core = env.game.core
    names = [*map(str, core.world.fluents), *(f"{DOES}{own}" for own in core.robot_actions)]
    rules, sorts = core.rules.adversary, core.world.description.sorts
    names += [f"{LEFT}budget"] if rules.budget is not None else []
    names += [f"{LEFT}cooldown"] if rules.cooldown else []
    names += [f"{LEFT}{sort} {own}" for sort in rules.per_object for own in sorts[sort]]
    return tuple(names)
