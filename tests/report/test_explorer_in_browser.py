"""The explorer of the report in a real browser: filters, pairs, steps, links, keys, copies."""

import json
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from asp.language import Action, Literal, read_domain, scenario_notes
from testbed.config import load_config
from testbed.experiment.plan import plan_trials
from testbed.experiment.record import Attempt, TrialRecord
from testbed.experiment.robots import make_robot
from testbed.experiment.run_folder import REPORT
from testbed.experiment.store import TrialWriter
from testbed.experiment.trial import Moment, play_trial
from testbed.link import InProcessRobot
from testbed.report import write_report
from testbed.world import load_world
from tests.experiment.samples import a_record
from tests.report.browser import AXE_CORE, CHROMIUM, DESK, PHONE, Browser, Tab
from tests.report.explorer import ROBOT, STEP, Played, chosen, drawn, slide, text

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")

PLAYS = "document.querySelector('.player').matches('.plays')"
HOME, END, LEFT, RIGHT = ("Home", 36), ("End", 35), ("ArrowLeft", 37), ("ArrowRight", 39)
SPACE = (" ", 32)


@pytest.fixture
def opened(browser: Browser, run: Played) -> Callable[..., Tab]:
    """Opens the page at a step of a trial."""

    def tab(record: TrialRecord, step: int = 1, width: int = DESK, **media: str) -> Tab:
        return Tab(browser, run.address(record, step), width, media.pop("scheme", "light"), **media)

    return tab


def _moments(run: Played, record: TrialRecord) -> list[Moment]:
    """The steps of a trial, played again."""
    moments: list[Moment] = []
    spec = next(own for own in plan_trials(run.config) if own.trial == record.trial)
    play_trial(spec, InProcessRobot(make_robot), moments.append)
    return moments


def test_a_filter_leaves_just_the_trials_with_its_value(browser: Browser, run: Played) -> None:
    tab = Tab(browser, run.page, DESK, "light")
    keys = {"condition": "cell", "scenario": "scenario", "robot": "robot", "outcome": "outcome"}
    shown = tab.evaluate("[...document.querySelectorAll('.filters select')].map(own => own.name)")
    assert sorted(shown) == sorted(keys)
    for key, column in keys.items():
        for value in {getattr(record, column) for record in run.records}:
            expected = [r.trial for r in run.records if getattr(r, column) == value]
            assert sorted(chosen(tab, key, value)) == sorted(expected), (key, value)
            count = tab.evaluate("document.querySelector('.count').textContent")
            assert count.split()[0] == str(len(expected))
        assert len(chosen(tab, key, "")) == len(run.records)


def test_pairs_in_which_a_robot_failed_come_first(browser: Browser, run: Played) -> None:
    tab = Tab(browser, run.page, DESK, "light")
    failed = "[...document.querySelectorAll('.found li')].map(own => !!own.querySelector('.bad'))"
    bad = tab.evaluate(failed)
    pairs = {(r.cell, r.pair) for r in run.records if r.outcome != "achieved"}
    assert bad == sorted(bad, reverse=True)
    assert sum(bad) == len(pairs) > 0


def test_both_robots_of_a_pair_are_on_one_time_line(
    opened: Callable[..., Tab], run: Played
) -> None:
    record = run.one("5", "traditional")
    both = [r for r in run.records if (r.pair, r.cell) == (record.pair, record.cell)]
    tab = opened(record)
    for number, own in enumerate(sorted(both, key=lambda r: r.robot)):
        assert text(tab, "name", number) == own.robot
        marks = f"document.querySelectorAll('.system .strip')[{number}].querySelectorAll('i')"
        kinds = tab.evaluate(f"[...{marks}].map(own => own.classList[0])")
        done = {a.step: "done" if a.happened else "failed" for a in own.actions}
        steps = range(1, own.steps + 1)
        assert kinds == [*(done.get(step, "mental") for step in steps), "end"]
        touched = [e.step for e in own.exogenous]
        numbers = (
            f"[...{marks}].filter(own => own.matches('.touched')).map(own => +own.dataset.step)"
        )
        assert tab.evaluate(numbers) == touched
    beneath = """(() => {
      const middles = [...document.querySelectorAll('.system .strip')]
        .map(strip => [...strip.children].map(own => own.offsetLeft + own.offsetWidth / 2));
      return middles[1].every((own, at) => own === (middles[0][at] ?? own));
    })()"""
    assert tab.evaluate(beneath) is True


