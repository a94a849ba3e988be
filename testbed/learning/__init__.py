"""The game for learners: many games at once, and one agent's side of it with the other inside.

Importing this package registers `testbed/Adversary-v0` and `testbed/Robot-v0` with Gymnasium.
"""

from gymnasium import register as _register

from testbed.learning.batch import Batch as Batch
from testbed.learning.batch import Moves as Moves
from testbed.learning.batch import Sight as Sight
from testbed.learning.gymnasium_envs import AdversaryEnv as AdversaryEnv
from testbed.learning.gymnasium_envs import RobotEnv as RobotEnv
from testbed.learning.policies import input_names as input_names
from testbed.learning.policies import save_policy as save_policy
from testbed.learning.table_robots import CHEAPEST as CHEAPEST
from testbed.learning.table_robots import Table as Table
from testbed.learning.vectors import AdversaryVectorEnv as AdversaryVectorEnv

_register(
    "testbed/Adversary-v0",
    entry_point="testbed.learning.gymnasium_envs:AdversaryEnv",
    vector_entry_point="testbed.learning.vectors:make_vector",
)
_register("testbed/Robot-v0", entry_point="testbed.learning.gymnasium_envs:RobotEnv")
