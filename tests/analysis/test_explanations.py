"""How well a robot explained: counted by hand, and by an oracle of its own over random trials."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import polars as pl
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asp.language import Action, Literal
from testbed.analysis import load_run
from testbed.analysis.export import PARQUET, export
from testbed.analysis.table import table_of
from testbed.config import load_config
from testbed.experiment.record import At, Explained, FineCounts, Occurrence, Report, TrialRecord
from testbed.experiment.runner import run
from tests.experiment.samples import a_record
from tests.experiment.test_unproved_steps import LOCKER

INFINITY = 10**9


def at(step: int, action: str) -> At:
    return At(step, Literal.parse(action))


def event(step: int, action: str, observed: bool = False) -> Occurrence:
    return Occurrence(step, Literal.parse(action), observed)


def report(told: int, step: int, action: str, true: bool) -> Report:
    return Report(told, step, Literal.parse(action), true)


def adopted(step: int, *unobserved: At, **others: Any) -> Explained:
    others["exceptions"] = [*map(Literal.parse, others.get("exceptions", []))]
    return Explained(step, [*unobserved], **others)


def counted(**values: Any) -> dict[str, Any]:
    """The columns of the table about explanations of one record with these values."""
    (row,) = table_of([a_record(**values)]).to_dicts()
    return {k.removeprefix("quality."): v for k, v in row.items() if k.startswith("quality.")}


def by_hand(**values: Any) -> dict[str, Any]:
    """The columns where no others than these differ from 0, or from null where they are means."""
    nothing = dict.fromkeys(counted(), 0) | {"latency": None, "alternatives": None}
    assert set(values) <= set(nothing)
    return nothing | values


def test_a_ferry_that_drifted_is_looked_for_in_the_wrong_cove_first() -> None:
    drifted = counted(
        exogenous=[event(2, "drift(ferry,cove)")],
        explanations=[
            adopted(4, at(3, "drift(ferry,bay)"), alternatives=3),
            adopted(6, at(3, "drift(ferry,cove)"), alternatives=0, more_alternatives=True),
        ],
    )
    assert drifted == by_hand(
        unobserved=1,
        followed=1,
        action_last=1,
        explained=1,
        latency=4.0,
        adopted=2,
        alternatives=1.5,
        more_alternatives=1,
        assumed=2,
        false=1,
    )


def test_a_baker_who_is_told_needs_no_explanation() -> None:
    """Of the flour at once, of the oven late, of the salt never, and nobody spilled the milk."""
    told = counted(
        exogenous=[
            event(1, "fetch(flour)", observed=True),
            event(3, "cool(oven)", observed=True),
            event(5, "spill(salt)"),
        ],
        reports=[
            report(2, 1, "fetch(flour)", True),
            report(4, 3, "spill(milk)", False),
            report(7, 3, "cool(oven)", True),
        ],
        explanations=[
            adopted(
                4,
                at(2, "break(oven)"),
                distrusted=[at(3, "spill(milk)"), at(1, "fetch(flour)"), at(3, "knead(dough)")],
            ),
            adopted(5, at(2, "break(oven)"), at(3, "cool(oven)")),
            adopted(7),
        ],
    )
    assert told == by_hand(
        unobserved=2,
        followed=1,
        action_last=1,
        step_last=1,
        explained=1,
        latency=2.0,
        adopted=2,
        assumed=2,
        false=1,
        distrusted=2,
        wrongly_distrusted=1,
    )


def test_a_keeper_takes_a_swarm_for_a_hive_that_was_empty_from_the_start() -> None:
    """An explanation follows the event and lacks it; exceptions are judged by the true start."""
    found = counted(
        initial=[Literal.parse("sealed(hive1)")],
        exogenous=[event(1, "swarm(hive1)")],
        explanations=[
            adopted(2, exceptions=["-full(hive1)"]),
            adopted(3, exceptions=["-full(hive1)", "-sealed(hive1)", "full(hive2)"]),
        ],
    )
    assert found == by_hand(unobserved=1, followed=1, adopted=2, exceptions=3, false_exceptions=2)


def test_one_assumption_stands_for_one_event_and_keeps_to_its_step() -> None:
    twice = [event(2, "drift(ferry,cove)"), event(8, "drift(ferry,cove)")]
    one = adopted(9, at(8, "drift(ferry,cove)"))
    assert counted(exogenous=twice, explanations=[one]) == by_hand(
        unobserved=2,
        followed=2,
        action_first=1,
        action_last=1,
        step_first=1,
        step_last=1,
        explained=1,
        latency=1.0,
        adopted=1,
        assumed=1,
    )
    both = adopted(10, at(3, "drift(ferry,cove)"), at(8, "drift(ferry,cove)"))
    found = counted(exogenous=twice, explanations=[one, both])
    assert (found["action_first"], found["action_last"], found["step_last"]) == (1, 2, 1)
    assert (found["explained"], found["latency"]) == (2, (1 + 8) / 2)
    assert (found["assumed"], found["false"]) == (2, 0)


def test_what_was_assumed_before_it_happened_was_false() -> None:
    found = counted(
        exogenous=[event(5, "spill(salt)")], explanations=[adopted(4, at(3, "spill(salt)"))]
    )
    assert found == by_hand(unobserved=1, adopted=1, assumed=1, false=1)


def test_another_outcome_of_an_action_is_an_explanation_without_the_event() -> None:
    found = counted(
        exogenous=[event(2, "spill(salt)")],
        explanations=[adopted(4, outcomes=[at(3, "knead(dough)")])],
    )
    assert found == by_hand(unobserved=1, followed=1, adopted=1)


def test_of_older_records_without_reports_what_was_told_was_told_at_once() -> None:
    assert counted(exogenous=[event(2, "spill(salt)", observed=True)]) == by_hand()


def test_at_the_fine_resolution_nothing_is_counted() -> None:
    fine = counted(level="L1", fine=FineCounts(), exogenous=[event(2, "spill(salt)")])
    assert set(fine.values()) == {None}


def oracle(record: TrialRecord) -> dict[str, Any]:
    """The same numbers, straight from their definitions in docs/results.md."""
    found = by_hand()
    told = {
        (e.step, e.action): min(
            [r.told for r in record.reports if (r.step, r.action) == (e.step, e.action)],
            default=e.step + 1 if e.observed else INFINITY,
        )
        for e in record.exogenous
    }
    hidden = sorted(e for e in told if told[e] > e[0] + 1)
    each = [
        e for e in record.explanations if e.unobserved or e.exceptions or e.distrusted or e.outcomes
    ]
    waits, first_seen = [], set()
    for step, action in hidden:
        follow = [e for e in each if step < e.step < told[step, action]]
        named = [_step_given(e, (step, action), hidden, told) for e in follow]
        found["followed"] += bool(follow)
        for place, name in ((0, "first"), (-1, "last")):
            if follow:
                found[f"action_{name}"] += named[place] is not None
                found[f"step_{name}"] += named[place] == step
        right = [e.step - step for e, own in zip(follow, named, strict=True) if own is not None]
        waits += right[:1]
    for explained in each:
        for own in {(a.step, a.action) for a in explained.unobserved} - first_seen:
            first_seen.add(own)
            true = [e for e in hidden if e[0] < explained.step < told[e]]
            given = {_step_given(explained, e, hidden, told) for e in true if e[1] == own[1]}
            found["false"] += own[0] not in given
    exceptions = {text for e in each for text in e.exceptions}
    taken = {(a.step, a.action) for e in each for a in e.distrusted}
    reports = {(r.step, r.action): r.true for r in record.reports}
    listed = [e.alternatives for e in each if e.alternatives is not None]
    return found | {
        "unobserved": len(hidden),
        "explained": len(waits),
        "latency": sum(waits) / len(waits) if waits else None,
        "adopted": len(each),
        "alternatives": sum(listed) / len(listed) if listed else None,
        "more_alternatives": sum(e.more_alternatives for e in each),
        "assumed": len(first_seen),
        "exceptions": len(exceptions),
        "false_exceptions": sum(
            (text.removeprefix("-") in record.initial) == text.startswith("-")
            for text in exceptions
        ),
        "distrusted": len(taken & set(reports)),
        "wrongly_distrusted": sum(reports.get(own, False) for own in taken),
    }


def _step_given(
    explained: Explained,
    event: tuple[int, Action],
    hidden: Iterable[tuple[int, Action]],
    told: dict[tuple[int, Action], int],
) -> int | None:
    """The step of the assumed event that stands for this one, among those of its action."""
    assumed = sorted({a.step for a in explained.unobserved if a.action == event[1]})
    true = [s for s, a in hidden if a == event[1] and s < explained.step < told[s, a]]
    if event[0] in assumed:
        return event[0]
    rest = [s for s in assumed if s not in true]
    place = [s for s in true if s not in assumed].index(event[0])
    return rest[place] if place < len(rest) else None


ACTIONS = st.sampled_from(["drift(ferry,cove)", "drift(ferry,bay)", "sink(buoy)"])
STEPS = st.integers(1, 6)
EVENTS = st.builds(at, STEPS, ACTIONS)
LITERALS = st.sampled_from(["-moored(ferry)", "moored(ferry)", "-lit(buoy)", "lit(buoy)"])


@st.composite
def records(draw: st.DrawFn) -> TrialRecord:
    """Any history of a few events, told at once, late or never, and any explanations of it."""
    events = draw(st.lists(st.tuples(STEPS, ACTIONS), unique=True, max_size=4))
    delays = [draw(st.integers(0, 4)) for _ in events]
    false = draw(st.lists(st.tuples(STEPS, ACTIONS), unique=True, max_size=2))
    told = {e: late for e, late in zip(events, delays, strict=True) if late}
    steps = draw(st.lists(st.integers(1, 8), unique=True, max_size=4).map(sorted))
    return a_record(
        initial=[*map(Literal.parse, draw(st.sets(LITERALS.filter(lambda own: own[0] != "-"))))],
        exogenous=[event(*e, observed=e in told) for e in events],
        reports=[report(e[0] + late, *e, True) for e, late in told.items()]
        + [report(e[0] + 1, *e, False) for e in false if e not in events],
        explanations=[
            adopted(
                step,
                *draw(st.lists(EVENTS, max_size=3)),
                exceptions=draw(st.lists(LITERALS, max_size=2)),
                distrusted=draw(st.lists(EVENTS, max_size=2)),
                alternatives=draw(st.none() | st.integers(0, 3)),
            )
            for step in steps
        ],
    )


@given(records())
def test_any_history_is_counted_as_by_the_definitions(record: TrialRecord) -> None:
    values = {name: getattr(record, name) for name in ("initial", "exogenous", "reports")}
    found = counted(**values, explanations=record.explanations)
    assert found == pytest.approx(oracle(record))
    assert found["step_first"] <= found["action_first"] <= found["followed"]
    assert found["step_last"] <= found["action_last"] <= found["explained"] <= found["followed"]
    assert found["followed"] <= found["unobserved"]
    assert found["false"] <= found["assumed"]


SETTINGS = """\
name: parcel
domain: locker.al
goal: ["at(crate,dock)", "-has(pia,crate)"]
robots: [intentional, traditional]
link: inprocess
seed: 3
limit: 10
exogenous_while_thinking: true
adversary: {strategy: random, rate: 0.4}
relevance: all
observability: {shift: {mode: always, probability: 0.3, delay: 2, false_reports: 0.2}}
limits: {steps: 16, plan: 8}
"""


def test_played_trials_are_counted_as_by_the_definitions(tmp_path: Path) -> None:
    """In the table, and in the exported one: of both robots, with late and false reports."""
    (tmp_path / "locker.al").write_text(LOCKER, encoding="utf-8")
    (tmp_path / "parcel.yaml").write_text(SETTINGS, encoding="utf-8")
    run(load_config(tmp_path / "parcel.yaml"), tmp_path / "run", workers=0)
    export(tmp_path / "run")
    found = load_run(tmp_path / "run")
    exported = pl.read_parquet(tmp_path / "run" / PARQUET)
    total: dict[str, Any] = {}
    for record, row in zip(found.records(), exported.to_dicts(), strict=True):
        own = {name: row[f"quality.{name}"] for name in by_hand()}
        assert own == pytest.approx(oracle(record))
        total = {name: total.get(name, 0) + (value or 0) for name, value in own.items()}
    for name in ("unobserved", "explained", "assumed", "false", "distrusted"):
        assert total[name]
    looks = found.trials.group_by("robot").agg(pl.col("quality.alternatives").count())
    assert dict(looks.iter_rows())["traditional"] == 0
    assert dict(looks.iter_rows())["intentional"] > 0