@pytest.mark.parametrize(("scenario", "robot"), [("2", "traditional"), ("5", "intentional")])
def test_the_slider_shows_the_state_of_each_step(
    opened: Callable[..., Tab], run: Played, scenario: str, robot: str
) -> None:
    """The states are followed here from the record by the laws of the domain."""
    record, world = run.one(scenario, robot), load_world("office")
    rooms, names = world.description.sorts["room"], ["rob1", "book1", "book2"]
    tab, state = opened(record), world.state(record.initial)
    tab.evaluate("document.querySelector('.beside input').click()")
    for step in range(1, record.steps + 2):
        slide(tab, step)
        assert tab.evaluate(STEP).split()[1] == str(step)
        at = {a.arguments[0]: a.arguments[1] for a in world.true_atoms(state) if a.name == "loc"}
        assert drawn(tab, names, rooms) == [at[name] for name in names], step
        own = [a.action for a in record.actions if a.step == step and a.happened]
        others = [e.action for e in record.exogenous if e.step == step]
        if own or others:
            state = world.successor(state, [*map(Action.parse, map(str, [*own, *others]))])
    assert text(tab, "outcome").split(maxsplit=1)[1] == record.outcome.replace("_", " ")


def test_what_a_robot_has_wrong_is_marked_and_listed(
    opened: Callable[..., Tab], run: Played
) -> None:
    """Whatever it believes is compared here with the state of the world at the same step."""
    record, world = run.one("2", "traditional"), load_world("office")
    tab, seen = opened(record), 0
    tab.evaluate("document.querySelector('.beside input').click()")
    for moment in _moments(run, record):
        step, belief = moment.percept.step, {*map(str, moment.decision.trace.belief)}
        slide(tab, step)
        marked = tab.evaluate(f"{ROBOT}[0].querySelector('[data-part=belief]').matches('.wrong')")
        told = tab.evaluate(
            f"[...{ROBOT}[0].querySelectorAll('.differs code')].map(own => own.textContent)"
        )
        true = {*map(str, world.true_atoms(moment.before))}
        wrong = [*(true - belief), *(f"-{own}" for own in belief - true)] if belief else []
        assert sorted(told) == sorted(wrong), step
        assert marked is bool(wrong)
        for literal in (own for own in wrong if own.startswith("-loc")):
            thing, room = Literal.parse(literal).complement.arguments
            rooms = world.description.sorts["room"]
            assert drawn(tab, [thing], rooms, "belief") == [room]
            assert "≠" in text(tab, "belief").replace("≠ In truth", "")
            seen += 1
    assert seen > 0


def test_a_step_tells_the_mind_of_the_robot(opened: Callable[..., Tab], run: Played) -> None:
    record = run.one("2", "intentional")
    explained = record.explanations[0]
    trace = _moments(run, record)[explained.step - 1].decision.trace
    tab = opened(record, explained.step)
    told = text(tab, "mind")
    for event in explained.unobserved:
        assert event.action in told
    for contrary in explained.contradictions:
        assert str(contrary.observed) in told
    assert str(trace.intention) in told
    assert trace.reason in told
    note = scenario_notes(*reversed(read_domain("office")))[record.scenario]
    assert tab.evaluate("document.querySelector('[data-part=note]').textContent") == note
    event = record.exogenous[0]
    slide(tab, event.step)
    assert str(event.action) in text(tab, "event")
    assert "unseen" in text(tab, "event")


def test_a_link_leads_to_a_step_and_back(opened: Callable[..., Tab], run: Played) -> None:
    record, other = run.one("5", "intentional"), run.one("6", "intentional")
    tab = opened(record, 3)
    assert tab.evaluate(STEP).split()[1] == "3"
    assert record.trial in text(tab, "command")
    tab.press(*RIGHT)
    tab.until(f"location.hash === '#trial={record.trial}&step=4'")
    tab.evaluate(f"document.querySelector('.found [data-trial=\"{other.trial}\"]').click()")
    tab.until(f"{ROBOT}[0].textContent.includes('{other.trial}')")
    assert f"trial={other.trial}" in tab.evaluate("location.hash")
    tab.evaluate("history.back()")
    tab.until(f"{ROBOT}[0].textContent.includes('{record.trial}')")
    assert tab.evaluate(STEP).split()[1] == "4"
    link = tab.evaluate(f"{ROBOT}[1].querySelector('[data-part=link]').hash")
    partner = run.one("5", "traditional")
    assert link == f"#trial={partner.trial}&step=4"


