"""What clingo finds of the statics is what the ground description has."""

import pytest

from asp.language import analyse, packaged_domains, parse_description, read_domain
from asp.refinement import true_statics
from tests.asp.reasoning.stories import CART
from tests.asp.refinement.levels import level

MANY = """\
sorts
  a = {x, y, z}.
  b = {x} + {w}.
  none_of_it = {v}.
statics
  edge(a, a).
  path(a, a).
  apart(a, a).
  odd(b).
  flag.
facts
  edge(x, y).
  edge(X, X).
  flag.
  odd(w).
laws
  path(X, Y) if edge(X, Y), X != Y.
  path(X, Z) if path(X, Y), path(Y, Z).
  apart(X, Y) if -path(X, Y), flag.
  path(y, z) if odd(W), W = w.
  odd(X) if path(X, X2), b(X2).
"""


@pytest.mark.parametrize("domain", [*packaged_domains(), CART, "many", "L1", "L2"])
def test_they_are_the_same(domain: str) -> None:
    if domain in ("L1", "L2"):
        text, file = level(domain).weak.text, domain
    else:
        file, text = ("many", MANY) if domain == "many" else read_domain(domain)
    expected = parse_description(text, file).statics
    assert true_statics(*analyse(text, file)) == expected


def test_some_are_derived_and_some_are_not() -> None:
    found = true_statics(*analyse(MANY))
    assert {"path(x,z)", "apart(z,x)", "edge(y,y)", "flag", "odd(w)"} <= found
    assert "apart(x,z)" not in found
