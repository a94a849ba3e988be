"""How well robots explained, as text: what each number is called, and a table of a sweep."""

from collections.abc import Mapping, Sequence

from testbed.analysis.bootstrap import Estimate
from testbed.studies.charts import Measure
from testbed.studies.tables import Sheet

EXPLANATIONS: Mapping[str, Measure] = {
    "explained": Measure("unobserved events explained", "share curve"),
    "latency": Measure("steps from event to explanation", "number curve", 1),
    "action_first": Measure("action named by the first explanation", "share curve"),
    "action_last": Measure("action named by the last", "share curve"),
    "step_first": Measure("action and step by the first", "share curve"),
    "step_last": Measure("action and step by the last", "share curve"),
    "false": Measure("assumed events that did not happen", "share curve"),
    "alternatives": Measure("other explanations as small", "number curve", 1),
    "false_exceptions": Measure("assumed exceptions that did not hold", "share curve"),
    "wrongly_distrusted": Measure("distrusted reports that were true", "share curve"),
}
"""By name; the values are those of `testbed.analysis.quality`."""


def sheet(
    robots: Mapping[str, Mapping[str, Mapping[str, Estimate | None]]], names: Sequence[str]
) -> Sheet | None:
    """The estimates of each robot under each condition; None where nothing was to be explained."""
    rows = {
        (condition, name): [own[measure][name] for measure in EXPLANATIONS]
        for condition, own in robots.items()
        for name in names
    }
    told = [
        (*who, *(m.value(each).whole for m, each in zip(EXPLANATIONS.values(), own, strict=True)))
        for who, own in rows.items()
        if any(own)
    ]
    columns = ("condition", "robot", *(measure.title for measure in EXPLANATIONS.values()))
    return Sheet("How well the robots explained", columns, told, 2) if told else None
