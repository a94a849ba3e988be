"""What the comments of a description say of its scenarios."""

from __future__ import annotations

from asp.language import syntax
from asp.language.parser import parse


def scenario_notes(text: str, file: str = "<text>") -> dict[str, str]:
    """The comment right above the first statement of each scenario that has one, as a sentence.

    A scenario's name in front is left out: `% 3: a book leaves.` is `A book leaves.` Raises
    SourceError.
    """
    source = parse(text, file)
    comments = {comment.line: comment.text for comment in source.comments if comment.alone}
    notes: dict[str, str] = {}
    for statement in source.statements:
        if isinstance(statement, syntax.TriggerStatement | syntax.QuietStatement):
            note = _above(statement.place.line, comments)
            notes.setdefault(statement.scenario, _sentence(note, statement.scenario))
    return {scenario: note for scenario, note in notes.items() if note}


def _above(line: int, comments: dict[int, str]) -> str:
    lines: list[str] = []
    while line - 1 in comments:
        line -= 1
        lines.insert(0, comments[line].lstrip("% "))
    return " ".join(lines)


def _sentence(note: str, scenario: str) -> str:
    for sign in (",", ":"):
        note = note.removeprefix(f"{scenario}{sign} ")
    return note[:1].upper() + note[1:]
