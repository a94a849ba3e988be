"""Why an intentional robot decided as it did: for people, in the terms of the theory.

Nothing here has a part in a decision.
"""

from collections.abc import Sequence
from dataclasses import replace

from msgspec import structs

from agents.intentional.activities import History
from agents.intentional.reasoners import FIRST_EVENT
from agents.shared import Intention, Narration, Reasons, Step, listed
from asp.language import Action
from asp.reasoning.diagnosis import GOAL, Diagnosis, Explanation, problem_of
from asp.solving import LimitError, State, deciding
from testbed import protocol
from testbed.protocol import FINISH, Trace

MOST_ALTERNATIVES = 20


class IntentionalReasons(Reasons):
    """Gives reasons for decisions about one goal in one domain."""

    def explained(
        self, trace: Trace, history: History, intention: Intention, diagnosis: Diagnosis
    ) -> Trace:
        """The trace with the reason of a decision at the history's step."""
        trace = self._reason(trace, history, intention, diagnosis)
        for outcome in trace.explanation.outcomes if trace.explanation else ():
            what = (outcome.action, " at step ", Step(outcome.step))
            reason = trace.reason.parts if isinstance(trace.reason, Narration) else (trace.reason,)
            said = Narration(*what, " had another outcome than expected; ", *reason)
            trace = structs.replace(trace, reason=said)
        return trace

    def _reason(
        self, trace: Trace, history: History, intention: Intention, diagnosis: Diagnosis
    ) -> Trace:
        state, action = intention.believed - {GOAL}, intention.action
        if action == FINISH:
            if GOAL in intention.believed:
                return structs.replace(trace, reason="the goal holds")
            no_plan, text = self.no_plan(state)
            return structs.replace(trace, reason=text, no_plan=no_plan)
        if action.name == "start":
            return structs.replace(trace, reason=self._started(history, intention, state))
        left = history.left(diagnosis.indices)
        if action.name == "stop":
            futile_at, text = self._futile(history.step, state, left)
            return structs.replace(trace, reason=text, futile_at=futile_at)
        said = f"activity {trace.activity} still reaches the goal, by step "
        return structs.replace(trace, reason=Narration(said, Step(history.step + len(left))))

    def _started(self, history: History, intention: Intention, state: State) -> str:
        # A new activity is on record only after the decision.
        again = any(f"start({each.name})" == intention.action for each in history.activities)
        count, how = len(intention.plan), ""
        if self._is_conformant:  # fewer may do with some
            how = " with all outcomes"
        elif self._branches(state, intention.plan):
            how = " with some outcomes"
        return (
            f"no activity for the goal; {count} action{'' if count == 1 else 's'} achieve"
            f"{'s' if count == 1 else ''} it{how}, none fewer"
            + ("; the plan of an earlier activity" * again)
        )

    def _branches(self, state: State, plan: Sequence[Action]) -> bool:
        """Whether an action of a plan has several outcomes, from a state on."""
        for action in () if self._knowledge.deterministic else plan:
            after, _ = self._sessions.transitions.all_after(state, action, ())
            if len(after) > 1:
                return True
            state = next(iter(after), state)
        return False

    def alternatives(
        self, history: History, diagnosis: Diagnosis
    ) -> tuple[list[protocol.Explanation], bool]:
        """The other explanations that are as small, and whether there are more than are given.

        None are given where the limits of a decision do not suffice to find them.
        """
        own = diagnosis.explanation
        try:
            with deciding(self._limits):
                found, more = self._found(history, diagnosis)
        except LimitError:
            return [], True
        others = (e for e in found if e != own.without_start)
        proved = [replace(other, proved=own.proved) for other in others]
        return [self.explanation(other, (), None, history.step) for other in proved], more

    def _found(self, history: History, diagnosis: Diagnosis) -> tuple[list[Explanation], bool]:
        if diagnosis.alternatives is not None:
            return diagnosis.alternatives(MOST_ALTERNATIVES)
        problem = problem_of(self._knowledge, self._goal, history, FIRST_EVENT)
        explanations = self._sessions.diagnosis.explanations
        return explanations.alternatives(problem, diagnosis.explanation, MOST_ALTERNATIVES)

    def _futile(self, step: int, state: State, left: tuple[Action, ...]) -> tuple[int, Narration]:
        """The first step at which the projection of a plan breaks (36), in words, too."""
        transitions, states = self._sessions.transitions, [state]
        for later, action in enumerate(left, start=step):
            found = {state: transitions.all_after(state, action, ()) for state in states}
            blocked = [state for state, (_, took_effect) in found.items() if not took_effect]
            if blocked and (self._is_conformant or len(blocked) == len(states)):
                hindrance = transitions.hindrance(blocked[0], action)
                because = (" with ", listed(hindrance)) if hindrance else ()
                said = ("futile: ", action, " is impossible at step ", Step(later), *because)
                return later, Narration(*said)
            states = list(dict.fromkeys(each for after, _ in found.values() for each in after))
        end = step + len(left)
        missing = next(filter(None, map(self._tracker.missing, states)), ())
        failing = listed(each.complement for each in missing)
        how = ("with ", failing) if missing else ("after some outcomes",)
        return end, Narration("futile: its end, at step ", Step(end), ", violates the goal ", *how)
