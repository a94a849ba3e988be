"""The game for learners: many games at once, and one agent's side of it with the other inside."""

from testbed.learning.batch import Batch as Batch
from testbed.learning.batch import Moves as Moves
from testbed.learning.batch import Sight as Sight
