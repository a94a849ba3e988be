"""Whether the robots of a pair met the same; the trials that were not correct."""

from __future__ import annotations

from collections.abc import Iterator

from papers.levels import evidence
from papers.levels.commands import place
from testbed.studies.levels.comparing import CONDITIONS
from testbed.studies.levels.pairing import MEETINGS
from testbed.studies.levels.published import NO_ZOOM, ZOOM
from testbed.studies.levels.runs import Run
from testbed.text.markdown import markdown, paragraph


def meetings(run: Run) -> Iterator[str]:
    """As a sentence with numbers, and a table by level."""
    whole = evidence.met(run.all_pairs)
    yield "## Did both robots meet the same?"
    yield paragraph(
        f"Of {whole.pairs} pairs, {whole.starts} had the same start for both robots, and "
        f"{whole.goals} the same goal. In {whole.same_events} all exogenous actions were the same, "
        "each at the same step of the robot; in "
        f"{whole.meetings['nothing']} of these there was none. By level:"
    )
    levels = {name: evidence.met(own) for name, own in run.pairs.items()}
    yield markdown(
        ("pairs in which there were", *levels, "all"),
        (
            (text, *(str(own.meetings[kind]) for own in (*levels.values(), whole)))
            for kind, text in MEETINGS.items()
        ),
    )


def failures(run: Run) -> Iterator[str]:
    """Each trial that was not correct, with its replay; and what is counted apart."""
    trials = [
        (pair.level, CONDITIONS[robot], trial)
        for pair in run.all_pairs
        for robot, trial in ((ZOOM, pair.zoom), (NO_ZOOM, pair.no_zoom))
    ]
    wrong = [own for own in trials if own[2].counts.decided and not own[2].counts.correct]
    lost = sum(not trial.counts.played for _, _, trial in trials)
    out = sum(trial.counts.out_of_reach for _, _, trial in trials)
    yield "## Trials that were not correct"
    yield paragraph(
        f"{len(wrong)} of {len(trials)} trials were not correct. Of all, {lost} ended in error or "
        f"without their robot, and {out} where their goal was out of reach."
    )
    lines = [
        f"$ testbed replay {place(run.config)} --trial {trial.trial}"
        f"  # {level}, {robot}: {trial.outcome}"
        for level, robot, trial in wrong
    ]
    if lines:
        yield "\n".join(["```console", *lines, "```"])
