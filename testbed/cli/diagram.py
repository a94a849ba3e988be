"""Show the transition diagram of a domain."""

from typing import Annotated

import typer

from testbed.cli.common import Domain, examples, input_errors, say

EPILOG = examples(
    "testbed diagram gate.al", "testbed diagram gate.al --dot | dot -Tsvg -o gate.svg"
)


def command(
    source: Domain, dot: Annotated[bool, typer.Option("--dot", help="As Graphviz text.")] = False
) -> None:
    """List the states of a domain, and where each action leads from each of them.

    An action stands by itself at a step. Diagrams of more than 10,000 states are refused.
    """
    import asp

    with input_errors():
        diagram = asp.load(source).diagram()
        numbers = {state: f"s{number}" for number, state in enumerate(diagram.states)}
        say(f"digraph {_quoted(source)} {{" if dot else f"{len(numbers)} states")
        for state, number in numbers.items():
            literals = ", ".join(sorted(state)) or "nothing"
            say(f"  {number} [label={_quoted(literals)}];" if dot else f"{number}: {literals}")
        for before, action, after in diagram.transitions:
            arrow, label = f"{numbers[before]} -> {numbers[after]}", _quoted(action)
            say(f"  {arrow} [label={label}];" if dot else f"{arrow}: {action}")
        if dot:
            say("}")


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