def test_back_leads_to_what_was_shown_at_first(browser: Browser, run: Played) -> None:
    other = run.one("6", "intentional")
    tab = Tab(browser, run.page, DESK, "light")
    first = text(tab, "command")
    assert other.trial not in first
    tab.evaluate(f"document.querySelector('.found [data-trial=\"{other.trial}\"]').click()")
    tab.until(f"{ROBOT}[0].textContent.includes('{other.trial}')")
    tab.evaluate("history.back()")
    tab.until(f"{ROBOT}[0].textContent.includes({json.dumps(first)})")


def test_keys_move_through_a_trial(opened: Callable[..., Tab], run: Played) -> None:
    record = run.one("5", "intentional")
    tab = opened(record)
    last = record.steps + 1
    for key, step in ((END, last), (LEFT, last - 1), (HOME, 1), (RIGHT, 2), (RIGHT, 3), (LEFT, 2)):
        tab.press(*key)
        assert tab.evaluate(STEP).split()[1] == str(step)
    said = tab.evaluate("document.querySelector('[aria-live]').textContent")
    assert str(record.actions[0].action) in said
    tab.press(*SPACE)
    assert tab.evaluate(PLAYS) is True
    tab.until(f"Number({STEP}.split(' ')[1]) >= 4")
    tab.press(*SPACE)
    assert tab.evaluate(PLAYS) is False
    tab.press(*END)
    assert tab.evaluate(STEP).split()[1] == str(last)


def test_it_plays_to_the_end_and_stops(opened: Callable[..., Tab], run: Played) -> None:
    record = run.one("2", "intentional")
    tab = opened(record, 99)
    tab.evaluate("document.querySelector('[data-go=back]').click()")
    tab.evaluate("document.querySelector('[data-go=play]').click()")
    assert tab.evaluate(PLAYS) is True
    tab.until(f"!{PLAYS}")
    assert tab.evaluate("document.querySelector('input[type=range]').matches('[max=\"11\"]')")
    assert tab.evaluate(STEP).split()[1] == tab.evaluate(STEP).split()[3]


def test_where_motion_is_to_be_reduced_nothing_moves_by_itself(
    opened: Callable[..., Tab], run: Played
) -> None:
    tab = opened(run.one("5", "intentional"), motion="reduce")
    tab.press(*SPACE)
    assert tab.evaluate(STEP).split()[1] == "2"
    assert tab.evaluate(PLAYS) is False


@pytest.mark.parametrize("allowed", [True, False])
def test_the_command_is_copied_or_else_selected(
    opened: Callable[..., Tab], run: Played, allowed: bool
) -> None:
    record = run.one("6", "traditional")
    tab = opened(record)
    clipboard = "{writeText: async text => { window.copied = text; }}" if allowed else "undefined"
    tab.evaluate(f"Object.defineProperty(navigator, 'clipboard', {{value: {clipboard}}})")
    own = f"[...{ROBOT}].find(own => own.textContent.includes('{record.trial}'))"
    tab.evaluate(f"{own}.querySelector('[data-part=copy]').click()")
    tab.until(f"{own}.querySelector('[data-part=copied]').textContent")
    copied = tab.evaluate("window.copied" if allowed else "getSelection().toString()")
    assert copied == f"testbed replay {run.page.parent} --trial {record.trial}"


def test_one_robot_can_be_looked_at_alone(opened: Callable[..., Tab], run: Played) -> None:
    record = run.one("5", "traditional")
    tab = opened(record, 2)
    assert tab.evaluate(f"{ROBOT}.length") == 2
    tab.evaluate("document.querySelector('.beside input').click()")
    assert tab.evaluate(f"{ROBOT}.length") == 1
    assert text(tab, "name") == "traditional"
    assert tab.evaluate(STEP).split()[1] == "2"


