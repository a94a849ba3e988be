"""The journal of a search: a line per unit that was played, from which a search goes on."""

from pathlib import Path

import msgspec

from asp.language import Literal
from testbed.experiment.errors import StoreError
from testbed.experiment.growing_file import GrowingFile
from testbed.stress.units import Result, Unit

JOURNAL = "units.jsonl"


class Line(msgspec.Struct, frozen=True):
    """A unit, by its id, and its result."""

    unit: str
    result: Result


_encoder = msgspec.json.Encoder(enc_hook=str)


def _literal(kind: type, text: str) -> Literal:
    del kind
    return Literal.parse(text)


_decoder = msgspec.json.Decoder(Line, dec_hook=_literal)


class Journal:
    """Appends the results of units to the journal of a folder, each as it is heard."""

    def __init__(self, folder: Path) -> None:
        """Raises StoreError for a line that is not one of a journal; a torn last one is dropped."""
        self._path = folder / JOURNAL
        self.known: dict[str, Result] = {}
        end = 0
        for place, line in GrowingFile(self._path).new_lines():
            self._take(line)
            end = place + len(line)
        if self._path.exists():
            with self._path.open("r+b") as file:
                file.truncate(end)

    def _take(self, line: bytes) -> None:
        try:
            told = _decoder.decode(line)
        except (msgspec.MsgspecError, ValueError, RecursionError) as error:
            number = len(self.known) + 1
            raise StoreError(f"{self._path}:{number}: is no line of a search: {error}") from None
        self.known[told.unit] = told.result

    def add(self, unit: Unit, result: Result) -> None:
        """Write a result, unless it is on record."""
        if unit.id not in self.known:
            with self._path.open("ab") as file:
                file.write(_encoder.encode(Line(unit.id, result)) + b"\n")
