"""The trials of a run by what they are chosen by, page by page, for who asks over the network."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import polars as pl

from testbed.analysis import Run
from testbed.report.explorer import Teller
from testbed.report.sample import pairs_of
from testbed.report.scenes import Scenes
from testbed.report.telling import Told, outline

KEYS = {
    "study": "study",
    "condition": "cell",
    "scenario": "scenario",
    "level": "level",
    "robot": "robot",
    "outcome": "outcome",
}
"""What trials are chosen by, with the columns of the table."""
MOST_PAIRS, MOST_OFFSET = 200, 10**9


class QueryError(ValueError):
    """A query that has no answer; one line says why."""


@dataclass(frozen=True)
class Query:
    """Which pairs: `limit` of them after the first `offset`, of trials with these values."""

    offset: int = 0
    limit: int = 24
    chosen: Mapping[str, str] = field(default_factory=dict)

    @staticmethod
    def of(parameters: Mapping[str, list[str]]) -> "Query":
        """The query of these parameters. Raises QueryError; an empty value chooses nothing."""
        given = dict[str, str]()
        for key, values in parameters.items():
            if key not in ("offset", "limit", *KEYS):
                raise QueryError(
                    f"{key[:40]}: no parameter; there are offset, limit, {', '.join(KEYS)}"
                )
            if len(values) > 1:
                raise QueryError(f"{key}: given {len(values)} times")
            given[key] = values[0]
        offset = _number("offset", given.pop("offset", "0"), 0, MOST_OFFSET)
        limit = _number("limit", given.pop("limit", "24"), 1, MOST_PAIRS)
        return Query(offset, limit, {key: value for key, value in given.items() if value})


def _number(key: str, text: str, least: int, most: int) -> int:
    if (
        text.isascii()
        and text.isdecimal()
        and len(text) <= len(str(most))
        and least <= int(text) <= most
    ):
        return int(text)
    raise QueryError(f"{key}: a number from {least} to {most}")


class Catalogue:
    """All trials of a run, as it was when it was read."""

    def __init__(self, run: Run) -> None:
        self._teller = Teller(run)
        columns = ("trial", "pair", *(column for column in KEYS.values() if column != "study"))
        order = (
            pairs_of(run.table)
            .with_row_index("place")
            .select("place", "cell", "scenario", "level", "pair")
        )
        self._trials = (
            run.table.select(columns)
            .collect()
            .with_columns(study=pl.lit(self._teller.study))
            .join(order, on=["cell", "scenario", "level", "pair"], maintain_order="left")
            .sort("place", maintain_order=True)
        )

    def found(self, query: Query) -> Told:
        """A page of pairs, each trial with what its record has, and the numbers of all."""
        found = self._trials.filter(*self._conditions(query))
        places = found["place"].unique().sort()
        page = places.slice(query.offset, query.limit)
        ids = found.filter(pl.col("place").is_in(page.implode()))["trial"].to_list()
        return {
            "total": len(found),
            "pairs": len(places),
            "offset": query.offset,
            "limit": query.limit,
            "facets": {key: self._facet(query, key) for key in KEYS},
            "trials": [
                self._teller.about(record) | {"story": list(outline(record))}
                for record in self._teller.records(ids)
            ],
        }

    def pair(self, trial: str) -> Told | None:
        """The pair of a trial, with all that there is to see; None where there is no such trial."""
        places = self._trials.filter(trial=trial)["place"]
        if not len(places):
            return None
        scenes = Scenes()
        records = self._teller.records(self._trials.filter(place=places[0])["trial"])
        told = self._teller.tell(records, scenes)
        return {"scenes": scenes.drawn, "trials": told}

    def _facet(self, query: Query, key: str) -> dict[str, int]:
        """How many trials there are of each value, under the other choices."""
        found = self._trials.filter(*self._conditions(query, without=key))
        return dict(found[KEYS[key]].value_counts().sort(KEYS[key]).iter_rows())

    @staticmethod
    def _conditions(query: Query, without: str = "") -> list[pl.Expr]:
        return [pl.col(KEYS[key]) == value for key, value in query.chosen.items() if key != without]