def test_a_phone_compares_a_pair(opened: Callable[..., Tab], run: Played) -> None:
    """Both worlds beside the buttons fit in a screen; then both beliefs follow, then both minds."""
    record = run.one("2", "traditional")
    tab = opened(record, 5, PHONE)
    assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE
    score = "document.querySelector('.score').getBoundingClientRect()"
    assert tab.evaluate(f"{score}.right <= {PHONE} && {score}.height < 300")
    assert tab.evaluate("document.querySelectorAll('.system .strip').length") >= 2
    widths = "[...document.querySelectorAll('.robot svg')].map(own => own.clientWidth)"
    assert PHONE // 2 < min(tab.evaluate(widths)) <= PHONE
    parts = "'.robot header, [data-part=world], [data-part=belief], [data-part=mind]'"
    boxes = f"""[...document.querySelectorAll({parts})]
      .filter(own => own.clientHeight).map(own => {{
        const box = own.getBoundingClientRect();
        return [own.dataset.part ?? 'name', Math.round(box.top), Math.round(box.bottom)];
      }}).sort((a, b) => a[1] - b[1])"""
    bar = tab.evaluate("document.querySelector('.transport').offsetHeight")
    both = [r.steps for r in run.records if (r.pair, r.cell) == (record.pair, record.cell)]
    for step in range(1, min(both) + 1):
        slide(tab, step)
        placed = tab.evaluate(boxes)
        order = ["name", "world"] * 2 + ["belief"] * 2 + ["mind"] * 2
        assert [part for part, _, _ in placed] == order
        assert all(above[2] <= below[1] for above, below in pairwise(placed))
        assert placed[3][2] - placed[0][1] <= tab.evaluate("innerHeight") - bar


def test_where_a_time_line_wraps_a_robot_that_is_over_has_no_row(
    browser: Browser, tmp_path: Path
) -> None:
    steps = {"brief": 3, "lasting": 60}
    with TrialWriter(tmp_path) as writer:
        for robot, count in steps.items():
            writer.append(a_record(f"t-{robot}", pair="one", robot=robot, steps=count))
    write_report(tmp_path, load_config("office"))
    tab = Tab(browser, tmp_path / REPORT, PHONE, "light")
    rows: list[list[tuple[str, int]]] = tab.evaluate(
        "[...document.querySelectorAll('.system')].map(own => [...own.querySelectorAll('.who')]"
        ".map(who => [who.textContent, who.nextElementSibling.children.length]))"
    )
    assert len(rows) > 1
    assert [[name for name, _ in row] for row in rows] == [[*steps], *[["lasting"]] * len(rows[1:])]
    assert all(count for row in rows for _, count in row)
    assert sum(count for row in rows for name, count in row if name == "lasting") == 61


def test_a_step_leaves_the_page_where_its_reader_is(
    opened: Callable[..., Tab], run: Played
) -> None:
    tab = opened(run.one("2", "traditional"), 2, PHONE, motion="reduce")  # scrolls at once
    seen = f"{ROBOT}[1].querySelector('[data-part=world]')"
    at = f"[{seen}, document.querySelector('.score')].map(own => own.getBoundingClientRect().y)"
    tab.evaluate(f"{seen}.scrollIntoView({{behavior: 'instant'}})")
    before, score = tab.evaluate(at)
    assert score < 0
    tab.evaluate("document.querySelector('[data-go=on]').click()")
    assert tab.evaluate(STEP).split()[1] == "3"
    assert tab.evaluate(at)[0] == pytest.approx(before, abs=2)


@AXE_CORE
@pytest.mark.parametrize(("width", "scheme"), [(DESK, "light"), (DESK, "dark"), (PHONE, "light")])
def test_no_rule_of_accessibility_is_broken_where_a_belief_is_wrong(
    opened: Callable[..., Tab], run: Played, width: int, scheme: str
) -> None:
    tab = opened(run.one("2", "traditional"), 5, width, scheme=scheme)
    assert tab.evaluate("document.querySelectorAll('.wrong svg').length") == 1
    tab.evaluate("document.querySelectorAll('.robot details').forEach(own => own.open = true)")
    assert tab.violations() == []


def test_nothing_is_asked_for_or_complained_of_while_it_is_used(
    opened: Callable[..., Tab], run: Played
) -> None:
    tab = opened(run.one("5", "intentional"))
    for key in (END, HOME, RIGHT):
        tab.press(*key)
    for trial in tab.evaluate(
        "[...document.querySelectorAll('.found [data-trial]')].map(own => own.dataset.trial)"
    ):
        tab.evaluate(f"document.querySelector('.found [data-trial=\"{trial}\"]').click()")
        tab.until(f"document.querySelector('.robots').textContent.includes('{trial}')")
    asked: list[Any] = tab.events("Network.requestWillBeSent")
    urls = {event["request"]["url"] for event in asked}
    assert {url for url in urls if not url.startswith("data:")} == {run.page.as_uri()}
    assert tab.complaints() == []


