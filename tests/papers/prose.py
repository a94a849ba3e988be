"""The numbers that a page says in its prose, whatever words stand around them."""

import re

NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?%?")


def numbers(page: str) -> list[str]:
    """The numbers outside of tables and headings, in their order."""
    prose = (line for line in page.splitlines() if not line.startswith(("|", "#")))
    return NUMBER.findall(" ".join(prose))


def says(page: str, *expected: object) -> bool:
    """Whether these numbers follow one another in the prose of a page."""
    found, wanted = numbers(page), [str(number) for number in expected]
    return any(found[n : n + len(wanted)] == wanted for n in range(len(found)))
