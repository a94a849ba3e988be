"""Play against a robot, or as one."""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer

from testbed.cli.common import DONE, FAILED, Config, Overrides, examples, input_errors, refuse, say

if TYPE_CHECKING:
    from testbed.experiment.recorder import Result
    from testbed.play import Game, Side

EPILOG = examples(
    "testbed play office",
    "testbed play office robots=[traditional] adversary.budget=2 adversary.fair=true",
    "testbed play office --as robot adversary.strategy=greedy adversary.rate=0.3",
    "printf '3\\n0\\n0\\nq\\n' | testbed play office",
)
SIDES = {"adversary": (), "robot": ("robots=[human]", "baseline=null", "treatment=[]")}
"""By the agent that is played the keys that say so."""


def command(
    config: Config,
    overrides: Overrides = None,
    side: Annotated[
        str, typer.Option("--as", metavar="AGENT", help="The agent to play: adversary or robot.")
    ] = "adversary",
    out: Annotated[
        Path | None, typer.Option(help="Run folder; without it runs/play-NAME, numbered if taken.")
    ] = None,
) -> None:
    """Play one trial of a configuration at the keyboard, as the adversary or as the robot.

    The world is drawn at each step. As the adversary you see all of it, and the robot's mind: its
    belief, intention, plan and explanation; your choices are the legal events. As the robot you
    see what it sees; choices that look impossible come last. The other side is the first robot, or
    the adversary, of the configuration.

    Choose by arrow keys and Enter, or by number; without a terminal by number, one line each. q
    leaves. The game that is over is kept as a run, for `testbed replay`.
    """
    if side not in SIDES:
        refuse([f"--as: '{side}' is not an agent; it is adversary or robot"])
    with input_errors():
        from testbed.cli.loading import load
        from testbed.experiment.checks import CHECKS
        from testbed.experiment.run_folder import choose_folder

        if out is not None:
            choose_folder(out, "", resume=False)
        loaded = load(config, [*(overrides or []), *SIDES[side]], checks=CHECKS)
        from testbed.play import conclusion, game_of

        game = game_of(loaded, cast("Side", side))
        result = _played(game)
        for line in ("", *conclusion(result.record)):
            say(line)
        folder = choose_folder(out, f"play-{loaded.name}", resume=False)
        _keep(game, result, folder)
    raise typer.Exit(FAILED if result.record.cause else DONE)


def _played(game: "Game") -> "Result":
    """The result of a game; who leaves it before its end leaves the command."""
    from testbed.experiment.interrupts import INTERRUPTED, stoppable
    from testbed.play import Quit, asker, introduction, played
    from testbed.text import Printer

    shown = Printer()
    for line in introduction(game):
        shown(line)
    left = "the game is not over: nothing is kept"
    try:
        with stoppable(left, quiet=True), asker(shown) as person:
            return played(game, person, shown)
    except (Quit, KeyboardInterrupt) as reason:
        shown(left)
        interrupted = isinstance(reason, KeyboardInterrupt)
        raise typer.Exit(INTERRUPTED if interrupted else DONE) from None


def _keep(game: "Game", result: "Result", folder: Path) -> None:
    from testbed.experiment.lock import locked
    from testbed.play import keep
    from testbed.report import write_report

    with locked(folder):
        trial = keep(game, result, folder, ["testbed", *sys.argv[1:]])
        from testbed.experiment.run_folder import read_config

        write_report(folder, read_config(folder))
    say(f"kept in {folder}; to see it again: {_again(folder, trial)}")


def _again(folder: Path, trial: str) -> str:
    return shlex.join(["testbed", "replay", str(folder), "--trial", trial])
