"""The commands `plan`, `explain` and `diagram`: what they print, and what they refuse."""

import doctest
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from testbed.cli import app

ROOT = Path(__file__).parents[2]
CART = (ROOT / "tests" / "asp" / "reasoning" / "cart.al").read_text(encoding="utf-8")
PAGE = (ROOT / "docs" / "reasoner.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
TOLD = 'history:\n- observed: ["at(left)", -shut]\n'


@pytest.fixture(autouse=True)
def _cart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("cart.al").write_text(CART, encoding="utf-8")


def _call(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def _explained(history: str, *options: str) -> Result:
    Path("told.yaml").write_text(history, encoding="utf-8")
    return _call("explain", "cart.al", "told.yaml", *options)


def _refusal(result: Result) -> str:
    assert result.exit_code == 2, result.output
    assert not result.stdout
    (line,) = result.stderr.splitlines()
    return line


def _blocks(language: str) -> list[str]:
    return [text for found, text in BLOCK.findall(PAGE) if found == language]


def test_the_example_of_the_page_is_what_the_program_prints() -> None:
    (gate,), (history,) = _blocks("prolog"), _blocks("yaml")
    Path("gate.al").write_text(gate, encoding="utf-8")
    Path("history.yaml").write_text(history, encoding="utf-8")
    shown = _blocks("console")
    assert len(shown) > 2
    for block in shown:
        line, _, output = block.partition("\n")
        result = CliRunner().invoke(app, line.removeprefix("$ testbed "))
        assert (result.exit_code, result.stdout) == (0, output)
    (session,) = _blocks("pycon")
    example = doctest.DocTestParser().get_doctest(session, {}, "page", "docs/reasoner.md", 0)
    assert len(example.examples) > 5
    assert doctest.DocTestRunner().run(example).failed == 0


def test_a_plan_is_one_line_per_action() -> None:
    found = _call("plan", "cart.al", "--from", "at(left), shut", "--goal", "at(right)")
    assert (found.exit_code, found.stdout) == (0, "open\ngo(right)\n")
    twice = ("--goal", "at(left)", "--goal", "shut")
    found = _call("plan", "cart.al", "--from", "at(left)", "--from", "shut", *twice)
    assert (found.exit_code, found.stdout) == (0, "")


def test_no_plan_within_the_limit_is_an_exit_code() -> None:
    command = ("plan", "cart.al", "--from", "at(left), shut", "--goal", "at(right)", "--limit", "1")
    assert _call(*command).exit_code == 1
    assert _call("plan", "cart.al", "--from", "", "--goal", "shut").exit_code == 1


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("cart.al", "--from", "at(lef)", "--goal", "lit"), "at(lef)"),
        (("cart.al", "--from", "at(lef)", "--goal", "lit"), "--from: "),
        (("cart.al", "--from", "lit", "--goal", "at(left"), "at(left"),
        (("cart.al", "--from", "lit", "--goal", "at(left"), "--goal: "),
        (("cart.al", "--from", "at(left), at(right)", "--goal", "lit"), "at(right)"),
        (("cart.al", "--from", "lit", "--goal", "lit, -lit"), "lit"),
        (("cart.al", "--from", "lit", "--goal", ""), "--goal: "),
        (("cart.al", "--from", "lit", "--goal", " , "), "--goal: "),
        (("missing.al", "--from", "lit", "--goal", "lit"), "missing.al"),
    ],
)
def test_mistakes_in_a_question_are_one_line(arguments: tuple[str, ...], named: str) -> None:
    assert named in _refusal(_call("plan", *arguments))


def test_unobserved_actions_are_told_with_their_steps() -> None:
    history = TOLD + "  attempted: go(right)\n  took_effect: false\n"
    history = history.replace("-shut]", "-shut, lit]\n  reported: [shut_gate]")
    result = _explained("history:\n- observed: [-shut]\n- observed: [shut]\n")
    assert result.exit_code == 0
    assert "step 0: shut_gate" in result.stdout
    assert _explained(history).exit_code == 1


def test_all_explanations_are_told_on_request() -> None:
    history = "history:\n- observed: [-shut, -lit, at(left)]\n- {}\n- observed: [shut]\n"
    assert "or" not in _explained(history).stdout.split("\n")
    assert _explained(history, "--all").stdout.split("\n").count("or") == 1


