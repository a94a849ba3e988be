"""What clingo alone finds in the program of a decision."""

from dataclasses import dataclass

import clingo


@dataclass(frozen=True)
class Found:
    """What the last answer set says: the intention, a plan to start, the state believed in."""

    intention: str
    plan: list[str]
    believed: set[str]


def found_by_clingo(text: str) -> Found:
    """What clingo finds in the text, and nothing else."""
    said: list[str] = []
    control = clingo.Control(logger=lambda _, message: said.append(message))
    control.add("base", [], text)
    control.ground([("base", [])])
    found: list[Found] = []

    def keep(model: clingo.Model) -> None:
        shown = model.symbols(shown=True)
        ((action, _),) = (s.arguments for s in shown if s.match("intended_action", 2))
        started = action.arguments if action.match("start", 1) else []
        plans = (s.arguments for s in shown if s.match("plan", 3))
        plan = sorted((index.number, str(step)) for name, index, step in plans if name in started)
        believed = {str(s.arguments[0]) for s in shown if s.match("believed", 1)}
        found.append(Found(str(action), [step for _, step in plan], believed))

    control.solve(on_model=keep)
    assert not said
    return found[-1]
