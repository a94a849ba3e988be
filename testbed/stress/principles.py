"""Principles of a robot that tells its mind, checked step by step.

Each is judged by complete search in the world, from what the robot says that it believes. A robot
is judged by a principle only where its trace tells what that is about. Numbers in parentheses are
those of the theory (docs/theory.md).
"""

from itertools import chain

from asp.language import Action
from testbed.config import StressSettings
from testbed.experiment.episodes import Episode
from testbed.protocol import FINISH, WAIT
from testbed.stress.explanations import fewest_events
from testbed.stress.fine_principles import plans_that_fit, teleports
from testbed.stress.mind import Believed, Broken, beliefs
from testbed.stress.verdicts import Finding, Verdict

NAME = "principles"


def principles(episode: Episode, _: StressSettings) -> Verdict:
    """All principles of the resolution at which the robot acts."""
    if episode.spec.setting.fine is not None:
        broken = chain(teleports(episode), plans_that_fit(episode))
    else:
        minds = beliefs(episode)
        broken = chain.from_iterable(check(episode, minds) for check in COARSE)
    found = tuple(Finding(NAME, *each) for each in broken)
    return Verdict(float(bool(found)), found)


def _procrastination(episode: Episode, minds: list[Believed]) -> Broken:
    """Non-procrastination: what is intended, (38) and (52), is attempted at once."""
    del episode
    for own in minds:
        decision, trace = own.moment.decision, own.moment.decision.trace
        if trace.intention is None:
            continue
        wanted = WAIT if trace.mental is not None else trace.intention
        if decision.action != wanted:
            told = f"it intends {trace.intention}, and answers {decision.action}"
            yield "procrastination", own.step, told


def _persistence(episode: Episode, minds: list[Believed]) -> Broken:
    """Persistence: what can still succeed is neither stopped, (39) to (41), nor given up, (53)."""
    del episode
    ahead: tuple[Action, ...] = ()
    for own in minds:
        decision, trace = own.moment.decision, own.moment.decision.trace
        mental, plan = trace.mental, ahead
        if own.moment.percept.happened:
            plan = ahead[1:]
        if mental is not None and mental.name == "stop" and plan and own.reaches_goal(plan):
            told = f"it stops, and believes in a state in which {' '.join(plan)} leads to its goal"
            yield "stopped", own.step, told
        if decision.action == FINISH and not own.believes_goal and own.has_plan():
            yield "gave up", own.step, "it finishes, and from what it believes there is a plan"
        ahead = tuple(trace.plan) or plan


def _agreement(episode: Episode, minds: list[Believed]) -> Broken:
    """(18) The belief is a state, and agrees with all that is seen and heeded."""
    del episode
    for own in minds:
        if own.state is None:
            yield "no state", own.step, f"no state of the domain is {' '.join(own.atoms)}"
        unheeded = own.moment.decision.trace.unheeded
        if unheeded is None:
            continue
        for seen in own.moment.percept.visible:
            if (seen.atom in own.atoms) != seen.is_positive and seen not in unheeded:
                yield "disagreement", own.step, f"it sees {seen}, heeds it, and believes otherwise"


def _minimality(episode: Episode, minds: list[Believed]) -> Broken:
    """(27) An explanation assumes no more events than some other one, as far as it is proved."""
    del minds
    for step, assumed, enough in fewest_events(episode):
        if enough < assumed:
            told = f"it assumes {assumed} events, and {enough} explain what it heeded"
            yield "not minimal", step, told


def _shortness(episode: Episode, minds: list[Believed]) -> Broken:
    """(47) The plan of a new activity is as short as any, from what the robot believes.

    Not of conformant plans, nor of a robot that is not content where it believes in the goal.
    """
    setting, judge = episode.spec.setting, episode.setup.judge
    wants_more = any(own.believes_goal and not own.moment.decision.believes_goal for own in minds)
    if setting.plans != "optimistic" or wants_more:
        return
    plans = 0
    for own in minds:
        trace = own.moment.decision.trace
        begins, plans = trace.plans > plans, trace.plans
        if not begins or own.state is None or not trace.plan:
            continue
        fewest = judge.minimal(own.state, setting.goal, setting.judge_states).actions
        if fewest is None:
            continue
        if not own.reaches_goal(trace.plan):
            yield "no plan", own.step, f"{' '.join(trace.plan)} does not lead to the goal"
        elif len(trace.plan) > fewest:
            told = f"its plan has {len(trace.plan)} actions, and {fewest} suffice"
            yield "not shortest", own.step, told


COARSE = (_procrastination, _persistence, _agreement, _minimality, _shortness)
