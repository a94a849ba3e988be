"""A cycle through negation is found in laws with variables as it is in their instances."""

import re

from hypothesis import event, given, settings
from hypothesis import strategies as st

from asp import SourceError, parse_description

SIGNATURE = """\
sorts
  a = {x, y}.
statics
  s(a).
  t(a).
fluents
  inertial p(a).
  inertial q(a).
  defined  d(a).
  defined  e(a).
facts
  s(x).
laws
"""
FLUENTS = st.sampled_from(["p", "q", "d", "e"])
TERMS = st.sampled_from(["x", "y", "X"])
SIGNS = st.sampled_from(["", "-"])


@st.composite
def laws(draw: st.DrawFn) -> str:
    if draw(st.integers(0, 4)) == 0:
        names, head_signs = st.sampled_from(["s", "t"]), st.just("")
    else:
        names, head_signs = FLUENTS, SIGNS
    head = draw(names)
    sign = "" if head in ("d", "e") else draw(head_signs)
    literal = st.builds("{}{}({})".format, SIGNS, names, TERMS)
    body = ", ".join(draw(st.lists(literal, max_size=2)))
    return f"  {sign}{head}({draw(TERMS)})" + (f" if {body}." if body else ".")


def has_cycles(text: str) -> bool:
    try:
        parse_description(text)
    except SourceError as error:
        return "own negation" in error.message
    return False


def spelled_out(text: str) -> str:
    """The text with a symbol of its own, `p_x`, for each instance `p(x)`."""
    declared, stated = text.split("facts\n")
    declared = re.sub(r"^(.*?)(\w)\(a\)\.$", r"\1\2_x.\n\1\2_y.", declared, flags=re.MULTILINE)
    lines = (
        line.replace("(X)", f"({value})") for line in stated.split("\n") for value in ("x", "y")
    )
    instances = "\n".join(dict.fromkeys(lines))
    return declared + "facts\n" + re.sub(r"\((\w)\)", r"_\1", instances)


@given(st.lists(laws(), min_size=1, max_size=5))
@settings(max_examples=200)
def test_no_cycle_is_missed(stated: list[str]) -> None:
    text = SIGNATURE + "\n".join(stated) + "\n"
    found = has_cycles(text)
    event(f"{found}")
    assert found == has_cycles(spelled_out(text))
