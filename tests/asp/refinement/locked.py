"""The packaged office with a kitchen and a library only, that can be locked, of two cells each."""

import re

from asp.language import read_domain

_FINE = """\
magnify
  room into cell.
  book into part.
components
  kitchen = {k1, k2}.
  library = {l1, l2}.
  book1   = {cover, spine}.
counterparts
  next_to. loc. in_hand. move. pickup. put_down. exo_move.
facts
  fine_next_to(k1, k2).
  fine_next_to(k2, l1).
  fine_next_to(l1, l2).
laws
  fine_loc(P1, C) if fine_loc(P2, C), component(P1, O), component(P2, O).
tests
  R tests fine_loc(T, C) if robot(R), fine_loc(R, C).
  R tests fine_in_hand(R, P).
"""


def locked_texts() -> tuple[str, str, str, str]:
    """What `load` takes."""
    text = read_domain("office")[1].partition("scenarios\n")[0]
    text = text.replace("{kitchen, office1, office2}", "{kitchen}")
    text = text.replace("{book1, book2}", "{book1}")
    text = re.sub(r"^  next_to\(office.*\n", "", text, flags=re.MULTILINE)
    return text, "small.al", _FINE, "small.fine"
