"""A robot of one's own: it believes what it sees, and plans anew at every step.

testbed run examples/custom_robot.yaml

It is for domains in which everything can be seen: it explains nothing, and knows of no event before
it sees what came of it.
"""

from time import perf_counter, process_time

from asp.reasoning.planning import IncrementalPlanner
from testbed.protocol import Capabilities, Decision, Percept, Task, Trace


class Replanner:
    """Finds a shortest plan from what it believes, and attempts the first action of it."""

    capabilities = Capabilities(resolutions=("coarse",), knowledge=("complete",))

    def begin(self, task: Task) -> None:
        """Takes the task on: called once, before the first percept."""
        self._goal, self._limit = tuple(task.goal), task.plan_limit
        self._planner = IncrementalPlanner(task.source, f"{task.domain}.al")
        self._believed = {fluent for fluent in task.initial if fluent.is_positive}
        self._expected: tuple[str, ...] = ()
        self._plans = 0

    def act(self, percept: Percept) -> Decision:
        """An action, or `finish` where nothing is left to do, or nothing can be done."""
        for literal in percept.visible:
            if literal.is_positive:
                self._believed.add(literal)
            else:
                self._believed.discard(literal.atom)
        wall, process = perf_counter(), process_time()
        plan = self._planner.shortest(frozenset(self._believed), self._goal, self._limit)
        wall, process = perf_counter() - wall, process_time() - process
        action = plan[0] if plan else "finish"
        self._plans += bool(plan) and plan != self._expected
        self._expected = (plan or ())[1:]
        return Decision(
            trial=percept.trial,
            step=percept.step,
            action=action,
            believes_goal=plan == (),
            trace=Trace(
                intention=action,
                plan=list(plan or ()),
                belief=sorted(self._believed),
                reason="no plan achieves the goal" if plan is None else "",
                plans=self._plans,
                planning_time_s=wall,
                planning_cpu_s=process,
            ),
        )
