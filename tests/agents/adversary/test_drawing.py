"""What triggers draw, in three small domains: exact probabilities, counted by hand."""

from fractions import Fraction

import pytest

from asp import load_description, parse_description
from asp.language import Description
from testbed.protocol import NONE
from testbed.world import world_of
from tests.agents.adversary.chances import chances

KENNEL = """
sorts
  keeper = {kim}.
  dog    = {asta, bello, cora}.
  yard   = {north, east, south, west}.
fluents
  inertial roams(dog, yard).
  inertial leashed(keeper, dog).
  inertial fenced(yard).
actions
  agent     leash(keeper, dog).
  agent     whistle(keeper).
  exogenous stray(dog, yard).
  exogenous fence(yard).
laws
  leash(K, D)    causes leashed(K, D).
  stray(D, Y)    causes roams(D, Y).
  fence(Y)       causes fenced(Y).
  -roams(D, Y)   if roams(D, Z), Y != Z.
  impossible stray(D, Y) if fenced(Y).
  impossible stray(D, Y) if roams(D, Y).
initially
  roams(D, Y) for some Y.
sees
  K sees leashed(K, D).
scenarios
  astray: stray(D, Y) upon any drawing D with -leashed(K, D), -leash(K, D) then Y with -roams(D, Y).
  gap:    stray(D, Y) upon any drawing D then Y with -fenced(Y) if -leashed(kim, D).
  either: stray(D, Y) upon any drawing D with -leashed(K, D) then Y.
  either: fence(Y)    upon any drawing Y with -fenced(Y).
  free:   stray(D, Y) upon any drawing D with -leashed(K, D).
"""
"""Three dogs, so that a draw that is passed on has two to go to, and four yards."""

RAILWAY = """
sorts
  operator = {olga}.
  signal   = {s1, s2, s3, s4}.
  track    = {up, down}.
statics
  automatic(signal).
  guards(signal, track).
fluents
  inertial dark(signal).
  inertial watched(signal).
actions
  agent     inspect(operator, signal).
  exogenous break(signal).
laws
  inspect(O, S) causes watched(S).
  break(S)      causes dark(S).
  impossible break(S) if dark(S).
facts
  automatic(s1). automatic(s2). automatic(s3).
  guards(s1, up). guards(s2, up). guards(s3, down). guards(s4, down).
sees
  olga sees watched(S).
scenarios
  faults: break(S) upon any drawing S with automatic(S), -watched(S).
  track:  break(S) upon inspect(O, X)
    drawing T then S with guards(S, T), automatic(S) if S != X.
  here:   break(S) upon any drawing S with inspect(O, S).
"""
"""Statics say which signals there are, fluents and the robot's action which of them are drawn."""

BALLOON = """
sorts
  pilot   = {pia}.
  gust    = {weak, strong}.
  bearing = {0, 90, 180, 270}.
fluents
  inertial heading(bearing).
  inertial shaken(gust).
  defined  calm.
actions
  agent     burn(pilot).
  exogenous blow(gust, bearing).
laws
  calm          if -shaken(weak), -shaken(strong).
  blow(G, B)    causes heading(B).
  blow(G, B)    causes shaken(G).
  -heading(B)   if heading(C), B != C.
  impossible blow(strong, B) if calm, heading(0).
initially
  heading(B) for some B.
sees
  pia sees heading(B).
scenarios
  gusty: blow(G, B) upon burn(P) drawing G then B with -heading(B).
  odd:   blow(G, B) upon any drawing B with -heading(B) then G with shaken(G).
"""
"""The order of two draws; where nothing is shaken the second draw has nothing."""

AT = ["roams(asta,north)", "roams(bello,east)", "roams(cora,south)"]


