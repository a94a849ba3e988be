"""A filmstrip of a scenario, as the environment draws it.

    python examples/filmstrip.py docs/images/office.png

plays the quickstart's second scenario, unexpected success, and draws two of its moments.
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from testbed import office_v0
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.storyteller import Moment
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

SCENARIO = 2
STEPS = (3, 4)


def main(target: Path) -> None:
    """Plays the scenario, then again for the pictures of what happened."""
    config = load_config("quickstart", [f"scenarios=[{SCENARIO}]", "robots=[intentional]"])
    (spec,) = plan_trials(config)
    moments: list[Moment] = []
    play_trial(spec, InProcessRobot(make_robot), moments.append)
    environment = office_v0.parallel_env(config=config, render_mode="rgb_array")
    environment.reset(seed=spec.seed)
    frames = []
    for moment in moments:
        if moment.percept.step in STEPS:
            frames.append(environment.render())
        environment.step(
            {
                "robot_0": environment.core.robot_actions.index(moment.decision.action),
                "adversary_0": environment.core.adversary_actions.index(moment.event or "none"),
            }
        )
    Image.fromarray(np.vstack(frames)).save(target)
    print(f"wrote {target}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "filmstrip.png"))
