"""How well robots explained, in the report: one row per scenario and robot, counted by hand."""

from asp.language import Literal
from testbed.experiment.record import At, Explained, Occurrence, TrialRecord
from testbed.report.explanations import quality_table
from testbed.studies.explanations import EXPLANATIONS
from tests.experiment.samples import a_record, summary_of

SPILL = Literal.parse("spill(salt)")


def _pair(number: int, scenario: str = "1") -> list[TrialRecord]:
    """Both robots explain an event: one at once, the other later, and at another step."""
    common = {
        "pair": f"pair {number}",
        "scenario": scenario,
        "initial": [f"cold(oven{number})"],
        "exogenous": [Occurrence(2, SPILL, False)],
    }
    late, soon = Explained(6, [At(4, SPILL)], []), Explained(3, [At(2, SPILL)], [], alternatives=1)
    return [
        a_record(f"t{number}", robot="traditional", explanations=[late], **common),
        a_record(f"i{number}", robot="intentional", explanations=[soon], **common),
    ]


def test_shares_stand_beside_what_they_are_of_and_differences_below_the_treatment() -> None:
    table = quality_table(summary_of([own for number in range(5) for own in _pair(number)]))
    assert table is not None
    titles = {name: EXPLANATIONS[name].title for name in EXPLANATIONS}
    rows = {robot: dict(zip(table.headings, cells, strict=True)) for _, robot, cells in table.rows}
    theirs, ours = rows["traditional"], rows["intentional"]
    assert theirs[titles["explained"]] == ours[titles["explained"]] == ("100.0 % of 5", "")
    assert theirs[titles["step_first"]] == ("0.0 % of 5", "")
    assert ours[titles["step_first"]].text == "100.0 % of 5"
    assert ours[titles["step_first"]].note.startswith("+1.00 (p = ")
    assert (theirs[titles["latency"]].text, ours[titles["latency"]].text) == ("4.0", "1.0")
    assert (theirs[titles["alternatives"]].text, ours[titles["alternatives"]].text) == ("-", "1.0")
    assert not {titles["false_exceptions"], titles["wrongly_distrusted"]} & set(table.headings)


def test_scenarios_come_one_by_one_and_then_together_and_a_single_pair_is_not_tested() -> None:
    table = quality_table(summary_of([*_pair(1), *_pair(2, "2"), a_record("quiet", scenario="3")]))
    assert table is not None
    assert list(dict.fromkeys(place for place, _, _ in table.rows)) == ["1", "2", "all"]
    assert not any(own.note for place, _, cells in table.rows if place != "all" for own in cells)


def test_without_anything_to_explain_there_is_no_table() -> None:
    assert quality_table(summary_of([a_record("a")])) is None