def test_texts_that_would_break_out_of_the_page_are_shown_as_text(
    browser: Browser, tmp_path: Path
) -> None:
    hostile = "</script><img src=x onerror='window.broken=1'>\"&amp;<!--<script>\u202e\u2066\u200f"
    shown = hostile.encode("ascii", "backslashreplace").decode()
    record = a_record(
        robot=hostile, reason=hostile, cell=hostile, achieved=False, outcome="gave_up", steps=1
    )
    other = a_record("t2", pair=record.pair, cell=hostile, robot=f"B {hostile}", steps=1)
    with TrialWriter(tmp_path) as writer:
        writer.append(record)
        writer.append(other)
    step = {
        "step": 1,
        "action": "move(rob1,library)",
        "happened": True,
        "world": [],
        "mistaken": [],
    }
    contrary = {"step": 1, "observed": hostile, "believed": hostile}
    step |= {"reason": hostile, "contradictions": [contrary]}
    story = json.dumps({"trial": "t1", "steps": [step]}, separators=(",", ":"))
    (tmp_path / "stories.jsonl").write_text(story + "\n", encoding="utf-8")
    write_report(tmp_path, load_config("office"))
    tab = Tab(browser, tmp_path / REPORT, DESK, "light")
    tab.evaluate("document.querySelectorAll('details').forEach(own => own.open = true)")
    assert tab.evaluate("window.broken === undefined && !document.querySelector('img')")
    for part in ("name", "mind", "facts"):
        assert shown in " ".join(text(tab, part).split()), part
    assert text(tab, "mind").count(shown) == 3
    assert shown in tab.evaluate("document.querySelector('.found').textContent")
    assert chosen(tab, "robot", hostile) == ["t1"]
    assert tab.complaints() == []


def test_a_run_without_stories_is_told_as_far_as_its_records_are(
    browser: Browser, tmp_path: Path
) -> None:
    attempts = [Attempt(1, Action.parse("act"), True), Attempt(2, Action.parse("act"), False)]
    with TrialWriter(tmp_path) as writer:
        writer.append(a_record(steps=3, actions=attempts))
    write_report(tmp_path, load_config("office"))
    tab = Tab(browser, tmp_path / REPORT, DESK, "light")
    kinds = "[...document.querySelectorAll('.system i')].map(own => own.classList[0])"
    assert tab.evaluate(kinds) == ["done", "failed", "mental", "end"]
    slide(tab, 2)
    assert "act" in text(tab, "action")
    assert "failed" in text(tab, "result")
    assert "not" in text(tab, "belief")
    assert tab.events("Runtime.exceptionThrown") == []


def test_a_time_line_has_the_steps_that_there_are(browser: Browser, tmp_path: Path) -> None:
    """However high their numbers, so that no page counts for ever."""
    with TrialWriter(tmp_path) as writer:
        writer.append(a_record(steps=3))
    write_report(tmp_path, load_config("office"))
    page, far = (tmp_path / REPORT).read_text(encoding="utf-8"), 2**31 - 1
    head, data, rest = _split(page)
    data["trials"][0]["story"][-1]["step"] = far
    (tmp_path / REPORT).write_text(f"{head}{json.dumps(data)}{rest}", encoding="utf-8")
    tab = Tab(browser, (tmp_path / REPORT).as_uri(), DESK, "light")
    steps = "[...document.querySelectorAll('.system i')].map(own => Number(own.dataset.step))"
    assert tab.evaluate(steps) == [1, 2, 3, far]
    slide(tab, far)
    assert tab.evaluate(STEP).split()[1] == str(far)
    assert tab.events("Runtime.exceptionThrown") == []


def _split(page: str) -> tuple[str, dict[str, Any], str]:
    """A page around the data of its explorer."""
    before, mark, after = page.partition('id="explorer-data">')
    data, _, rest = after.partition("</script>")
    return before + mark, json.loads(data), f"</script>{rest}"


def test_a_link_to_a_trial_that_is_not_there_says_so(browser: Browser, run: Played) -> None:
    tab = Tab(browser, f"{run.page.as_uri()}#trial=nosuch&step=2", DESK, "light")
    tab.until("!document.querySelector('[data-part=warning]').hidden")
    assert "nosuch" in tab.evaluate("document.querySelector('[data-part=warning]').textContent")
