"""Plan in a domain."""

from typing import Annotated

import typer

from testbed.cli.common import DONE, FAILED, Domain, examples, input_errors, say

EPILOG = examples(
    'testbed plan office --from "loc(rob1,office1), loc(book1,office2)" --goal "loc(book1,library)"'
)


def command(
    source: Domain,
    state: Annotated[
        list[str], typer.Option("--from", help="Literals; what is left out is false.")
    ],
    goal: Annotated[list[str], typer.Option(help="Literals that are to hold in the end.")],
    limit: Annotated[int, typer.Option(min=0, help="The largest number of actions.")] = 100,
    conformant: Annotated[
        bool, typer.Option("--conformant", help="All outcomes of its actions reach the goal.")
    ] = False,
) -> None:
    """Find a shortest plan of the agent's actions, one line per action.

    Literals have commas between them, and options may be repeated. Of several shortest plans it is
    the first in the order of declaration; where actions have several outcomes, some of them reach
    the goal, with --conformant all do. The exit code is 1 where there is no plan within the limit.
    """
    import asp
    from testbed.protocol import Plans

    with input_errors():
        try:
            plans: Plans = "conformant" if conformant else "optimistic"
            plan = asp.load(source).plan(state, goal, limit, plans)
        except asp.DomainError as error:
            option = "--from" if error.key == ("state",) else "--goal"
            raise asp.DomainError(error.message, option) from None
        for line in (f"no plan of at most {limit} actions",) if plan is None else plan:
            say(line)
    raise typer.Exit(FAILED if plan is None else DONE)
