"""Whether a robot's explanation and its belief are what the theory gives, by brute force."""

from collections.abc import Iterator
from itertools import islice

from benchmarks.games.explaining import Assumptions
from benchmarks.games.faults import Fault, Turn
from benchmarks.games.literals import complement
from benchmarks.games.office import State
from benchmarks.games.preferring import first
from benchmarks.games.told import Told

MOST_ALTERNATIVES = 20


def explanation_faults(turn: Turn, keeps: bool) -> Iterator[Fault]:
    """It explains the history, and none is smaller.

    One that is as good `keeps` its place; else it is the first of the smallest ones.
    """
    adopted, search = turn.adopted, turn.search
    if not turn.ends:
        yield turn.fault("explanation", f"does not explain the history: {adopted}")
        return
    smallest = search.smallest(adopted.price[0])
    assert smallest is not None, f"the search misses an explanation: {adopted}"
    if not turn.is_proved:
        return  # the budget of a decision was used up, which the trace says
    if smallest < adopted.price:
        found = next(search.every(smallest))
        yield turn.fault("explanation", f"{adopted}; smaller is: {found}")
        return
    if not keeps or adopted == turn.before:
        return
    if turn.before.price == smallest and search.outcomes(turn.before):
        yield turn.fault("explanation", f"{adopted}; it need not give up: {turn.before}")
    elif first(search, smallest) not in (adopted, None):
        yield turn.fault("explanation", f"{adopted}; first is: {first(search, smallest)}")


def alternative_faults(turn: Turn) -> Iterator[Fault]:
    """The alternatives are the other smallest explanations, up to a number."""
    trace, adopted = turn.decision.trace, turn.adopted
    if trace.explanation is None or not turn.ends or not turn.is_proved or turn.is_limited:
        return
    listed = list(map(Assumptions.of, trace.alternatives or ()))
    for each in listed:
        if each == adopted or each.price != adopted.price or not turn.search.outcomes(each):
            yield turn.fault("explanation", f"{each} is no alternative to {adopted}")
    if len(set(listed)) < len(listed) or len(listed) > MOST_ALTERNATIVES:
        yield turn.fault("explanation", "alternatives are listed twice, or too many")
    every = set(islice(turn.search.every(adopted.price), MOST_ALTERNATIVES + 2))
    missing = every - {adopted, *listed}
    if bool(missing) != trace.more_alternatives:
        said = "more" if trace.more_alternatives else "no more"
        yield turn.fault(
            "explanation",
            f"{said} alternatives are said to exist beside {listed}; there are {len(missing)}",
        )


def belief_faults(turn: Turn) -> Iterator[Fault]:
    """The belief is a state to which the history leads by the explanation."""
    trace = turn.decision.trace
    belief = frozenset(map(str, trace.belief))
    if turn.ends and turn.state is None:
        expected = " or ".join(str(sorted(turn.office.fluents(n.state))) for n in turn.ends)
        yield turn.fault("belief", f"{sorted(belief)}; by the explanation: {expected}")


def unheeded_faults(turn: Turn, state: State) -> Iterator[Fault]:
    """What is visible and contradicts the belief is said not to be heeded."""
    unheeded = set(turn.decision.trace.unheeded or ())
    visible = set(turn.percept.visible)
    expected = {each for each in visible if not turn.office.agrees(state, [str(each)])}
    if unheeded != expected:
        yield turn.fault("belief", f"unheeded is {unheeded}, but {expected} contradicts the belief")


def contradiction_faults(turn: Turn, since: int, believed: State) -> Iterator[Fault]:
    """The contradictions told are those of the first step that has any, from a belief on."""
    found = {(c.step, str(c.observed), str(c.believed)) for c in turn.decision.trace.contradictions}
    expected = set(_contradictions(turn.told, turn.before, since, believed))
    if found != expected:
        yield turn.fault("reason", f"contradicted by {sorted(found)}, expected: {sorted(expected)}")


def _contradictions(
    told: Told, before: Assumptions, step: int, state: State
) -> Iterator[tuple[int, str, str]]:
    office, goal = told.rules.office, told.rules.goal
    while True:
        moment = told.at(step)
        wrong = [each for each in moment.observed if not office.agrees(state, [each])]
        if moment.goal is not None and moment.goal != office.agrees(state, goal):
            wrong.append("my_goal" if moment.goal else "-my_goal")
        if step == 0:
            wrong += [each for each in told.known if not office.agrees(state, [each])]
        if wrong or step == told.step:
            yield from ((step, seen, complement(seen)) for seen in wrong)
            return
        part = before.at(step)
        events = (moment.reports - part.distrusted) | part.events
        happens = moment.attempt is not None and office.possible(state, moment.attempt)
        own = {moment.attempt} if moment.attempt is not None and happens else set()
        after = office.after(state, events | own)
        if after is None:
            alone = {e for e in events if not office.possible(state, e)} or events
            yield from ((step, f"hpd({e})", f"impossible({e})") for e in alone)
            return
        if happens != moment.happened:
            seen = ("-" if happens else "") + str(moment.attempt)
            yield step, f"hpd({seen})", f"hpd({complement(seen)})"
            return
        state, step = after, step + 1
