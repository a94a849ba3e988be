"""Both agents of several games as one vector environment of SuperSuit.

    python examples/supersuit_vectors.py --games 4 --steps 100

Spaces have to be equal, so that observations are padded; an illegal answer counts as `noop`.
"""

import argparse

import numpy as np

from testbed import office_v0


def main() -> None:
    """Plays random legal answers, and says how many games were achieved."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--games", type=int, default=4)
    parser.add_argument("--steps", type=int, default=100)
    given = parser.parse_args()
    try:
        import supersuit
    except ModuleNotFoundError:
        raise SystemExit("needs `pip install 'intention-testbed[train]'`") from None
    env = office_v0.parallel_env("office", padded=True, illegal="noop", max_cycles=30)
    vector = supersuit.concat_vec_envs_v1(
        supersuit.pettingzoo_env_to_vec_env_v1(env), given.games, base_class="gymnasium"
    )
    random = np.random.default_rng(1)
    seen, _ = vector.reset(seed=1)
    ends = 0
    for _ in range(given.steps):
        masks = seen["action_mask"]
        answers = (masks * random.random(masks.shape)).argmax(axis=1)
        seen, _, terminated, truncated, _ = vector.step(answers)
        ends += int((terminated | truncated).sum()) // 2
    print(f"{given.steps} steps of {given.games} games, {ends} of which came to an end")
    vector.close()


if __name__ == "__main__":
    main()
