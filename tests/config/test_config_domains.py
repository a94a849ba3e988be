"""The domain of a configuration: where it is found, and what has to fit it."""

from pathlib import Path

import pytest

import asp
from asp.language import load_description
from testbed.config import load_config
from tests.config.tiny import LAMP, VALID, file_of, refusal

pytestmark = pytest.mark.versions


def test_scenarios_are_those_of_the_domain_unless_they_are_named(tmp_path: Path) -> None:
    start = "name: tiny\ngoal: [loc(book1,library)]\n"
    everything = load_config(file_of(tmp_path, start)).scenarios
    assert everything == load_description("office").scenarios
    assert load_config(file_of(tmp_path, start), ["script=[]"]).scenarios == ("script",)


def test_where_a_domain_has_no_scenarios_nothing_happens(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    lamp.write_text(LAMP.partition("scenarios")[0], encoding="utf-8")
    config = load_config(file_of(tmp_path, f"name: tiny\ndomain: {lamp}\ngoal: [lit]\n"))
    assert (config.scenarios, config.settings("none").script) == (("none",), ())


def test_another_domain_over_a_file_needs_what_belongs_to_it(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    lamp.write_text(LAMP, encoding="utf-8")
    assert refusal(tmp_path, VALID, f"domain={lamp}") == [
        "command line: domain: tiny.yaml is about another domain; with this one give also "
        "goal, initial, scenarios, scenario_settings, observability"
    ]
    given = [f"domain={lamp}", "scenarios=[1]", "scenario_settings={}", "goal=[lit]"]
    (line, *more) = refusal(tmp_path, VALID, *given[:-1], "goal=[lid]")
    assert line.endswith("give also initial, observability")
    assert more == ["command line: goal[0]: no fluent 'lid'; did you mean 'lit'?"]
    config = load_config(file_of(tmp_path, VALID), [*given, "observability={}", "initial=[lit]"])
    assert (config.observability, config.scenario_settings) == ({}, {})


def test_what_fits_another_domain_by_chance_is_named_with_what_does_not(tmp_path: Path) -> None:
    text = "name: tiny\ngoal: [loc(book1,library)]\nscenarios: [2]\n"
    (line,) = refusal(tmp_path, text, "domain=library")
    assert line.endswith("with this one give also goal, scenarios")
    assert load_config(file_of(tmp_path, text), ["domain=library", "scenarios=[random]"])


def test_a_domain_in_which_nobody_sees_anything_has_no_robot(tmp_path: Path) -> None:
    lamp = tmp_path / "lamp.al"
    text = f"name: tiny\ndomain: {lamp}\ngoal: [lit]\n"
    lamp.write_text(LAMP.replace("sees\n  R sees lit if robot(R).\n", ""), encoding="utf-8")
    (line,) = refusal(tmp_path, text)
    assert line.startswith("tiny.yaml:2: domain: has no robot: nobody sees anything in it; ")
    (_, advice) = line.split("write for example: ")
    assert advice == "R sees f(X) if robot(R)."
    lamp.write_text(LAMP.replace("R sees lit", advice.partition(" if")[0].replace("f(X)", "lit")))
    assert load_config(file_of(tmp_path, text)).goal == ("lit",)


def test_a_domain_beside_the_configuration_is_found_from_anywhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "own.al").write_text(asp.load_description("office").source, encoding="utf-8")
    path = file_of(tmp_path, VALID + "domain: own.al\n")
    monkeypatch.chdir("/")
    assert Path(load_config(path).domain) == (tmp_path / "own.al").resolve()


def test_a_mistake_in_the_domain_is_told_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "own.al").write_text("sorts\n  room = {kitchen}\n", encoding="utf-8")
    lines = refusal(tmp_path, VALID + "domain: own.al\n")
    assert all("own.al:" in line for line in lines)
