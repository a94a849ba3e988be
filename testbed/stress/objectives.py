"""What a stress search looks for: each objective judges episodes by itself.

A verdict has a score, which is greater the nearer an episode is to a finding: it says which
episodes are worth more events.
"""

from collections.abc import Callable, Mapping

import msgspec

from testbed.config import StressSettings
from testbed.experiment.episodes import Episode
from testbed.stress.principles import principles
from testbed.stress.verdicts import Finding, Verdict, in_a_line

Objective = Callable[[Episode, StressSettings], Verdict]


def fail(episode: Episode, _: StressSettings) -> Verdict:
    """The robot does not achieve its goal although it was within reach of every state.

    The score is the share of steps at which the robot believed something wrong about the goal, and
    the share of the steps that a trial may have.
    """
    steps = len(episode.moments) / episode.spec.setting.step_limit
    score = steps + _mistaken(episode)
    if episode.achieved or not _in_reach(episode):
        return Verdict(score)
    assert episode.ending is not None
    last = episode.moments[-1].decision
    gave_up = episode.ending.value == "false_finish" and not last.believes_goal
    rule = "gave_up" if gave_up else episode.ending.value
    world, goal = episode.setup.world, episode.spec.setting.goal
    unmet = " ".join(own for own in sorted(goal) if not world.holds(episode.state, own))
    says = f"; the robot says: {last.trace.reason}" if last.trace.reason else ""
    detail = f"ends without {unmet or 'a finish'}{says}"
    return Verdict(score + 1, (Finding("fail", rule, len(episode.moments), detail),))


def waste(episode: Episode, settings: StressSettings) -> Verdict:
    """The units of the robot's attempts beyond the optimum of the initial state without events."""
    setting, judge = episode.spec.setting, episode.setup.judge
    least = judge.minimal(_first(episode), setting.goal, setting.judge_states).units
    return _over("waste", "units", episode, least, settings.waste)


def regret(episode: Episode, settings: StressSettings) -> Verdict:
    """The units beyond those of an oracle that knows all events of the episode beforehand."""
    setting, judge = episode.spec.setting, episode.setup.judge
    least = judge.knowing(_first(episode), setting.goal, episode.events, setting.judge_states)
    return _over("regret", "units", episode, least, settings.regret)


def reasoning(episode: Episode, settings: StressSettings) -> Verdict:
    """The process time of the robot's decisions, in seconds, preparation left out."""
    traces = [moment.decision.trace for moment in episode.moments]
    seconds = sum(own.planning_cpu_s + own.diagnosis_cpu_s for own in traces)
    seconds += sum(own.fine.planning_cpu_s + own.fine.infer_cpu_s for own in traces if own.fine)
    return _beyond("reasoning", "seconds", seconds, settings.reasoning_s)


OBJECTIVES: Mapping[str, Objective] = {
    "fail": fail,
    "waste": waste,
    "regret": regret,
    "reasoning": reasoning,
    "principles": principles,
}


def judged(episode: Episode, settings: StressSettings) -> Verdict:
    """The verdict of all objectives of the settings; a robot that fails to answer is a finding."""
    if episode.fault is not None:
        step = len(episode.moments) + 1
        return Verdict(1.0, (Finding("fault", "no answer", step, in_a_line(episode.fault)),))
    verdicts = [OBJECTIVES[name](episode, settings) for name in settings.objectives]
    findings = tuple(
        msgspec.structs.replace(found, detail=in_a_line(found.detail))
        for own in verdicts
        for found in own.findings
    )
    return Verdict(sum(own.score for own in verdicts), findings)


def _first(episode: Episode) -> int:
    return next(iter(episode.states))


def _in_reach(episode: Episode) -> bool:
    """Whether it is known that the goal was within reach of every state."""
    setting, judge = episode.spec.setting, episode.setup.judge
    known = (judge.in_reach(s, setting.goal, setting.judge_states) for s in set(episode.states))
    return all(known)


def _mistaken(episode: Episode) -> float:
    """The share of the moments at which a belief about a literal of the goal was wrong."""
    told = [own for own in episode.moments if own.decision.trace.belief]
    world, goal = episode.setup.world, episode.spec.setting.goal
    wrong = 0
    for moment in told:
        believed = frozenset(moment.decision.trace.belief)
        wrong += any((own.atom in believed) != world.holds(moment.before, own.atom) for own in goal)
    return wrong / len(told) if told else 0.0


def _over(name: str, unit: str, episode: Episode, least: int | None, most: float | None) -> Verdict:
    """What was spent beyond the least; nothing where that is not known, or the goal was missed."""
    if least is None or not episode.achieved:
        return Verdict()
    return _beyond(name, unit, float(episode.units - least), most)


def _beyond(name: str, unit: str, amount: float, most: float | None) -> Verdict:
    if most is None or amount <= most:
        return Verdict(amount)
    detail = f"{amount:g} {unit}, and {most:g} are allowed"
    return Verdict(amount, (Finding(name, f"more than {most:g} {unit}", None, detail, amount),))
