"""A game between a robot and an adversary in a world, and its PettingZoo environments.

Import `AECView` and `ParallelView` from the modules `aec` and `parallel`: PettingZoo takes longer
to import than all the rest.
"""

from testbed.environment.allowance import Left as Left
from testbed.environment.core import Core as Core
from testbed.environment.execution import Execution as Execution
from testbed.environment.fine import Pace as Pace
from testbed.environment.fine import RandomGoal as RandomGoal
from testbed.environment.fine import RandomStart as RandomStart
from testbed.environment.fine import fine_core as fine_core
from testbed.environment.rules import ADVERSARY as ADVERSARY
from testbed.environment.rules import ROBOT as ROBOT
from testbed.environment.rules import AdversaryReward as AdversaryReward
from testbed.environment.rules import Ending as Ending
from testbed.environment.rules import EventRules as EventRules
from testbed.environment.rules import Illegal as Illegal
from testbed.environment.rules import IllegalActionError as IllegalActionError
from testbed.environment.rules import Infos as Infos
from testbed.environment.rules import Mode as Mode
from testbed.environment.rules import NotResetError as NotResetError
from testbed.environment.rules import Observability as Observability
from testbed.environment.rules import ResetOptionError as ResetOptionError
from testbed.environment.rules import Rewards as Rewards
from testbed.environment.rules import RobotReward as RobotReward
from testbed.environment.rules import Rules as Rules
from testbed.environment.rules import UnknownAgentError as UnknownAgentError
from testbed.environment.rules import UnknownOptionError as UnknownOptionError
from testbed.environment.rules import rewards as rewards