@pytest.mark.parametrize(
    ("domain", "scenario", "state", "action", "expected"),
    [
        # Each dog a third, each of the three other yards a third of that.
        (
            KENNEL,
            "astray",
            AT,
            "whistle(kim)",
            {
                **dict.fromkeys([f"stray(asta,{y})" for y in ("east", "south", "west")], "1/9"),
                **dict.fromkeys([f"stray(bello,{y})" for y in ("north", "south", "west")], "1/9"),
                **dict.fromkeys([f"stray(cora,{y})" for y in ("north", "east", "west")], "1/9"),
            },
        ),
        # asta is leashed, bello is about to be: all three thirds are cora's; a fenced yard is
        # drawn in vain.
        (
            KENNEL,
            "astray",
            [*AT, "leashed(kim,asta)", "fenced(west)"],
            "leash(kim,bello)",
            {"stray(cora,north)": "1/3", "stray(cora,east)": "1/3"},
        ),
        # All are leashed, or about to be: there is nobody to pass it on to.
        (KENNEL, "astray", [*AT, "leashed(kim,asta)", "leashed(kim,cora)"], "leash(kim,bello)", {}),
        # A condition after `if` lets the draw of the leashed dog come to nothing, and `with` leaves
        # the fenced yard out; bello cannot stray to where it is.
        (
            KENNEL,
            "gap",
            [*AT, "leashed(kim,asta)", "fenced(south)", "fenced(west)"],
            "whistle(kim)",
            {"stray(bello,north)": "1/6", "stray(cora,north)": "1/6", "stray(cora,east)": "1/6"},
        ),
        # Seven values in all. That of asta goes to the other dogs, those of the fenced yards to
        # the other yards; of the yards of a dog three of four are possible, less the fenced ones.
        (
            KENNEL,
            "either",
            [*AT, "leashed(kim,asta)", "fenced(south)", "fenced(west)"],
            "whistle(kim)",
            {
                "fence(north)": "2/7",
                "fence(east)": "2/7",
                "stray(bello,north)": "3/56",
                "stray(cora,north)": "3/56",
                "stray(cora,east)": "3/56",
            },
        ),
        # Without a draw of the yard one of the possible ones is taken.
        (
            KENNEL,
            "free",
            [*AT, "leashed(kim,asta)", "fenced(south)", "fenced(west)"],
            "whistle(kim)",
            {"stray(bello,north)": "1/2", "stray(cora,north)": "1/4", "stray(cora,east)": "1/4"},
        ),
        # s4 is no automatic signal and has no share; that of s1 goes to s2 and s3; s3 is dark.
        (RAILWAY, "faults", ["watched(s1)", "dark(s3)"], "inspect(olga,s2)", {"break(s2)": "1/2"}),
        # A track first, then one of its automatic signals but the one that is inspected.
        (
            RAILWAY,
            "track",
            [],
            "inspect(olga,s4)",
            {"break(s1)": "1/4", "break(s2)": "1/4", "break(s3)": "1/2"},
        ),
        # That one is no value at all: a track without another one is not drawn either.
        (RAILWAY, "track", [], "inspect(olga,s3)", {"break(s1)": "1/2", "break(s2)": "1/2"}),
        # The robot's action as a condition that is not negated.
        (RAILWAY, "here", [], "inspect(olga,s4)", {"break(s4)": "1"}),
        (
            BALLOON,
            "gusty",
            ["heading(0)"],
            "burn(pia)",
            dict.fromkeys([f"blow(weak,{b})" for b in (90, 180, 270)], "1/6"),
        ),
        (BALLOON, "odd", ["heading(0)"], "burn(pia)", {}),
        (
            BALLOON,
            "odd",
            ["heading(0)", "shaken(strong)"],
            "burn(pia)",
            dict.fromkeys([f"blow(strong,{b})" for b in (90, 180, 270)], "1/3"),
        ),
    ],
)
def test_what_is_drawn(
    domain: str,
    scenario: str,
    state: list[str],
    action: str,
    expected: dict[str, str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = world_of(parse_description(domain))
    ours = chances(world, scenario, state, action, monkeypatch)
    nothing = ours.pop(NONE, Fraction(0))
    assert ours == {event: Fraction(chance) for event, chance in expected.items()}
    assert nothing == 1 - sum(ours.values())


def test_the_domains_share_no_word_with_the_office() -> None:
    office = words(load_description("office"))
    for domain in (KENNEL, RAILWAY, BALLOON):
        assert words(parse_description(domain)).isdisjoint(office)


def words(description: Description) -> set[str]:
    atoms = (*description.fluents, *description.agent_actions, *description.exogenous_actions)
    members = {member for sort in description.sorts.values() for member in sort}
    return {atom.name for atom in atoms} | members | set(description.sorts)
