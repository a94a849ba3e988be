r"""Train an adversary against a robot, with MaskablePPO, and write it as a policy file.

    python examples/train_adversary.py --robot intentional --steps 200000 --out trained.npz

needs `pip install 'intention-testbed[train]'`. The adversary has two fair events per game in the
office, and is rewarded with the execution units that the robot wastes. The robot's answers are
remembered by history. `testbed run` then plays the file:

    testbed run office adversary.strategy=learned adversary.options.policy=trained.npz \
        adversary.budget=2 adversary.fair=true
"""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from gymnasium.wrappers import TransformReward

from testbed.learning import AdversaryEnv, save_policy

if TYPE_CHECKING:
    from sb3_contrib import MaskablePPO

RULES = {"budget": 2, "fair": True}
UNITS = 100.0
"""Rewards are divided by this many units, to be of the order of 1."""


def main() -> None:
    """Trains, and writes the network."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--robot", default="traditional")
    parser.add_argument("--steps", type=int, default=200_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("trained.npz"))
    given = parser.parse_args()
    try:
        from sb3_contrib import MaskablePPO
    except ModuleNotFoundError:
        raise SystemExit("needs `pip install 'intention-testbed[train]'`") from None
    env = AdversaryEnv(
        "office",
        given.robot,
        remember=True,
        observations="flat",
        max_cycles=60,
        adversary=RULES,
        rewards={"adversary": "waste"},
    )
    rewarded = TransformReward(env, lambda reward: reward / UNITS)
    learner = MaskablePPO(
        "MlpPolicy",
        rewarded,
        gamma=1.0,
        n_steps=1024,
        batch_size=256,
        ent_coef=0.01,
        seed=given.seed,
        device="cpu",
        verbose=1,
    )
    learner.learn(given.steps)
    save_policy(given.out, env, layers_of(learner), made=made_by(given))
    env.close()


def layers_of(learner: "MaskablePPO") -> list[tuple[object, object]]:
    """Weights and biases of the network that prefers actions."""
    policy = learner.policy
    linear = [*policy.mlp_extractor.policy_net, policy.action_net]
    return [
        (own.weight.detach().numpy().T, own.bias.detach().numpy())
        for own in linear
        if hasattr(own, "weight")
    ]


def made_by(given: argparse.Namespace) -> str:
    """The command."""
    options = f"--robot {given.robot} --steps {given.steps} --seed {given.seed}"
    return f"python examples/train_adversary.py {options}"


if __name__ == "__main__":
    main()
