"""Games of a person at a terminal, who plays one of the two agents."""

from testbed.play.asking import Quit as Quit
from testbed.play.asking import asker as asker
from testbed.play.game import Game as Game
from testbed.play.game import Side as Side
from testbed.play.game import conclusion as conclusion
from testbed.play.game import game_of as game_of
from testbed.play.game import introduction as introduction
from testbed.play.game import keep as keep
from testbed.play.game import played as played
