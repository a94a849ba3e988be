"""What a description's comments say of its scenarios."""

import pytest

from asp.language import load_description, read_domain, scenario_notes

TEXT = """\
scenarios
  % On scenarios in general.

  % 1: nothing happens.
  1: nothing.
  % 2, a gust: it blows while
  % the robot carries.
  2: blow upon carry(T).  % not this
  % nor this
  2: blow upon any.
  3: blow upon any.
  % at any time
  random: blow upon any.
"""


def test_the_comment_above_the_first_statement_tells_of_a_scenario() -> None:
    assert scenario_notes(TEXT) == {
        "1": "Nothing happens.",
        "2": "A gust: it blows while the robot carries.",
        "random": "At any time",
    }


@pytest.mark.parametrize("name", ["office", "library"])
def test_a_packaged_domain_tells_of_all_its_scenarios(name: str) -> None:
    file, text = read_domain(name)
    assert tuple(scenario_notes(text, file)) == load_description(name).scenarios
