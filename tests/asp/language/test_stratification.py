"""Where names alone rule out a cycle through negation, the instances have none."""

from __future__ import annotations

from hypothesis import event, given, settings
from hypothesis import strategies as st

from asp.language import (
    Problems,
    analyse,
    check_cycles,
    may_have_cycles,
    packaged_domains,
    parse,
    read_domain,
    signature_of,
)
from tests.asp.refinement.levels import level

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


@given(st.lists(laws(), min_size=1, max_size=5))
@settings(max_examples=200)
def test_no_cycle_is_missed(stated: list[str]) -> None:
    source = parse(SIGNATURE + "\n".join(stated) + "\n")
    problems = Problems("laws")
    signature = signature_of(source, problems)
    check_cycles(source, signature, problems)
    event(f"{bool(problems)}, maybe {may_have_cycles(source, signature)}")
    assert not problems or may_have_cycles(source, signature)


def test_the_packaged_descriptions_and_refined_ones_are_seen_to_have_none() -> None:
    texts = [read_domain(name)[1] for name in packaged_domains()]
    for text in (*texts, level("L2").weak.text, level("L2").strong.text):
        assert not may_have_cycles(*analyse(text))