@pytest.mark.parametrize(
    ("history", "place"),
    [
        (TOLD + "  attempted: push(left)\n", "told.yaml:3: history[0].attempted"),
        (TOLD + "  attempted: [open]\n", "told.yaml:3: history[0].attempted"),
        (TOLD + "  reported: [open]\n", "told.yaml:3: history[0].reported"),
        (TOLD + "  took_effect: perhaps\n", "told.yaml:3: history[0].took_effect"),
        (TOLD + "- observed: [shutt]\n", "told.yaml:3: history[1].observed"),
        (TOLD + "- observed: shut\n", "told.yaml:3: history[1].observed"),
        (TOLD + "- observed: [shut, -shut]\n", "told.yaml:3: history[1].observed"),
        (TOLD + "- observed: [at(left]\n", "told.yaml:3: history[1].observed"),
        (TOLD + "- seen: [shut]\n", "told.yaml:3: history[1].seen"),
        (TOLD + "- shut\n", "told.yaml:3: history[1]"),
        (TOLD + "goal: [lid]\n", "told.yaml:3: goal"),
        (TOLD + "goal: [lit, -lit]\n", "told.yaml:3: goal"),
        (TOLD + 'goal: ["at(left)", "at(right)"]\n', "told.yaml:3: goal"),
        (TOLD + "- {goal: true}\n", "told.yaml:3: history[1].goal"),
        ("goal: [lit]\n" + TOLD + "  goal: 1\n", "told.yaml:4: history[0].goal"),
        (TOLD + "  took_effect: 'no'\n", "told.yaml:3: history[0].took_effect"),
        ("{}\n", "told.yaml: history"),
        ("", "told.yaml"),
        ("history: [\n", "told.yaml:"),
    ],
)
def test_mistakes_in_a_history_are_one_line_with_file_and_key(history: str, place: str) -> None:
    assert _refusal(_explained(history)).startswith(place)


@pytest.mark.parametrize(
    ("history", "place", "right"),
    [
        (TOLD.replace("history", "histroy"), "told.yaml:1: histroy", "history"),
        (TOLD.replace("observed", "observd"), "told.yaml:2: history[0].observd", "observed"),
        (TOLD + "  took_efect: false\n", "told.yaml:3: history[0].took_efect", "took_effect"),
        ("goal: [lit]\n" + TOLD + "  goal: yes\n", "told.yaml:4: history[0].goal", "true"),
        (TOLD + "  goal: false\n", "told.yaml:3: history[0].goal", "goal: ["),
        (TOLD + "goal: lit\n", "told.yaml:3: goal", "['lit']"),
    ],
)
def test_a_mistake_in_the_form_of_a_history_is_one_line_that_says_what_would_be_right(
    history: str, place: str, right: str
) -> None:
    line = _refusal(_explained(history))
    assert line.startswith(f"{place}: ")
    assert right in line.removeprefix(f"{place}: ")


def test_a_history_that_is_no_text_is_one_line() -> None:
    Path("told.yaml").write_bytes(b"history:\n- \xff\n")
    assert _refusal(_call("explain", "cart.al", "told.yaml")).startswith("told.yaml:2:")
    assert "no.yaml" in _refusal(_call("explain", "cart.al", "no.yaml"))


def test_a_diagram_is_listed_or_drawn() -> None:
    listed, drawn = _call("diagram", "cart.al"), _call("diagram", "cart.al", "--dot")
    assert (listed.exit_code, drawn.exit_code) == (0, 0)
    states = re.findall(r"^(s\d+): (.*)$", listed.stdout, re.MULTILINE)
    arrows = re.findall(r"^(s\d+) -> (s\d+): (.*)$", listed.stdout, re.MULTILINE)
    assert (
        len(states) == len(set(states)) == 12
    )  # three places of the cart, shut or not, lit or not
    assert re.findall(r'^ *(s\d+) \[label="(.*)"\];$', drawn.stdout, re.MULTILINE) == states
    edge = r'^ *(s\d+) -> (s\d+) \[label="(.*)"\];$'
    assert re.findall(edge, drawn.stdout, re.MULTILINE) == arrows
    assert arrows


def test_names_are_escaped_for_graphviz() -> None:
    Path('a"b\\.al').write_text(CART, encoding="utf-8")
    assert _call("diagram", 'a"b\\.al', "--dot").stdout.startswith('digraph "a\\"b\\\\.al" {')


def test_a_diagram_that_is_too_large_is_refused() -> None:
    fluents = "".join(f"  inertial f{n}.\n" for n in range(14))
    text = f"fluents\n{fluents}actions\n  agent a.\nlaws\n  a causes f1.\n"
    Path("large.al").write_text(text, encoding="utf-8")
    assert "10000" in _refusal(_call("diagram", "large.al"))
