"""The parallel environment as one of TorchRL's, and a rollout of it.

    python examples/torchrl_rollout.py --steps 20

needs `pip install 'intention-testbed[train]'`.
"""

import argparse

from testbed import office_v0


def main() -> None:
    """Prints the rollout of random legal answers."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--steps", type=int, default=20)
    given = parser.parse_args()
    try:
        from torchrl.envs import PettingZooWrapper
    except ModuleNotFoundError:
        raise SystemExit("needs `pip install 'intention-testbed[train]'`") from None
    env = PettingZooWrapper(
        office_v0.parallel_env("office", max_cycles=30), use_mask=True, categorical_actions=True
    )
    print(env.rollout(given.steps))
    env.close()


if __name__ == "__main__":
    main()
