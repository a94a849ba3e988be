"""Robots in threads of one process: controls serve one decision at a time.

Two threads in one control end the interpreter, so that each test has an interpreter of its own.
"""

import subprocess
import sys
from pathlib import Path

import pytest

from testbed.config import load_config
from testbed.experiment.digest import digest
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

OVERRIDES = [
    "robots=[intentional,intentional-plain,traditional]",
    "scenarios=[1,3]",
    "link=inprocess",
]
COMMON = f"""
import asyncio, sys, threading
from concurrent.futures import ThreadPoolExecutor

from testbed.config import load_config
from testbed.experiment.digest import digest
from testbed.experiment.plan import plan_trials
from testbed.experiment.robots import make_robot
from testbed.experiment.trial import play_trial
from testbed.link import InProcessRobot

specs = plan_trials(load_config("quickstart", {OVERRIDES})) * 2
sys.setswitchinterval(1e-5)


def play(spec):
    return play_trial(spec, InProcessRobot(make_robot)).record


"""
POOL = """
with ThreadPoolExecutor(4) as pool:
    records = list(pool.map(play, specs))
"""
ASYNCIO = """
async def all_of_them():
    return await asyncio.gather(*(asyncio.to_thread(play, spec) for spec in specs))

records = asyncio.run(all_of_them())
"""
DASK = """
import dask

played = [dask.delayed(play)(spec, dask_key_name=f"{number}") for number, spec in enumerate(specs)]
records = dask.compute(*played, scheduler="threads", num_workers=4)
"""
# Each decision of a robot is made in another thread than the one before.
WANDERING = """
class Wandering:
    def __init__(self, kind):
        self._robot = make_robot(kind)

    def _elsewhere(self, call, argument):
        with ThreadPoolExecutor(1) as other:
            return other.submit(call, argument).result()

    def begin(self, task):
        self._elsewhere(self._robot.begin, task)

    def act(self, percept):
        return self._elsewhere(self._robot.act, percept)

with ThreadPoolExecutor(4) as pool:
    records = list(pool.map(lambda s: play_trial(s, InProcessRobot(Wandering)).record, specs))
"""
TOLD = """
assert {record.outcome for record in records} <= {"achieved", "false_finish"}, records
print(digest(records))
"""


@pytest.fixture(scope="module")
def alone() -> str:
    """The digest of the same trials, one after the other."""
    specs = plan_trials(load_config("quickstart", OVERRIDES)) * 2
    return digest(play_trial(spec, InProcessRobot(make_robot)).record for spec in specs)


@pytest.mark.parametrize(
    "threads", [POOL, ASYNCIO, DASK, WANDERING], ids=["pool", "asyncio", "dask", "wandering"]
)
def test_robots_in_threads_do_what_they_do_alone(threads: str, alone: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", COMMON + threads + TOLD],
        capture_output=True,
        text=True,
        cwd=Path(__file__).parents[2],
        timeout=500,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, f"{alone}\n"), done.stderr
